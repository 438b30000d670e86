#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the blinds, a palm, a table and the boards of the floor.
Run it in this folder: python3 make_room.py. Its output is kept beside it. Metres; y points up.
The window is in the wall z = -3, from x = -1.75 to 1.05 and from y = .62 to 2.72."""
import math
import os
import random
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import Mesh, TAU, revolved, sub, tube, unit, cross

MADE = "Written by make_room.py."
LEFT, RIGHT, SILL, TOP, WALL = -1.75, 1.05, .62, 2.72, -3.
SLATS, DEPTH, TILT = 18, .098, math.radians(6)


def blinds():
    draw = random.Random(1)
    mesh = Mesh()
    for i in range(SLATS):
        y0 = SILL + .06 + (TOP - SILL - .12) * i / (SLATS - 1)
        tilt, sag = TILT + draw.uniform(-.05, .05), draw.uniform(-.003, .003)

        def slat(u, v):
            w = v - .5
            y, z = .011 * (1 - 4 * w * w), DEPTH * w
            c, s = math.cos(tilt), math.sin(tilt)
            return (LEFT + .02 + (RIGHT - LEFT - .04) * u, y0 + y * c - z * s + sag * (2 * u - 1),
                    WALL + .09 + z * c + y * s)
        mesh.grid(slat, 1, 6)
    mesh.write("slats", "The slats of the blinds. " + MADE)
    mesh = Mesh()
    for x in (LEFT + .35, (LEFT + RIGHT) / 2, RIGHT - .35):
        for z in (-.034, .034):
            mesh.box((x - .004, SILL, WALL + .09 + z - .002), (x + .004, TOP, WALL + .09 + z + .002))
    mesh.box((LEFT, TOP - .05, WALL + .04), (RIGHT, TOP + .02, WALL + .14))
    mesh.box((LEFT + .02, SILL + .02, WALL + .06), (RIGHT - .02, SILL + .045, WALL + .12))
    mesh.write("tapes", "Tapes and rails of the blinds. " + MADE)


def palm():
    draw = random.Random(11)
    mesh, stems = Mesh(), Mesh()
    for i in range(13):
        turn = TAU * i / 13 * 5 + draw.uniform(-.2, .2)
        reach, rise, droop = draw.uniform(.55, 1.0), draw.uniform(.9, 1.55), draw.uniform(.45, .95)

        def spine(v):
            r = reach * v
            y = .35 + rise * v - droop * rise * max(v, 0) ** 2.6 + .05 * math.sin(9 * v + i) * v
            return (r * math.cos(turn), y, r * math.sin(turn))
        axis = (-math.sin(turn), .01, math.cos(turn))
        stems.grid(tube(spine, lambda v: .011 * (1 - .8 * v), axis), 5, 14)
        for k in range(26):
            v = .28 + .72 * k / 26
            p, d = spine(v), unit(sub(spine(v + .01), spine(v - .01)))
            side = unit(cross(d, (0, 1, 0)))
            length = .34 * math.sin(math.pi * (.12 + .8 * (v - .28) / .72)) + .04
            for sign in (-1, 1):
                out = unit(tuple(.75 * sign * a + .62 * b for a, b in zip(side, d)))

                def leaf(u, w):
                    x = length * w
                    width = .021 * math.sin(math.pi * min(w * .92 + .08, 1)) * (u - .5) * 2
                    sag = -.35 * w * w * length - .006 * abs(u - .5)
                    return tuple(a + x * b + width * c + sag * e for a, b, c, e in
                                 zip(p, out, unit(cross(out, (0, 1, 0))), (0, 1, 0)))
                mesh.grid(leaf, 1, 3)
    mesh.write("leaves", "The leaves of the palm. " + MADE, digits=3)
    stems.write("stems", "The stalks of the palm. " + MADE, digits=3)
    mesh = Mesh()
    mesh.grid(revolved([(.16, 0), (.17, .01), (.205, .3), (.225, .38), (.225, .385), (.21, .385),
                        (.195, .33), (0, .33)]), 36, 28)
    mesh.write("pot", "The pot of the palm. " + MADE)


def table():
    mesh = Mesh()
    mesh.grid(revolved([(0, .715), (.40, .715), (.42, .72), (.425, .73), (.42, .74), (.40, .745),
                        (0, .745)]), 48, 24)
    leg = revolved([(.025, .715), (.028, .6), (.024, .4), (.03, .24), (.022, .0)])
    for i in range(3):
        angle = TAU * (i + .25) / 3

        def splayed(u, v):
            x, y, z = leg(u, v)
            out = .20 + .13 * (1 - y / .715)
            return (x + out * math.cos(angle), y, z + out * math.sin(angle))
        mesh.grid(splayed, 12, 16)
    mesh.write("table", "A round table, 75 cm high. " + MADE)


def boards():
    draw = random.Random(8)
    tones = {0: Mesh(), 1: Mesh(), 2: Mesh()}
    x = -3.2
    while x < 3.2:
        z = -3 - draw.uniform(0, 2)
        while z < 4.6:
            length = draw.uniform(1.3, 2.4)
            near = min(z + length, 4.6) - .004
            tones[draw.randrange(3)].quad((x, 0, near), (x + .146, 0, near), (x + .146, 0, z),
                                          (x, 0, z))
            z += length
        x += .15
    for tone, mesh in tones.items():
        mesh.write("boards_%d" % tone, "A third of the boards. " + MADE)


blinds()
palm()
table()
boards()
