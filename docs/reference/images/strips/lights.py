# SPDX-License-Identifier: BSD-2-Clause
"""The strips of lights."""
from strips.stage import FLOOR

CONE = '''LookAt 0 1.4 -4.6  0 -.5 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "spot" "point from" [ -.8 2.6 -.9 ] "point to" [ 0 -1 0 ] "color I" [ 34 32 28 ] %s
LightSource "infinite" "color L" [ .03 .035 .045 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate 0 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
WorldEnd
'''


STRIPS = {
    "spot-coneangle": ("8 14 20 30 50", lambda x: CONE % (
        '"float conedeltaangle" 2 "float coneangle" ' + x)),
    "spot-conedeltaangle": ("0 4 8 14 20", lambda x: CONE % (
        '"float coneangle" 20 "float conedeltaangle" ' + x)),
}
