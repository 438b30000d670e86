#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the surfaces of revolution of the still life: a goblet, its wine, a carafe, its water,
a ring, a lemon.
Run it in this folder: python3 make_glasses.py. Its output is kept beside it. Decimetres; y points
up."""
import math
import struct


def spline(p, t):
    """Catmull-Rom through the points of a run, t in [0, 1]."""
    x = min(max(t, 0), 1) * (len(p) - 1)
    i = min(int(x), len(p) - 2)
    a, b, c, d = (p[min(max(k, 0), len(p) - 1)] for k in range(i - 1, i + 3))
    x -= i
    return tuple(.5 * (2 * q + (r - o) * x + (2 * o - 5 * q + 4 * r - s) * x * x
                       + (3 * q - o - 3 * r + s) * x ** 3) for o, q, r, s in zip(a, b, c, d))


def write(name, comment, runs, sectors=64, steps=4):
    """Each run of (radius, height) is smooth; runs meet in creases. Normals point to the left of the
    profile as it is listed from the axis at the bottom."""
    points, normals, triangles = [], [], []
    for run in runs:
        first, rows = len(points), steps * (len(run) - 1) if len(run) > 2 else 1
        for j in range(rows + 1):
            r, y = spline(run, j / rows)
            lower, upper = spline(run, j / rows - .002), spline(run, j / rows + .002)
            dr, dy = upper[0] - lower[0], upper[1] - lower[1]
            length = math.hypot(dr, dy)
            for i in range(sectors):
                c, s = math.cos(2 * math.pi * i / sectors), math.sin(2 * math.pi * i / sectors)
                points.append((max(r, 0) * c, y, max(r, 0) * s))
                normals.append((dy / length * c, -dr / length, dy / length * s))
        for j in range(rows):
            for i in range(sectors):
                a, b = first + j * sectors + i, first + j * sectors + (i + 1) % sectors
                for t in ((a, a + sectors, b + sectors), (a, b + sectors, b)):
                    if len({tuple(round(x, 4) for x in points[k]) for k in t}) == 3:
                        triangles.append(t)

    with open(name + ".ply", "wb") as file:
        properties = "".join("property float %s\n" % p for p in ("x", "y", "z", "nx", "ny", "nz"))
        file.write(("ply\nformat binary_little_endian 1.0\ncomment %s Written by make_glasses.py.\n"
                    "element vertex %d\n%selement face %d\nproperty list uchar int vertex_indices\n"
                    "end_header\n" % (comment, len(points), properties, len(triangles))).encode())
        for p, n in zip(points, normals):
            file.write(struct.pack("<6f", *p, *n))
        for t in triangles:
            file.write(struct.pack("<B3i", 3, *t))


BOWL = [(.12, 1.06), (.42, 1.15), (.68, 1.42), (.75, 1.75), (.71, 2.1), (.63, 2.4)]  # inside


def main():
    write("goblet", "A goblet of glass.",
          [[(0, 0), (.7, 0)], [(.7, 0), (.72, .02), (.7, .045)],
           [(.7, .045), (.35, .09), (.12, .16), (.075, .35), (.07, .7), (.11, .9), (.34, 1.04),
            (.62, 1.27), (.76, 1.5), (.79, 1.75), (.75, 2.1), (.67, 2.4)],
           [(.67, 2.4), (.65, 2.415), (.63, 2.4)], BOWL[::-1] + [(0, 1.04)]])
    write("wine", "The wine in the goblet. It reaches slightly into the glass.",
          [[(0, 1.035), (.125, 1.05), (.428, 1.14), (.69, 1.415), (.757, 1.72)],
           [(.757, 1.72), (0, 1.72)]])
    write("carafe", "A carafe of glass.",
          [[(0, 0), (.85, 0)], [(.85, 0), (.95, .05), (1.02, .2), (1.05, .6), (.95, 1.15), (.6, 1.75),
                                (.33, 2.3), (.29, 2.8), (.36, 3.2), (.5, 3.45)],
           [(.5, 3.45), (.485, 3.465), (.465, 3.45)],
           [(.465, 3.45), (.325, 3.19), (.25, 2.8), (.29, 2.29), (.555, 1.72), (.9, 1.13), (.995, .6),
            (.96, .26), (.8, .14), (0, .12)]])
    write("water", "The water in the carafe. It reaches slightly into the glass.",
          [[(0, .115), (.81, .135), (.968, .255), (1.003, .6), (.955, .95)], [(.955, .95), (0, .95)]])
    write("ring", "A ring, a band of radius .5 whose inside is nearly a cylinder.",
          [[(.46, .02), (.485, 0), (.52, 0), (.545, .02)],
           [(.545, .02), (.56, .09), (.565, .15), (.56, .21), (.545, .28)],
           [(.545, .28), (.52, .3), (.485, .3), (.46, .28)],
           [(.46, .28), (.455, .15), (.46, .02)]], 96)
    write("lemon", "A lemon of length 1.3 and radius .44. Its axis is y.",
          [[(0, -.63), (.06, -.62), (.12, -.57), (.24, -.5), (.37, -.32), (.435, -.1), (.43, .12),
            (.35, .33), (.22, .47), (.13, .53), (.1, .59), (.07, .66), (0, .68)]], 64, 6)


main()
