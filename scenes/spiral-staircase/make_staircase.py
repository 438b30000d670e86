#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the parts of one step of the staircase, the list of all steps, and the wall.
Run it in this folder: python3 make_staircase.py. Its output is kept beside it. Metres; y points up.
A step is a screw motion of the one below it, so that curved parts join without a seam."""
import math
import os
import struct
import sys
import zlib

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import Mesh, revolved

STEPS, STEPS_PER_TURN, RISE = 126, 24, .15
TURN = 2 * math.pi / STEPS_PER_TURN     # angle of a step
INNER, OUTER, THICKNESS = 1.3, 3.4, .16
CARPET = (1.85, 2.85)
MADE = "Written by make_staircase.py."


def at(radius, angle, height):
    return (radius * math.cos(angle), height, -radius * math.sin(angle))


def slope(angle):
    return angle / TURN * RISE


def flat(mesh, inner, outer, height, overhang=.025):
    start = -overhang / outer
    mesh.grid(lambda u, v: at(inner + (outer - inner) * u, start + (TURN - start) * v, height), 1, 4)


def riser(mesh, inner, outer, low, high, angle):
    mesh.quad(at(inner, angle, low), at(outer, angle, low), at(outer, angle, high),
              at(inner, angle, high))


def ribbon(mesh, radii, heights):
    """A band that follows the slope, between two radii and two heights over the slope."""
    (a, b), (c, d) = radii, heights
    corners = [(a, c), (b, c), (b, d), (a, d), (a, c)]
    for (r0, h0), (r1, h1) in zip(corners, corners[1:]):
        mesh.grid(lambda u, v: at(r0 + (r1 - r0) * v, TURN * u,
                                  slope(TURN * u) + h0 + (h1 - h0) * v), 4, 1)


def step():
    mesh = Mesh()
    flat(mesh, INNER, OUTER, RISE)
    riser(mesh, INNER, OUTER, 0, RISE - .03, 0)
    riser(mesh, INNER, OUTER, RISE - .03, RISE, -.025 / OUTER)
    mesh.write("step", "Tread and riser of a step. " + MADE)

    mesh = Mesh()
    mesh.grid(lambda u, v: at(INNER + (OUTER - INNER) * u, TURN * v, slope(TURN * v) - THICKNESS),
              4, 4)
    ribbon(mesh, (INNER - .05, INNER + .07), (-THICKNESS - .1, RISE + .09))
    mesh.write("soffit", "Underside and inner string of a step. " + MADE)

    mesh = Mesh()
    flat(mesh, *CARPET, RISE + .012, .04)
    riser(mesh, *CARPET, 0, RISE + .012, -.04 / OUTER)
    mesh.write("carpet", "Carpet on a step. " + MADE)


def rail():
    mesh = Mesh()

    def profile(u, v):
        c, s = math.cos(2 * math.pi * u), math.sin(2 * math.pi * u)
        return at(INNER + .01 + .055 * c, TURN * v, slope(TURN * v) + 1.1 + .04 * s)
    mesh.grid(profile, 16, 4, True)
    mesh.write("rail", "Hand rail along a step. " + MADE)

    mesh = Mesh()
    turned = revolved([(.011, 0), (.011, .26), (.011, .26), (.02, .29), (.011, .32), (.011, .32),
                       (.013, .5), (.028, .58), (.013, .66), (.011, .84), (.011, .92)])
    for part in (.25, .75):
        x, y, z = at(INNER + .01, TURN * part, slope(TURN * part) + .17)
        mesh.grid(lambda u, v: tuple(a + b for a, b in zip(turned(u, v), (x, y, z))), 8, 20)
    mesh.write("balusters", "Two balusters on a step. " + MADE)


def flight():
    with open("flight.pbrt", "w") as file:
        file.write("# All steps. " + MADE + "\n")
        for i in range(STEPS):
            file.write("TransformBegin Translate 0 %g 0 Rotate %g 0 1 0 ObjectInstance \"step\" "
                       "TransformEnd\n"
                       % (round(i * RISE, 4), i * 360 / STEPS_PER_TURN % 360))


def globes():
    with open("globes.pbrt", "w") as file:
        file.write("# Globes along the wall, one every 13 steps. " + MADE + "\n")
        for i in range(5, 84, 13):
            position = at(OUTER - .16, (i + .5) * TURN, i * RISE + 2.1)
            file.write("AttributeBegin Translate %.4f %.4f %.4f Shape \"sphere\" "
                       "\"float radius\" [ .1 ] AttributeEnd\n" % position)


def window():
    """The picture that the sun's light carries: panes between bars, as a grey PNG."""
    size, panes, bar = 128, 4, 5

    def is_bar(i):
        return (i % (size // panes)) < bar or i >= size - bar
    rows = b"".join(b"\0" + bytes(0 if is_bar(i) or is_bar(j) else 255 for i in range(size))
                    for j in range(size))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open("window.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


step()
globes()
window()
rail()
flight()
