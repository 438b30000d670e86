#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the gates of the corridor, its lanterns, the ground and the trees.
Run it in this folder: python3 make_corridor.py. Its output is kept beside it. Metres; y points up.
The path bends to the right with a radius of 150 m and climbs slowly."""
import math
import os
import random
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import Mesh, revolved

MADE = "Written by make_corridor.py."
GATES, SPACING, RADIUS = 91, 1.15, 150.


def way(s, x=0., y=0.):
    """The point x metres to the right of the path and y metres above it, after s metres."""
    angle = s / RADIUS
    rise = max(s - 10, 0) ** 2 / 900
    return (RADIUS - (RADIUS - x) * math.cos(angle), y + rise, -(RADIUS - x) * math.sin(angle))


def gate():
    mesh = Mesh()
    for side in (-1, 1):
        post = revolved([(.125, 0), (.125, 3)])
        mesh.grid(lambda u, v: (post(u, v)[0] + side * 1.32, post(u, v)[1], post(u, v)[2]), 20, 1)
    mesh.box((-1.5, 2.42, -.05), (1.5, 2.62, .05))
    mesh.box((-.13, 2.62, -.04), (.13, 2.9, .04))
    mesh.write("gate", "The posts and the tie beam of a gate. " + MADE)

    mesh = Mesh()
    for side in (-1, 1):
        post = revolved([(.16, 0), (.16, .38), (.16, .38), (.125, .38)])
        mesh.grid(lambda u, v: (post(u, v)[0] + side * 1.32, post(u, v)[1], post(u, v)[2]), 20, 3)

    def top(u, v, low, high, depth):
        x = -1.85 + 3.7 * u
        lift = .14 * (x / 1.85) ** 4
        corner = [(low, -depth), (high, -depth * 1.3), (high, depth * 1.3), (low, depth),
                  (low, -depth)]
        i = min(int(v * 4), 3)
        y, z = (a + (b - a) * (v * 4 - i) for a, b in zip(corner[i], corner[i + 1]))
        return (x, 2.88 + lift + y, z)
    for side in range(4):
        mesh.grid(lambda u, v: top(u, (side + v) / 4, 0, .22, .12), 16, 1)
    for u in (0, 1):
        mesh.quad(*(top(u, v / 4, 0, .22, .12) for v in range(4)))
    mesh.write("dark", "The feet and the top beam of a gate. " + MADE)

    mesh = Mesh()
    cap = revolved([(0, -.165), (.06, -.165), (.07, -.13), (.06, -.12)])
    mesh.grid(cap, 12, 6)
    lid = revolved([(.06, .12), (.07, .13), (.06, .165), (0, .165)])
    mesh.grid(lid, 12, 6)
    for y in (-.096, -.064, -.032, 0, .032, .064, .096):
        r = .13 * math.sqrt(1 - (y / .143) ** 2)
        mesh.grid(revolved([(r - .002, y - .003), (r + .004, y), (r + .004, y),
                            (r - .002, y + .003)]), 20, 3)
    mesh.write("cap", "The two ends of a lantern, and the hoops between them. " + MADE)


def lanterns():
    places = [(side * 1.06, y) for side in (-1, 1) for y in (2.12, 1.76, 1.4)]
    places += [(x, 2.2) for x in (-.76, -.38, 0, .38, .76)]
    draw = random.Random(7)
    colours = [(3.8, 1.5, .36), (3.5, 1.15, .22), (4, 2, .68), (3, .55, .13)]
    lights, caps = [], []
    for i in range(GATES):
        s = i * SPACING
        for x, y in places:
            x, y = x + draw.uniform(-.02, .02), y + draw.uniform(-.03, .03)
            p = "%.3f %.3f %.3f" % way(s + .55 + draw.uniform(-.05, .05), x, y)
            colour = draw.choices(colours, (5, 4, 3, 2))[0]
            scale = draw.uniform(.7, 1.2)
            lights.append('AreaLightSource "area" "color L" [ %.3g %.3g %.3g ] TransformBegin '
                          'Translate %s Scale 1 1.1 1 Shape "sphere" "float radius" .13 TransformEnd\n'
                          % (*(scale * c for c in colour), p))
            caps.append('TransformBegin Translate %s ObjectInstance "cap" TransformEnd\n' % p)
    with open("lanterns.pbrt", "w") as file:
        file.write("# %d lanterns. %s\nAttributeBegin\nMaterial \"matte\" \"color Kd\" [ .6 .4 .25 ]\n"
                   "%sAttributeEnd\n" % (len(lights), MADE, "".join(lights)))
    with open("gates.pbrt", "w") as file:
        file.write("# The gates, and the ends of the lanterns. " + MADE + "\n")
        for i in range(GATES):
            s = i * SPACING
            file.write('TransformBegin Translate %.3f %.3f %.3f Rotate %.3f 0 1 0 '
                       'ObjectInstance "gate" TransformEnd\n' % (*way(s), -math.degrees(s / RADIUS)))
        file.write("".join(caps))


def ground():
    mesh = Mesh()
    mesh.grid(lambda u, v: way(-6 + 116 * v, -1.75 + 3.5 * u), 2, 58)
    mesh.write("way", "The path; u runs across it. " + MADE, has_uv=True)
    mesh = Mesh()
    draw = random.Random(3)
    bumps = [(draw.uniform(-.9, .9), draw.uniform(-.9, .9), draw.uniform(0, 6)) for _ in range(6)]

    def earth(u, v):
        s, x = -6 + 116 * v, -26 + 52 * u
        far = max(abs(x) - 1.6, 0)
        waves = sum(math.sin(a * x + b * s + c) for a, b, c in bumps)
        return way(s, x, -.05 + min(far, 3) * (.03 + .02 * waves) + .05 * max(far - 3, 0))
    mesh.grid(earth, 40, 80)
    mesh.write("earth", "The ground beside the path. " + MADE, digits=2)


def trees():
    mesh = Mesh()
    trunk = revolved([(.34, -.5), (.25, .1), (.21, 1), (.19, 4), (.16, 9), (.1, 16)])
    mesh.grid(trunk, 14, 20)
    mesh.write("trunk", "The trunk of a tree. " + MADE)
    draw = random.Random(12)
    with open("trees.pbrt", "w") as file:
        file.write("# The trees. " + MADE + "\n")
        for _ in range(260):
            side, s = draw.choice((-1, 1)), draw.uniform(-3, 108)
            x = side * (2.6 + 15 * draw.random() ** 1.6)
            file.write('TransformBegin Translate %.2f %.2f %.2f Rotate %.0f 0 1 0 Rotate %.1f 1 0 0 '
                       'Scale %.2f 1 %.2f ObjectInstance "trunk" TransformEnd\n'
                       % (*way(s, x), draw.uniform(0, 360), draw.uniform(-2, 2),
                          *(2 * [draw.uniform(.6, 1.3)])))


gate()
lanterns()
ground()
trees()
