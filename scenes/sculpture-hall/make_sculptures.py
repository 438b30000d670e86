#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the control meshes of the sculptures. The scene subdivides each of them three times, so that
they have 64 times as many triangles, more than a million together.
Run it in this folder: python3 make_sculptures.py. Its output is kept beside it. Metres; y points up.
The origin of each sculpture is the middle of its foot."""
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import TAU, cross, unit

MADE = "Written by make_sculptures.py."
LEVELS = 3


def write(name, comment, points, triangles):
    def numbers(rows, form):
        return " ".join(form % x for row in rows for x in row)
    low = min(y for _, y, _ in points)
    points = [(x, y - low, z) for x, y, z in points]
    with open(name + ".pbrt", "w") as file:
        file.write("# %s %s\nShape \"loopsubdiv\" \"integer nlevels\" [ %d ]\n"
                   "\"integer indices\" [ %s ]\n\"point P\" [ %s ]\n"
                   % (comment, MADE, LEVELS, numbers(triangles, "%d"), numbers(points, "%.4g")))
    return len(triangles) * 4 ** LEVELS


def quads(rows, columns, is_closed):
    """The triangles of a grid whose columns are closed, and whose rows are closed or open."""
    triangles = []
    for j in range(rows if is_closed else rows - 1):
        for i in range(columns):
            a, b = j * columns + i, j * columns + (i + 1) % columns
            c, d = ((x + columns) % (rows * columns) for x in (a, b))
            triangles += [(a, b, d), (a, d, c)]
    return triangles


def ring(name, comment, centre, section, rows, columns):
    """A closed tube about a closed curve; section(t, angle) is an offset in the plane across it."""
    points = []
    for j in range(rows):
        t = TAU * j / rows
        p, e = centre(t), 1e-4
        d = unit(tuple(b - a for a, b in zip(centre(t - e), centre(t + e))))
        x = unit(cross((0, 0, 1), d))
        y = cross(d, x)
        for i in range(columns):
            s, c = section(t, TAU * i / columns)
            points.append(tuple(p[k] + s * x[k] + c * y[k] for k in range(3)))
    return write(name, comment, points, quads(rows, columns, True))


def column(name, comment, radius, heights, columns):
    """A closed body round the y axis; radius(v, angle), v from 0 to 1 over the heights."""
    rows = len(heights)
    points = []
    for j, y in enumerate(heights):
        for i in range(columns):
            angle = TAU * i / columns
            r = radius(j / (rows - 1), angle)
            points.append((r * math.cos(angle), y, -r * math.sin(angle)))
    triangles = quads(rows, columns, False)
    for y, first, step in ((heights[0], 0, -1), (heights[-1], (rows - 1) * columns, 1)):
        points.append((0, y, 0))
        for i in range(columns):
            pair = (first + i, first + (i + 1) % columns)
            triangles.append((len(points) - 1,) + pair[::step])
    return write(name, comment, points, triangles)


def knot():
    """A trefoil knot of a broad ribbon, which turns three times about its middle."""
    size = .275

    def centre(t):
        return (size * (math.sin(t) + 2 * math.sin(2 * t)), size * (math.cos(t) - 2 * math.cos(2 * t)),
                -size * 1.15 * math.sin(3 * t))

    def section(t, angle):
        a, b = .155 * math.cos(angle), .062 * math.sin(angle)
        c, s = math.cos(3 * t + .4), math.sin(3 * t + .4)
        return a * c - b * s, a * s + b * c
    return ring("knot", "A trefoil knot of a ribbon.", centre, section, 200, 24)


def loop():
    """A standing ring that is thick below and thin above."""
    def centre(t):
        return (.46 * math.sin(t), -.5 * math.cos(t), .05 * math.sin(2 * t))

    def section(t, angle):
        thick = .17 + .075 * math.cos(t)
        return thick * math.cos(angle), .8 * thick * math.sin(angle)
    return ring("loop", "A standing ring.", centre, section, 48, 16)


def bloom():
    """A bulb with seven lobes, which wind upwards."""
    def radius(v, angle):
        bulge = math.sin(math.pi * (.06 + .9 * v)) ** .8
        lobes = 1 + .20 * math.sin(math.pi * v) * math.cos(7 * angle + 5.5 * v)
        return .02 + .47 * bulge * lobes
    heights = [.55 * (1 - math.cos(math.pi * (.04 + .92 * i / 35))) for i in range(36)]
    return column("bloom", "A bulb with seven lobes.", radius, heights, 56)


def pillar():
    """A twisted square pillar with three waists."""
    def radius(v, angle):
        turned = angle + 2.6 * v
        square = (math.cos(turned) ** 6 + math.sin(turned) ** 6) ** (-1 / 6)
        return (.17 + .055 * math.cos(3 * TAU * v)) * square * (1 - .25 * v)
    return column("pillar", "A twisted pillar.", radius, [1.75 * i / 63 for i in range(64)], 32)


print("%d triangles after the subdivision" % (knot() + loop() + bloom() + pillar()))
