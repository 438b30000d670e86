#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the meshes of the swimming hall: the water, one bay of the hall, a ladder, the floats.
Run it in this folder: python3 make_hall.py. Its output is kept beside it. Metres; y points up.
The hall is 18 m wide (x from -9 to 9). A bay is 4 m long (z from -2 to 2)."""
import math
import os
import random
import struct
import sys
import zlib

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import Mesh, TAU, revolved, tube

MADE = "Written by make_hall.py."
HALF_WIDTH, HALF_BAY, WALL, THICK = 9., 2., 5.7, .45
SILL, SPRING, RADIUS = .55, 3.6, 1.35        # of a window
VAULT_RISE = 2.9
POOL = (-5., 5., -27., -2.)                  # x and z of the water
WATER, SPACING, CURVATURE = -.14, .19, .6    # level; cells of the control mesh; rms of 1 / radius


def waves(count=42):
    """Sines with random directions; the amplitude falls with the square of the wave number."""
    draw = random.Random(4)
    result = []
    for i in range(count):
        length = .8 * (3.4 / .8) ** ((i + draw.random()) / count)
        angle, k = draw.uniform(0, TAU), TAU / length
        result.append((k * math.cos(angle), k * math.sin(angle), draw.uniform(0, TAU),
                       CURVATURE * math.sqrt(2 / count) / k ** 2))
    return result


def water():
    columns = round((POOL[1] - POOL[0]) / SPACING)
    rows = round((POOL[3] - POOL[2]) / SPACING)
    spectrum, points, triangles = waves(), [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            x = POOL[0] + (POOL[1] - POOL[0]) * i / columns
            z = POOL[3] - (POOL[3] - POOL[2]) * j / rows
            y = WATER + sum(a * math.sin(kx * x + kz * z + phase) for kx, kz, phase, a in spectrum)
            points.append("%.3f %.4f %.3f" % (x, y, z))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            triangles.append("%d %d %d %d %d %d" % (a, a + 1, a + columns + 2, a, a + columns + 2,
                                                    a + columns + 1))
    with open("water.pbrt", "w") as file:
        file.write("# The surface of the water. %s\nShape \"loopsubdiv\" \"integer nlevels\" [ 2 ]\n"
                   "\"integer indices\" [ %s ]\n\"point P\" [ %s ]\n"
                   % (MADE, " ".join(triangles), " ".join(points)))


def bay():
    """The right wall of a bay with its window."""
    mesh = Mesh()
    near, far = HALF_WIDTH, HALF_WIDTH + THICK
    for side in (-1, 1):
        z = sorted((side * RADIUS, side * HALF_BAY))
        mesh.box((near, 0, z[0]), (far, SPRING, z[1]))
    mesh.box((near, 0, -RADIUS), (far, SILL, RADIUS))

    def arch(x):
        def surface(u, v):
            angle = math.pi * u
            z, y = -RADIUS * math.cos(angle), SPRING + RADIUS * math.sin(angle)
            outer_z, outer_y = z * HALF_BAY / RADIUS, WALL
            return (x, y + (outer_y - y) * v, z + (outer_z - z) * v)
        return surface
    mesh.grid(arch(near), 24, 1)
    mesh.grid(arch(far), 24, 1)
    mesh.grid(lambda u, v: (near + (far - near) * v, SPRING + RADIUS * math.sin(math.pi * u),
                            -RADIUS * math.cos(math.pi * u)), 24, 1)
    mesh.write("wall", "The wall of a bay with its window. " + MADE)

    mesh = Mesh()
    for z in (-.45, .45):
        mesh.box((far - .2, SILL, z - .03), (far - .12, SPRING + 1.27, z + .03))
    for y in (1.6, 2.6, 3.6):
        mesh.box((far - .2, y - .03, -RADIUS), (far - .12, y + .03, RADIUS))
    mesh.write("bars", "The bars of a window. " + MADE)

    mesh = Mesh()
    mesh.grid(lambda u, v: vault(u, 0, (2 * v - 1) * HALF_BAY), 40, 1)
    mesh.write("vault", "The vault over a bay. " + MADE)
    mesh = Mesh()
    for low, high, z in ((0, .22, -.3), (0, .22, .3)):
        mesh.grid(lambda u, v: vault(u, low + (high - low) * v, z), 40, 1)
    mesh.grid(lambda u, v: vault(u, .22, (2 * v - 1) * .3), 40, 1)
    for side in (-1, 1):
        x = sorted((side * (HALF_WIDTH - .22), side * HALF_WIDTH))
        mesh.box((x[0], 0, -.3), (x[1], WALL, .3))
        x = sorted((side * (HALF_WIDTH - .34), side * HALF_WIDTH))
        mesh.box((x[0], WALL - .22, -.42), (x[1], WALL, .42))
    mesh.write("rib", "A rib of the vault between two bays, with its pilasters. " + MADE)


def vault(u, depth, z):
    angle = math.pi * u
    return ((HALF_WIDTH - depth) * math.cos(angle), WALL + (VAULT_RISE - depth) * math.sin(angle), z)


def end():
    """The far wall, with a large arched window."""
    mesh = Mesh()

    def surface(u, v):
        angle = math.pi * u
        x, y = 3.6 * math.cos(angle), WALL - .75 + 2.7 * math.sin(angle)
        ox, oy, oz = vault(u, 0, 0)
        return (x + (ox - x) * v, y + (oy - y) * v, 0)
    mesh.grid(surface, 40, 1)
    mesh.quad((-9, 0, 0), (9, 0, 0), (9, WALL - .75, 0), (-9, WALL - .75, 0))
    for side in (-1, 1):
        mesh.quad((3.6 * side, WALL - .75, 0), (9 * side, WALL - .75, 0), (9 * side, WALL, 0),
                  (9 * side, WALL, 0))
    mesh.grid(lambda u, v: (3.6 * math.cos(math.pi * u), WALL - .75 + 2.7 * math.sin(math.pi * u),
                            -.4 * v), 40, 1)
    mesh.write("end", "The far wall with its window. " + MADE)
    mesh = Mesh()
    for x in (-1.8, -.6, .6, 1.8):
        mesh.box((x - .05, WALL - .75, -.3), (x + .05, WALL + 1.9, -.2))
    mesh.box((-3.6, WALL + .4, -.3), (3.6, WALL + .5, -.2))
    mesh.write("end_bars", "The bars of the far window. " + MADE)


def ladder():
    mesh = Mesh()

    def arm(v):
        angle = math.pi * min(max((v - .35) / .3, 0), 1)
        x = .3 * (1 - math.cos(angle)) - .3
        y = .75 + .3 * math.sin(angle) + min(v - .35, 0) * 4.2 + min(.65 - v, 0) * 2.2
        return (x, y, 0)
    for z in (-.26, .26):
        mesh.grid(lambda u, v: tuple(a + b for a, b in zip(tube(arm, lambda _: .022, (0, 0, 1))(u, v),
                                                           (0, 0, z))), 10, 48)
    for y in (-.3, -.6, -.9):
        mesh.box((-.34, y, -.26), (-.2, y + .03, .26))
    mesh.write("ladder", "A ladder at the edge of the pool. " + MADE)


def floats():
    mesh = Mesh()
    disk = revolved([(0, -.045), (.03, -.045), (.052, -.02), (.052, .02), (.03, .045), (0, .045)])
    mesh.grid(lambda u, v: (disk(u, v)[0], disk(u, v)[2], disk(u, v)[1]), 14, 10)
    mesh.write("float", "A float of the lane ropes. " + MADE)
    mesh = Mesh()
    mesh.grid(tube(lambda v: (.29 * math.cos(TAU * v), .29 * math.sin(TAU * v), 0), lambda _: .075,
                   (0, 0, 1)), 16, 48)
    mesh.write("ring", "A life buoy. " + MADE)


def ropes():
    """Two ropes with a float every 12 cm; 4 red ones, then 8 white ones."""
    with open("ropes.pbrt", "w") as file:
        file.write("# The floats of the lane ropes. " + MADE + "\n")
        for x in (-1.67, 1.67):
            for i in range(206):
                file.write("TransformBegin Translate %g %g %.2f ObjectInstance \"%s float\" "
                           "TransformEnd\n" % (x, WATER + .015, POOL[3] - .15 - .12 * i,
                                               "red" if i % 12 < 4 else "white"))


def sun():
    """A map of the sky that is black but for the sun: a grey PNG of 512 x 256."""
    rows = [bytearray(b"\0" * 513) for _ in range(256)]
    for row in (127, 128):
        for column in (255, 256):
            rows[row][1 + column] = 255

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    with open("sun.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", 512, 256, 8, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


water()
bay()
end()
ladder()
floats()
ropes()
sun()
