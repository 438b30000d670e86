# SPDX-License-Identifier: BSD-2-Clause
"""The strips of shapes."""
import math

from strips.stage import BALL, ball

# A shape in even light, with z up.
SOLID = '''Sampler "lowdiscrepancy" "integer pixelsamples" 16
LookAt 0 1.7 -4.4  0 -.05 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "infinite" "color L" [ .4 .43 .5 ] "integer nsamples" 4
LightSource "distant" "point from" [ -1 1.6 -1.2 ] "color L" [ 1.6 1.5 1.3 ]
Material "matte" "color Kd" [ .35 .34 .32 ]
AttributeBegin Translate 0 -1 0 Rotate 90 1 0 0 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -12 -12 0  12 -12 0  12 12 0  -12 12 0 ] AttributeEnd
Texture "cells" "color" "checkerboard" "float uscale" 12 "float vscale" 6
  "color tex1" [ .68 .45 .26 ] "color tex2" [ .52 .31 .16 ]
Material "matte" "texture Kd" "cells"
Rotate 25 0 1 0 Rotate -90 1 0 0
%s
WorldEnd
'''
OCTAHEDRON = '''"integer indices" [ 0 1 2 0 2 3 0 3 4 0 4 1 5 2 1 5 3 2 5 4 3 5 1 4 ]
"point P" [ 0 0 1.2  1 0 0  0 1 0  -1 0 0  0 -1 0  0 0 -1 ]'''
SHEET = '''Rotate -12 0 0 1 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ] %s
"point P" [ -1 0 -.9  1 0 -.9  1 0 1  -1 0 1 ]'''


def solid(shape, before=""):
    """A function of a value, which the shape holds at %s."""
    return lambda x: SOLID % (before + 'Shape ' + shape % x)


def swept(shape, z=0):
    """A function of an angle; the gap that it leaves open faces the camera."""
    return solid(shape + ' "float phimax" %s', "Translate 0 0 %g Rotate 90 0 0 1 " % z)


def heights(n):
    values = [.22 * math.sin(7 * x / (n - 1)) * math.cos(5 * y / (n - 1)) + .2 * (x / (n - 1)) ** 2
              for y in range(n) for x in range(n)]
    return "Scale 2 2 2 Translate -.5 -.5 -.2 " + 'Shape "heightfield" "integer nu" %d "integer nv" %d ' \
        '"float Pz" [ %s ]' % (n, n, " ".join("%.4f" % z for z in values))


def knots(count, order):
    inner = count - order
    return " ".join(["0"] * order + ["%.4f" % ((i + 1) / (inner + 1)) for i in range(inner)] + ["1"] * order)


def nurbs(parameters="", uorder=4, vorder=4):
    """A patch of 5 x 5 control points with a peak in the middle."""
    bumps = [0, .9, -.5, .9, 0]
    points = [(-1 + x / 2, -1 + y / 2, bumps[x] * bumps[4 - y] + (1.6 if x == y == 2 else 0))
              for y in range(5) for x in range(5)]
    return SOLID % ('Shape "nurbs" "integer nu" 5 "integer nv" 5 "integer uorder" %d "integer vorder" %d '
                    '"float uknots" [ %s ] "float vknots" [ %s ] "point P" [ %s ] %s' % (
                        uorder, vorder, knots(5, uorder), knots(5, vorder),
                        " ".join("%.3f %.3f %.3f" % p for p in points), parameters))


def see_through(x):
    alpha = "float alpha" if x == "1" else "texture alpha"
    holes = "" if x == "1" else 'Texture "holes" "float" "%s" "float uscale" 6 "float vscale" 6\n' % x
    return SOLID % (holes + SHEET % '"float uv" [ 0 0 1 0 1 1 0 1 ] "%s" %s' % (
        alpha, "1" if x == "1" else '"holes"'))


STRIPS = {
    "loopsubdiv-nlevels": ("0 1 2 3 4", lambda x: ball(
        'Material "matte" "color Kd" [ .68 .45 .26 ]\nAttributeBegin Rotate 20 1 0 .3 Shape "loopsubdiv" '
        '"integer nlevels" %s\n"integer indices" [ 0 1 2 0 2 3 0 3 4 0 4 1 5 2 1 5 3 2 5 4 3 5 1 4 ]\n'
        '"point P" [ 0 1.5 0  1.3 0 0  0 0 1.3  -1.3 0 0  0 0 -1.3  0 -1 0 ] AttributeEnd' % x)
        .replace(BALL, "")),
    "cone-radius": (".25 .5 1 1.4", solid(
        '"cone" "float height" 1.6 "float radius" %s', "Translate 0 0 -1 ")),
    "cone-height": (".5 1 1.6 2.2", solid('"cone" "float height" %s', "Translate 0 0 -1 ")),
    "cone-phimax": ("90 180 270 360", swept('"cone" "float height" 1.6', -1)),
    "cylinder-zmin": ("-1 -.5 0 .5", solid('"cylinder" "float radius" .8 "float zmin" %s')),
    "cylinder-zmax": ("-.5 0 .5 1", solid('"cylinder" "float radius" .8 "float zmax" %s')),
    "cylinder-phimax": ("90 180 270 360", swept('"cylinder" "float radius" .8')),
    "disk-height": ("-.9 -.4 .1 .6", solid('"disk" "float height" %s')),
    "disk-radius": (".3 .6 1 1.4", solid('"disk" "float radius" %s')),
    "disk-innerradius": ("0 .3 .6 .9", solid('"disk" "float radius" 1.1 "float innerradius" %s')),
    "disk-phimax": ("90 180 270 360", swept('"disk" "float radius" 1.1')),
    "heightfield-nu": ("3 5 9 17 33", lambda x: SOLID % heights(int(x))),
    "hyperboloid-p1": ("1 0 -1; .5 0 -1; 1 0 0; 0 -1 -1", solid(
        '"hyperboloid" "point p2" [ 0 1 1 ] "point p1" [ %s ]')),
    "hyperboloid-p2": ("0 1 1; 0 .4 1; 0 1 0; 1 0 1", solid(
        '"hyperboloid" "point p1" [ 1 0 -1 ] "point p2" [ %s ]')),
    "hyperboloid-phimax": ("90 180 270 360", swept(
        '"hyperboloid" "point p1" [ 1 0 -1 ] "point p2" [ 0 1 1 ]')),
    "nurbs-uorder": ("2 3 4 5", lambda x: nurbs(uorder=int(x))),
    "nurbs-u0": ("0 .25 .5 .75", lambda x: nurbs('"float u0" ' + x)),
    "nurbs-u1": (".25 .5 .75 1", lambda x: nurbs('"float u1" ' + x)),
    "obj-group": ("absent box roof", lambda x: SOLID % (
        'Translate 0 0 -1 Shape "obj" "string filename" "house.obj"' + (
            "" if x == "absent" else ' "string group" "%s"' % x))),
    "paraboloid-radius": (".4 .7 1 1.3", solid(
        '"paraboloid" "float zmax" 1.6 "float radius" %s', "Translate 0 0 -.9 ")),
    "paraboloid-phimax": ("90 180 270 360", swept('"paraboloid" "float zmax" 1.6', -.9)),
    "sphere-radius": (".25 .5 .75 1", solid('"sphere" "float radius" %s')),
    "sphere-zmin": ("-1 -.5 0 .5", solid('"sphere" "float zmin" %s')),
    "sphere-zmax": ("-.5 0 .5 1", solid('"sphere" "float zmax" %s')),
    "sphere-phimax": ("90 180 270 360", swept('"sphere"')),
    "trianglemesh-N": ("absent given", lambda x: SOLID % ('Shape "trianglemesh" ' + OCTAHEDRON + (
        "" if x == "absent" else ' "normal N" [ 0 0 1  1 0 0  0 1 0  -1 0 0  0 -1 0  0 0 -1 ]'))),
    "trianglemesh-uv": ("0 0 1 0 1 1 0 1; 0 0 .5 0 .5 .5 0 .5; 0 0 1 0 0 1 1 1", lambda x: SOLID % (
        SHEET % '"float uv" [ %s ]' % x)),
    "trianglemesh-alpha": ("1 checkerboard dots", see_through),
    "trianglemesh-discarddegenerateUVs": ("false true", lambda x: SOLID % (
        SHEET % '"float uv" [ 0 0 1 0 1 1 1 1 ] "bool discarddegenerateUVs" "%s"' % x)),
}
