# SPDX-License-Identifier: BSD-2-Clause
"""The strips of volumes."""
from strips.stage import FLOOR, color

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

QUICK = 'Sampler "lowdiscrepancy" "integer pixelsamples" 4\n' + MIST
# The mist fills other parts of space.
PARTIAL = QUICK.replace(' "point p0" [ -3 -1 -3 ] "point p1" [ 3 3 3 ]', "")
CELLS = '"volumegrid" "color sigma_s" [ .25 .25 .25 ] '


STRIPS = {
    "homogeneous-sigma_s": ("0 .02 .05 .1 .2", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-sigma_a": ("0 .05 .1 .2 .4", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "color sigma_a" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-g": ("-.7 -.35 0 .35 .7", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "float g" ' + x)),
    "exponential-b": ("0 .5 1 2 4", lambda x: MIST % (
        '"exponential" "color sigma_s" [ .2 .2 .2 ] "float a" 1 "float b" ' + x)),
    "homogeneous-Le": ("0; .01; .03; .03 .02 .005; .005 .015 .03", lambda x: QUICK % (
        '"homogeneous" "color sigma_s" [ .04 .04 .04 ] "color Le" ' + color(x))),
    "homogeneous-p0": ("-3 -1 -3; -.5 -1 -3; -3 .5 -3; -3 -1 1", lambda x: PARTIAL % (
        '"homogeneous" "color sigma_s" [ .1 .1 .1 ] "point p1" [ 3 3 3 ] "point p0" [ %s ]' % x)),
    "homogeneous-p1": ("3 3 3; .5 3 3; 3 .5 3; 3 3 -.5", lambda x: PARTIAL % (
        '"homogeneous" "color sigma_s" [ .1 .1 .1 ] "point p0" [ -3 -1 -3 ] "point p1" [ %s ]' % x)),
    "exponential-a": ("0 .25 .5 1 2", lambda x: QUICK % (
        '"exponential" "color sigma_s" [ .2 .2 .2 ] "float b" 1 "float a" ' + x)),
    "exponential-updir": ("0 1 0; 0 2 0; 1 0 0; 0 0 1", lambda x: QUICK % (
        '"exponential" "color sigma_s" [ .3 .3 .3 ] "vector updir" [ %s ]' % x)),
    "volumegrid-density": ("1 1 1 1; 0 0 0 1; 1 0 0 0; 0 2 0 0", lambda x: QUICK % (
        CELLS + '"integer nx" 4 "float density" [ %s ]' % x)),
    "volumegrid-nx": ("1 2 4 8", lambda x: QUICK % (
        CELLS + '"integer nx" %s "float density" [ %s ]' % (x, ("1 0 " * 4)[:2 * int(x)]))),
}
