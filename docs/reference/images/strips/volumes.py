# SPDX-License-Identifier: BSD-2-Clause
"""The strips of volumes."""
from strips.stage import FLOOR

MIST = '''LookAt 0 .6 -4.6  0 0 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "spot" "point from" [ -2.6 3 1.2 ] "point to" [ .4 -1 0 ] "color I" [ 90 84 72 ]
  "float coneangle" 14 "float conedeltaangle" 2
LightSource "infinite" "color L" [ .03 .035 .045 ]
Volume %s "point p0" [ -3 -1 -3 ] "point p1" [ 3 3 3 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate .4 -.4 0 Shape "sphere" "float radius" .6 AttributeEnd
WorldEnd
'''


STRIPS = {
    "homogeneous-sigma_s": ("0 .02 .05 .1 .2", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-sigma_a": ("0 .05 .1 .2 .4", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "color sigma_a" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-g": ("-.7 -.35 0 .35 .7", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "float g" ' + x)),
    "exponential-b": ("0 .5 1 2 4", lambda x: MIST % (
        '"exponential" "color sigma_s" [ .2 .2 .2 ] "float a" 1 "float b" ' + x)),
}
