#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the shapes and pictures that are better computed than typed: meshes (jug, bowl, knot, cloth)
and images (a painting; the relief of a floor tile and of plaster, as heights).
Run it in this folder: python3 make_parts.py. Its output is kept beside it; metres throughout."""
import math
import random
import re
import struct
import zlib

from meshes import TAU, cross, spline, sub, unit


def write_surface(name, comment, surface, columns, rows):
    """The surface p(u, v), u and v in [0, 1], as a grid of triangles with normals and (u, v).
    Normals are du x dv, by differences."""
    e = 1e-4
    points, normals, uvs, triangles = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            w = min(max(v, 1e-3), 1 - 1e-3)  # at a pole the normal is that from close by
            du = sub(surface(u + e, w), surface(u - e, w))
            dv = sub(surface(u, min(w + e, 1)), surface(u, max(w - e, 0)))
            points.append(tuple(round(x, 4) for x in surface(u, v)))
            normals.append(unit(cross(du, dv)))
            uvs.append((u, v))
    for j in range(rows):
        for i in range(columns):
            a, d = j * (columns + 1) + i, (j + 1) * (columns + 1) + i
            triangles += [t for t in ((a, a + 1, d + 1), (a, d + 1, d))
                          if len({points[k] for k in t}) == 3]

    def lines(values, each):
        return "".join("    " + "  ".join(values[i:i + each]) + "\n" for i in range(0, len(values), each))

    def text(x):
        short = ("%.4f" % x).rstrip("0").rstrip(".")
        return "0" if short == "-0" else re.sub(r"^(-?)0\.", r"\1.", short)
    with open(name + ".pbrt", "w") as out:
        out.write(f"# {comment}\n# Made by make_parts.py.\nShape \"trianglemesh\"\n")
        for kind, values, each in (("integer indices", triangles, 8), ("point P", points, 5),
                                   ("normal N", normals, 5), ("float uv", uvs, 8)):
            out.write(f'  "{kind}" [\n')
            out.write(lines([" ".join(text(x) if isinstance(x, float) else str(x) for x in v)
                             for v in values], each))
            out.write("  ]\n")


def revolved(profile, deform=None):
    """The surface of revolution round y of a profile (radius, height) from pole to pole; deform(angle,
    radius, height, v) may change radius and height."""
    def surface(u, v):
        angle = -TAU * (u % 1)
        r, h = spline(profile, v)
        r, h = deform(angle, r, h, v) if deform else (r, h)
        return (max(r, 0) * math.cos(angle), h, max(r, 0) * math.sin(angle))
    return surface


def tube(centre, radius, axis):
    """A tube about the curve centre(v) that is nowhere parallel to the axis; radius(v)."""
    def surface(u, v):
        e, p = 1e-4, centre(v)
        d = unit(sub(centre(v + e), centre(v - e)))
        x = unit(cross(axis, d))
        y = cross(d, x)
        c, s = math.cos(TAU * u), math.sin(TAU * u)
        return tuple(p[k] + radius(v) * (c * x[k] + s * y[k]) for k in range(3))
    return surface


def jug():
    profile = [(0, 0), (.05, 0), (.062, .003), (.096, .05), (.109, .105), (.096, .16), (.062, .205),
               (.048, .24), (.051, .275), (.064, .3), (.061, .303), (.057, .3), (.044, .27), (.042, .24),
               (.056, .205), (.09, .16), (.1, .105), (.08, .045), (.05, .016), (0, .012)]

    def lip(angle, r, h, v):  # towards +x, where the rim is
        pull = max(0.0, math.cos(angle)) ** 10 * math.exp(-((v - .53) / .075) ** 2)
        return r + .04 * pull, h + .02 * pull
    write_surface("jug", "A jug with a lip towards +x, 30 cm high, standing on y = 0.",
                  revolved(profile, lip), 36, 46)

    def handle(v):
        angle = math.radians(112 - 236 * v)
        return (-.078 - .062 * math.cos(angle), .185 + .078 * math.sin(angle), 0)
    write_surface("jug_handle", "The jug's handle, on the -x side.",
                  tube(handle, lambda v: .0105 + .006 * (2 * v - 1) ** 2, (0, 0, 1)), 10, 18)


def bowl():
    profile = [(0, 0), (.055, 0), (.066, .002), (.062, .018), (.1, .032), (.142, .065), (.17, .112),
               (.171, .119), (.166, .119), (.136, .074), (.095, .043), (.05, .03), (0, .028)]
    write_surface("bowl", "A bowl on a foot, 12 cm high, standing on y = 0.", revolved(profile), 36, 36)


def knot():
    def trefoil(v):
        a = TAU * v
        r = .17 + .08 * math.cos(3 * a)
        return (r * math.cos(2 * a), r * math.sin(2 * a), .085 * math.sin(3 * a))
    write_surface("knot", "A trefoil knot in the plane z = 0, about 60 cm across, centred on the origin.",
                  tube(trefoil, lambda v: .05 + .008 * math.cos(3 * TAU * v), (0, 0, 1)), 14, 120)


def cloth():
    width, top, drop = .74, .80, .50

    def surface(u, v):
        x, s = (u - .5) * width, v * (top + drop) - top  # s: length along the cloth, < 0 on the table
        flat = .004 + .0015 * math.sin(19 * x + 7 * s) * math.sin(5 * s + 1)
        if s <= 0:
            return (x + .008 * math.sin(6 * s), flat, s)
        fold = min(1, s / .3)
        fold = fold * fold * (3 - 2 * fold)
        angle = min(s / .02, math.pi / 2)  # round the edge on a radius of 2 cm
        drape = max(0, s - .02 * math.pi / 2)
        ripple = .030 * math.sin(29 * x + .8 + 2 * s) + .012 * math.sin(53 * x + 2)
        return (x * (1 - .07 * fold) + .008 * fold * math.cos(29 * x),
                flat - .02 * (1 - math.cos(angle)) - drape,
                .02 * math.sin(angle) + (.032 + ripple) * fold)
    write_surface("cloth", "A cloth, 74 cm wide, that lies on y = 0 and hangs down in folds beyond z = 0.",
                  lambda u, v: surface(u, 1 - v), 48, 44)


def write_png(name, width, height, colour):
    """colour(x, y) in [0, 1): a tuple of 3 values in [0, 1], as they are to be stored."""
    rows = b""
    for y in range(height):
        rows += b"\0" + b"".join(
            bytes(min(255, max(0, round(255 * c))) for c in colour((x + .5) / width, (y + .5) / height))
            for x in range(width))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    with open(name, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def painting(x, y):
    """Hills in the haze at dusk."""
    sky = mix((.30, .42, .56), (.93, .74, .52), min(1, y / .62) ** 1.3)
    sun = math.hypot((x - .66) * 1.33, y - .43)
    colour = mix((1, .93, .76), sky, min(1, max(0, (sun - .055) / .008)))
    if sun > .063:
        colour = mix(colour, (1, .86, .62), .5 * math.exp(-((sun - .06) / .10) ** 2))
    hills = [(.52, .050, 3.1, .4, (.68, .62, .58)), (.60, .065, 4.3, 2.0, (.47, .50, .53)),
             (.70, .060, 5.9, 4.1, (.30, .37, .41)), (.82, .075, 3.7, 5.3, (.16, .22, .25))]
    for level, height, pitch, phase, shade in hills:
        ridge = level - height * (math.sin(pitch * x * 2 + phase) + .5 * math.sin(pitch * 5.3 * x + 2 * phase)
                                  + .18 * math.sin(pitch * 13 * x + phase))
        if y > ridge:
            haze = math.exp(-(y - ridge) / .09)
            colour = mix(shade, (.86, .72, .58), .30 * (1 - haze))
    return colour


def tile(x, y):
    """Height of one tile: a worn slab with rounded edges between joints; nearly flat inside."""
    edge = min(x, 1 - x, y, 1 - y)
    bevel = min(1, max(0, (edge - .012) / .035))
    h = .12 + .80 * (bevel * bevel * (3 - 2 * bevel))
    h += .05 * math.sin(TAU * (x + .3)) * math.sin(TAU * (y + .15)) * bevel
    return (h, h, h)


def plaster(x, y):
    """Height of trowelled plaster; repeats."""
    h = 0
    for octave, weight in ((4, .45), (9, .3), (21, .16), (43, .09)):
        for a, b, phase in WAVES[octave]:
            h += weight * math.sin(TAU * (a * x + b * y) + phase) / len(WAVES[octave])
    return (.5 + 1.1 * h,) * 3


RANDOM = random.Random(7)
WAVES = {n: [(RANDOM.randint(-n, n), RANDOM.randint(-n, n), TAU * RANDOM.random()) for _ in range(7)]
         for n in (4, 9, 21, 43)}

jug()
bowl()
knot()
cloth()
write_png("painting.png", 320, 240, painting)
write_png("tile_height.png", 160, 160, tile)
write_png("plaster_height.png", 256, 256, plaster)
