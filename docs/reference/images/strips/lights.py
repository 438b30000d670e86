# SPDX-License-Identifier: BSD-2-Clause
"""The strips of lights."""
from strips.stage import FLOOR, GRAINY, SCENES, color

CONE = '''LookAt 0 1.4 -4.6  0 -.5 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "spot" "point from" [ -.8 2.6 -.9 ] "point to" [ 0 -1 0 ] "color I" [ 34 32 28 ] %s
LightSource "infinite" "color L" [ .03 .035 .045 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate 0 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
WorldEnd
'''

# A wall behind a ball.
WALL = '''LookAt 0 .5 -4.8  0 .1 0  0 1 0
Camera "perspective" "float fov" 38
WorldBegin
LightSource "infinite" "color L" [ .03 .035 .045 ]
AttributeBegin %s AttributeEnd
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -12 -1 1.6  12 -1 1.6  12 8 1.6  -12 8 1.6 ]
AttributeBegin Translate .5 -.6 .3 Shape "sphere" "float radius" .4 AttributeEnd
WorldEnd
'''
OPEN = '''LookAt 0 1.2 -4.6  0 -.4 0  0 1 0
Camera "perspective" "float fov" 34
WorldBegin
AttributeBegin %s AttributeEnd
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate -.6 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
Material "mirror" "color Kr" [ .85 .85 .85 ]
AttributeBegin Translate .6 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
WorldEnd
'''
# One camera sample a pixel shows the noise of a light.
NOISY = GRAINY + 'PixelFilter "box"\nSampler "lowdiscrepancy" "integer pixelsamples" 1\n'


def distant(parameters):
    return OPEN % ('LightSource "infinite" "color L" [ .1 .12 .15 ] LightSource "distant" ' + parameters)


def mapped(light, value):
    return light + ("" if value == "absent" else ' "string mapname" "%s"' % value)


def projector(parameters):
    return WALL % ('Translate 0 .6 -1.5 Rotate 180 0 0 1 LightSource "projection" ' + parameters)


def area(parameters, radius):
    return OPEN % ('AreaLightSource "area" %s Translate -1.6 2 -.8 Rotate 40 0 1 0 Rotate 50 1 0 0 '
                   'Shape "disk" "float radius" %s' % (parameters, radius))


STRIPS = {
    "spot-coneangle": ("8 14 20 30 50", lambda x: CONE % (
        '"float conedeltaangle" 2 "float coneangle" ' + x)),
    "spot-conedeltaangle": ("0 4 8 14 20", lambda x: CONE % (
        '"float coneangle" 20 "float conedeltaangle" ' + x)),
    "distant-L": (".5; 1; 2; 2 1 .3", lambda x: distant('"point from" [ -1 1.5 -1 ] "color L" ' + color(x))),
    "distant-scale": (".5; 1; 2; 2 1 .3", lambda x: distant(
        '"point from" [ -1 1.5 -1 ] "color scale" ' + color(x))),
    "distant-from": ("0 1 0; -1 1 -1; -2 1 0; 1 1 2", lambda x: distant(
        '"color L" [ 2 1.9 1.7 ] "point to" [ 0 0 0 ] "point from" [ %s ]' % x)),
    "goniometric-mapname": ("absent bands.png sectors.png halves.png", lambda x: WALL % mapped(
        'Translate -.3 .4 .4 LightSource "goniometric" "color I" [ 2.5 2.3 2 ]', x)),
    "infinite-L": (".5; 1; 2; 2 1 .3", lambda x: OPEN % ('LightSource "infinite" "color L" ' + color(x))),
    "infinite-mapname": ("absent sky.png halves.png", lambda x: "%s" % OPEN % mapped(
        'Rotate -90 1 0 0 LightSource "infinite" "integer nsamples" 8', x)),
    "infinite-nsamples": ("1 4 16 64", lambda x: NOISY + OPEN % mapped(
        'Rotate -90 1 0 0 LightSource "infinite" "integer nsamples" ' + x, "sky.png")),
    "point-I": (".5; 1; 2; 2 1 .3", lambda x: WALL % (
        'LightSource "point" "point from" [ -.3 .4 .4 ] "color I" ' + color(x))),
    "point-scale": (".5; 1; 2; 2 1 .3", lambda x: WALL % (
        'LightSource "point" "point from" [ -.3 .4 .4 ] "color scale" ' + color(x))),
    "point-from": ("-.3 .4 .4; .5 .4 .4; -1 -.5 .4; 0 1.6 -1", lambda x: WALL % (
        'LightSource "point" "color I" [ 2.5 2.3 2 ] "point from" [ %s ]' % x)),
    "projection-I": ("4; 12; 24; 24 12 4", lambda x: projector(mapped(
        '"float fov" 40 "color I" ' + color(x), SCENES + "/parts/painting.png"))),
    "projection-mapname": ("absent painting.png bands.png grid.png", lambda x: projector(mapped(
        '"float fov" 40 "color I" [ 12 12 12 ]',
        SCENES + "/parts/" + x if x.startswith("p") else x))),
    "projection-fov": ("15 30 45 70", lambda x: projector(mapped(
        '"color I" [ 12 12 12 ] "float fov" ' + x, SCENES + "/parts/painting.png"))),
    "spot-I": ("8; 20; 50; 50 25 8", lambda x: (CONE % '"float coneangle" 20').replace(
        "[ 34 32 28 ]", color(x))),
    "spot-to": ("0 -1 0; -.8 -1 0; .8 -1 0; 0 -1 1.5", lambda x: (
        CONE % '"float coneangle" 14').replace("[ 0 -1 0 ]", "[ %s ]" % x)),
    "area-L": ("4; 8; 16; 16 9 4", lambda x: area('"color L" ' + color(x), ".5")),
    "area-nsamples": ("1 4 16 64", lambda x: NOISY + area(
        '"color L" [ 2 2 2 ] "integer nsamples" ' + x, "1.2")),
}
