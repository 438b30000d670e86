#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the Ferris wheel, its lamps and gondolas with their motion, the shore, and the sky.
Run it in this folder: python3 make_wheel.py. Its output is kept beside it. Metres; y points up.
The axle is at (0, HUB, 0); the wheel turns about z by TURN degrees while the shutter is open."""
import math
import os
import random
import struct
import sys
import zlib

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import Mesh, TAU, revolved, tube

MADE = "Written by make_wheel.py."
HUB, RADIUS, SPOKES, HALF_WIDTH, TURN = 13.2, 10.5, 24, .8, 8.5


def rod(mesh, a, b, radius, columns=6):
    mesh.grid(tube(lambda v: tuple(p + (q - p) * v for p, q in zip(a, b)), lambda _: radius,
                   (.31, .23, .92)), columns, 1)


def on_circle(radius, degrees, z=0.):
    t = math.radians(degrees)
    return (radius * math.cos(t), radius * math.sin(t), z)


def wheel():
    mesh = Mesh()
    for z in (-HALF_WIDTH, HALF_WIDTH):
        for radius, thickness in ((RADIUS, .085), (RADIUS - .9, .05), (5.6, .05)):
            mesh.grid(tube(lambda v: on_circle(radius, 360 * v, z), lambda _: thickness, (0, 0, 1)),
                      6, 72)
        for i in range(SPOKES):
            angle = 360 / SPOKES * i
            rod(mesh, on_circle(.5, angle, z), on_circle(RADIUS, angle, z), .03, 5)
            rod(mesh, on_circle(RADIUS - .9, angle, z), on_circle(RADIUS, angle + 180 / SPOKES, z),
                .025, 4)
            rod(mesh, on_circle(RADIUS, angle + 180 / SPOKES, z),
                on_circle(RADIUS - .9, angle + 360 / SPOKES, z), .025, 4)
    for i in range(SPOKES):
        angle = 360 / SPOKES * i
        rod(mesh, on_circle(RADIUS, angle, -HALF_WIDTH), on_circle(RADIUS, angle, HALF_WIDTH), .05)
    hub = revolved([(0, -1.1), (.55, -1.1), (.55, -1.1), (.62, -.5), (.62, .5), (.55, 1.1),
                    (.55, 1.1), (0, 1.1)])
    mesh.grid(lambda u, v: (hub(u, v)[0], hub(u, v)[2], hub(u, v)[1]), 24, 14)
    mesh.write("wheel", "The wheel about the origin. " + MADE, digits=3)

    mesh = Mesh()
    for z in (-1.9, 1.9):
        for x in (-5.4, 5.4):
            rod(mesh, (x, .6, z * 1.5), (x * .03, HUB, z * .75), .24, 10)
        rod(mesh, (-2.4, HUB * .56, z * 1.2), (2.4, HUB * .56, z * 1.2), .12, 8)
    mesh.write("stand", "The stand of the wheel. " + MADE)

    mesh = Mesh()
    body = revolved([(0, -2.1), (.55, -2.1), (.74, -1.95), (.79, -1.4)])
    mesh.grid(body, 20, 12)
    roof = revolved([(.92, -.55), (.7, -.3), (.2, -.12), (0, -.1)])
    mesh.grid(roof, 20, 10)
    for i in range(4):
        x, z = .72 * math.cos(TAU * (i + .5) / 4), .72 * math.sin(TAU * (i + .5) / 4)
        rod(mesh, (x, -1.5, z), (x, -.45, z), .03, 5)
    mesh.write("gondola", "A gondola below the point where it hangs. " + MADE, digits=3)


def moving():
    """Lamps, which turn with the wheel, and gondolas, which stay upright."""
    colours = {"warm": (15, 7.6, 2.6), "rose": (15, 2.6, 4.6), "sea": (1.6, 7.4, 9.4)}
    lamps = []
    for i in range(SPOKES):
        for radius, size, name in ((RADIUS, .15, "warm"), (8.1, .11, "sea"), (5.6, .11, "rose"),
                                   (3.2, .1, "warm")):
            if radius < 8 and i % 2:
                continue
            lamps.append('AttributeBegin AreaLightSource "area" "color L" [ %g %g %g ]\n'
                         'Translate 0 %g 0 ActiveTransform EndTime Rotate %g 0 0 1 ActiveTransform All\n'
                         'Translate %.3f %.3f %g Shape "sphere" "float radius" %g AttributeEnd\n'
                         % (*colours[name], HUB, -TURN, *on_circle(radius, 360 / SPOKES * i, HALF_WIDTH + .2),
                            size))
    with open("lamps.pbrt", "w") as file:
        file.write("# The lamps of the wheel. " + MADE + "\n" + "".join(lamps))
    with open("gondolas.pbrt", "w") as file:
        file.write("# The gondolas of the wheel. " + MADE + "\n")
        for i in range(SPOKES):
            angle = 360 / SPOKES * (i + .5)
            x0, y0, _ = on_circle(RADIUS, angle)
            x1, y1, _ = on_circle(RADIUS, angle - TURN)
            file.write('TransformBegin Translate %.3f %.3f 0 ActiveTransform EndTime '
                       'Translate %.3f %.3f 0 ActiveTransform All ObjectInstance "gondola %d" TransformEnd\n'
                       % (x0, HUB + y0, x1 - x0, y1 - y0, i % 3))


def shore():
    draw = random.Random(5)
    waves = [(.02 * 1.7 ** i, draw.uniform(0, TAU), 3.2 / 1.55 ** i) for i in range(7)]

    def hills(scale, base, shift):
        def surface(u, v):
            x = -260 + 520 * u
            y = base + scale * sum(a * math.sin(k * x + p + shift) for k, p, a in waves)
            return (x, max(y, .5) * v - .5, 0)
        return surface
    for name, scale, base, shift in (("far_hills", 2.6, 15, 0), ("near_hills", 1.2, 5.5, 2)):
        mesh = Mesh()
        mesh.grid(hills(scale, base, shift), 160, 1)
        mesh.write(name, "Hills, as a flat silhouette. " + MADE, digits=2)
    mesh = Mesh()
    mesh.grid(revolved([(.12, 0), (.1, 1.5), (1.2, 2.2), (1.75, 3.6), (1.35, 5.2), (.5, 6.3),
                        (0, 6.5)]), 12, 20)
    mesh.write("tree", "A tree. " + MADE, digits=2)
    with open("promenade.pbrt", "w") as file:
        file.write("# Trees and lamps of the promenade. " + MADE + "\n")
        for i in range(46):
            x = -72 + 3.2 * i + draw.uniform(-.8, .8)
            size = draw.uniform(.75, 1.25)
            file.write('TransformBegin Translate %.2f .5 %.2f Scale %.2f %.2f %.2f '
                       'ObjectInstance "tree" TransformEnd\n'
                       % (x, -12 + draw.uniform(-2, 2), size, size * draw.uniform(.9, 1.2), size))
        for i in range(14):
            x = -58.5 + 9 * i
            file.write('AttributeBegin AreaLightSource "area" "color L" [ 26 12.5 3.6 ] '
                       'Translate %.2f 3.4 -7 Shape "sphere" "float radius" .16 AttributeEnd\n' % x)
            file.write('AttributeBegin Translate %.2f .5 -7 Rotate -90 1 0 0 Shape "cylinder" '
                       '"float radius" .05 "float zmin" 0 "float zmax" 2.8 AttributeEnd\n' % x)


def sky():
    """A map of the sky after sunset, 128 x 256, dithered to 8 bits. The sun has set on the left."""
    width, height = 128, 256
    draw = random.Random(2)
    stops = [(-.2, (.02, .02, .03)), (0, (1, .36, .09)), (.04, (.95, .38, .13)),
             (.12, (.66, .34, .24)), (.23, (.30, .27, .36)), (.36, (.13, .19, .37)),
             (.65, (.045, .085, .22)), (1, (.02, .045, .14))]
    cold = [(-.2, (.02, .02, .03)), (0, (.30, .22, .28)), (.10, (.22, .20, .31)),
            (.36, (.09, .13, .28)), (1, (.02, .045, .14))]

    def ramp(table, x):
        for (a, p), (b, q) in zip(table, table[1:]):
            if x <= b:
                t = min(max((x - a) / (b - a), 0), 1)
                t = t * t * (3 - 2 * t) if table is cold else t
                return [m + (n - m) * t for m, n in zip(p, q)]
        return table[-1][1]
    rows = b""
    for j in range(height):
        elevation = math.sin(math.pi * (.5 - (j + .5) / height))
        row = b"\0"
        for i in range(width):
            glow = max(math.cos(TAU * (i + .5) / width - math.radians(112)), 0) ** 1.5
            both = zip(ramp(stops, elevation), ramp(cold, elevation))
            pixel = [c + (w - c) * glow for w, c in both]
            for x in pixel:
                y = 12.92 * x if x < .0031308 else 1.055 * x ** (1 / 2.4) - .055
                row += bytes([min(max(int(255 * y + draw.random()), 0), 255)])
        rows += row

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    with open("sky.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def jetty():
    with open("jetty.pbrt", "w") as file:
        file.write("# The posts of the jetty. " + MADE + "\n")
        for z in (19.3, 23, 26.7, 30.4, 34.1):
            for x in (-.85, .85):
                file.write('AttributeBegin Translate %g -.5 %g Rotate -90 1 0 0 Shape "cylinder" '
                           '"float radius" .11 "float zmin" 0 "float zmax" 2.1 Translate 0 0 2.1 '
                           'Shape "disk" "float radius" .11 AttributeEnd\n' % (x, z))


wheel()
moving()
shore()
jetty()
sky()
