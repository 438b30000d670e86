# SPDX-License-Identifier: BSD-2-Clause
"""The strips of samplers. Their pictures show single pixels."""
from strips.filters import STAR
from strips.stage import FLOOR, GRAINY

# A ball out of focus in the light of a large lamp.
BLURRED = GRAINY + '''PixelFilter "box"
Sampler %s
LookAt 0 .6 -4.4  0 -.3 0  0 1 0
Camera "perspective" "float fov" 30 "float lensradius" .15 "float focaldistance" 3.6
WorldBegin
AttributeBegin AreaLightSource "area" "color L" [ 7 6.5 5.5 ]
  Translate -2.4 3.2 -1.6 Rotate 38 0 1 0 Rotate 45 1 0 0 Shape "disk" "float radius" 1.2 AttributeEnd
''' + FLOOR + '''Material "matte" "color Kd" [ .62 .14 .08 ]
Translate 0 -.4 0 Shape "sphere" "float radius" .6
WorldEnd
'''


def sampled(parameters):
    return lambda x: BLURRED % (parameters + x)


STRIPS = {
    "lowdiscrepancy-pixelsamples": ("1 4 16 64 256", sampled('"lowdiscrepancy" "integer pixelsamples" ')),
    "halton-pixelsamples": ("1 4 16 64 256", sampled('"halton" "integer pixelsamples" ')),
    "random-xsamples": ("1 2 4 8 16", sampled('"random" "integer ysamples" 2 "integer xsamples" ')),
    "stratified-jitter": ("true false", lambda x: GRAINY + (
        'PixelFilter "box"\nSampler "stratified" "bool jitter" "%s"\n' % x) + STAR.replace(" 40", " 160")),
    "stratified-xsamples": ("1 2 4 8 16", sampled('"stratified" "integer ysamples" 2 "integer xsamples" ')),
}
