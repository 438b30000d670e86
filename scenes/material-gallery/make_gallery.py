#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the object of the gallery, the places of all materials on the shelf, and a table of
measurements for the material "measured".
Run it in this folder: python3 make_gallery.py. Its output is kept beside it. y points up."""
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import TAU, spline

MADE = "Written by make_gallery.py."
COLUMNS, CELL_WIDTH, CELL_HEIGHT = 6, 1.04, 1.22
LOBES, SECTORS, ROWS = 5, 30, 15

GOLD = '"color eta" [ .18 .42 1.37 ] "color k" [ 3.42 2.35 1.77 ] "float roughness" [ .02 ]'
GROUPS = [
    ("matte", 'Material "matte" "color Kd" [ .68 .35 .16 ]'),
    ("matte, sigma 40", 'Material "matte" "color Kd" [ .68 .35 .16 ] "float sigma" [ 40 ]'),
    ("clay", 'Material "clay"'),
    ("skin", 'Material "skin"'),
    ("felt", 'Material "felt"'),
    ("primer", 'Material "primer"'),
    ("plastic", 'Material "plastic" "color Kd" [ .50 .05 .04 ] "color Ks" [ .45 .45 .45 ] '
     '"float roughness" [ .03 ]'),
    ("substrate", 'Material "substrate" "color Kd" [ .03 .14 .26 ] "color Ks" [ .06 .06 .06 ] '
     '"float uroughness" [ .004 ] "float vroughness" [ .004 ]'),
    ("bluepaint", 'Material "bluepaint"'),
    ("measured", 'Material "measured" "string filename" "twotone.brdf"'),
    ("translucent", 'Material "translucent" "color Kd" [ .78 .66 .42 ] "color Ks" [ .2 .2 .2 ] '
     '"float roughness" [ .05 ] "color reflect" [ .45 .45 .45 ] "color transmit" [ .55 .55 .55 ]'),
    ("uber", 'Material "uber" "color Kd" [ .05 .22 .10 ] "color Ks" [ .3 .3 .3 ] '
     '"float roughness" [ .05 ] "color Kr" [ .7 .7 .7 ] "color opacity" [ .7 .7 .7 ]'),
    ("brushedmetal", 'Material "brushedmetal"'),
    ("shinymetal", 'Material "shinymetal" "color Kr" [ .35 .30 .24 ] "color Ks" [ .55 .45 .32 ] '
     '"float roughness" [ .04 ]'),
    ("metal", 'Material "metal" ' + GOLD),
    ("mix", 'MakeNamedMaterial "gold" "string type" "metal" ' + GOLD + '\n'
     'MakeNamedMaterial "ink" "string type" "matte" "color Kd" [ .02 .05 .09 ]\n'
     'Material "mix" "string namedmaterial1" "gold" "string namedmaterial2" "ink" '
     '"texture amount" "patches"'),
    ("mirror", 'Material "mirror" "color Kr" [ .93 .93 .93 ]'),
    ("glass", 'Material "glass" "color Kt" [ .96 .98 .97 ]'),
]


def bud():
    """A bulb with twisted lobes, as the control mesh of a subdivision surface."""
    profile = [(.13, 0), (.23, .02), (.25, .05), (.16, .095), (.20, .15), (.34, .26), (.385, .42),
               (.34, .58), (.23, .69), (.13, .755), (.105, .80), (.12, .845), (.105, .885), (.06, .91),
               (.03, .915)]
    points = [(0, -.002, 0)]
    for j in range(ROWS):
        r, y = spline(profile, j / (ROWS - 1))
        depth = .30 * math.exp(-((y - .42) / .22) ** 2)
        for i in range(SECTORS):
            angle = TAU * i / SECTORS
            wave = 1 + depth * math.cos(LOBES * (angle + 1.5 * y))
            points.append((r * wave * math.cos(angle), y, r * wave * math.sin(angle)))
    points.append((0, .918, 0))
    last, triangles = len(points) - 1, []
    for i in range(SECTORS):
        k = (i + 1) % SECTORS
        top = 1 + (ROWS - 1) * SECTORS
        triangles += [(0, 1 + i, 1 + k), (last, top + k, top + i)]
        for j in range(ROWS - 1):
            a, b = 1 + j * SECTORS + i, 1 + j * SECTORS + k
            triangles += [(a, a + SECTORS, b + SECTORS), (a, b + SECTORS, b)]
    with open("bud.pbrt", "w") as file:
        file.write("# A bulb with five twisted lobes. %s\nShape \"loopsubdiv\" \"integer nlevels\" [ 3 ]\n"
                   "\"integer indices\" [ %s ]\n\"point P\" [ %s ]\n"
                   % (MADE, " ".join("%d %d %d" % t for t in triangles),
                      " ".join("%.4f %.4f %.4f" % p for p in points)))


def place(index):
    """The middle of the object's foot: x, y."""
    row, column = divmod(index, COLUMNS)
    return ((column - (COLUMNS - 1) / 2) * CELL_WIDTH, (2 - row) * CELL_HEIGHT)


def objects():
    with open("objects.pbrt", "w") as file:
        file.write("# One object for each material. " + MADE + "\n")
        for i, (name, material) in enumerate(GROUPS):
            file.write("# %s\nAttributeBegin\n%s\nTranslate %.2f %.2f 0 Include \"bud.pbrt\"\n"
                       "AttributeEnd\n" % (name, material, *place(i)))


def measurements():
    """A lacquer that is violet from above and golden at grazing angles, with a broad highlight."""
    thetas = (0, .3, .6, .9, 1.2, 1.5)
    with open("twotone.brdf", "w") as file:
        file.write("3 450 540 630\n")
        for ti in thetas:
            for to in thetas:
                for phi in (0, .785, 1.571, 2.356, 3.142):
                    wi = (math.sin(ti), 0, math.cos(ti))
                    wo = (math.sin(to) * math.cos(phi), math.sin(to) * math.sin(phi), math.cos(to))
                    h = [a + b for a, b in zip(wi, wo)]
                    length = math.sqrt(sum(x * x for x in h)) or 1
                    highlight = .5 * max(h[2] / length, 0) ** 24
                    graze = 1 - wi[2] * wo[2]
                    colour = [.20 * (1 - graze) + .02 * graze, .03 * (1 - graze) + .10 * graze,
                              .12 * (1 - graze) + .22 * graze]
                    file.write("%.4g 0 %.4g %.4g %s\n"
                               % (ti, to, phi, " ".join("%.4f" % (c + highlight) for c in colour)))


if __name__ == "__main__":
    bud()
    objects()
    measurements()
