#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the shapes and pictures that are better computed than typed: control cages for
"loopsubdiv" (jug, bowl, knot, cloth) and two images (a painting, one floor tile's relief).
Run it in this folder: python3 make_parts.py. Its output is kept beside it; metres throughout."""
import math
import struct
import zlib

TAU = 2 * math.pi


def write_cage(name, comment, points, triangles, levels):
    with open(name + ".pbrt", "w") as out:
        out.write(f"# {comment}\n# Made by make_parts.py.\n")
        out.write(f'Shape "loopsubdiv" "integer nlevels" [ {levels} ]\n  "integer indices" [\n')
        for i in range(0, len(triangles), 6):
            out.write("    " + "  ".join("%d %d %d" % t for t in triangles[i:i + 6]) + "\n")
        out.write('  ]\n  "point P" [\n')
        for i in range(0, len(points), 4):
            out.write("    " + "  ".join("%.5g %.5g %.5g" % p for p in points[i:i + 4]) + "\n")
        out.write("  ]\n")


def quads_to_triangles(rows, columns, close_rows, close_columns, flip=False):
    """Triangles of a grid of points, row by row, that may close on itself either way."""
    triangles = []
    for i in range(rows if close_rows else rows - 1):
        for j in range(columns if close_columns else columns - 1):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = (i + 1) % rows * columns + (j + 1) % columns, (i + 1) % rows * columns + j
            # Every other diagonal the other way, which Loop's rule keeps rounder.
            pair = [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
            triangles += [(p, r, q) for p, q, r in pair] if flip else pair
    return triangles


def revolve(profile, segments, spout=None):
    """A closed surface of revolution round y: the profile runs from pole to pole (radius, height);
    its first and last points lie on the axis. spout(ring, angle, radius, height) may deform."""
    points, triangles = [(0, profile[0][1], 0)], []
    for ring, (r, h) in enumerate(profile[1:-1]):
        for s in range(segments):
            angle = TAU * s / segments
            rr, hh = spout(ring, angle, r, h) if spout else (r, h)
            points.append((rr * math.cos(angle), hh, -rr * math.sin(angle)))
    rings = len(profile) - 2
    points.append((0, profile[-1][1], 0))
    for s in range(segments):
        triangles.append((0, 1 + (s + 1) % segments, 1 + s))
        last = 1 + (rings - 1) * segments
        triangles.append((len(points) - 1, last + s, last + (s + 1) % segments))
    for a, b, c in quads_to_triangles(rings, segments, False, True):
        triangles.append((a + 1, b + 1, c + 1))
    return points, triangles


def tube(centre, radius, along, around, closed):
    """A tube about the curve centre(t), t in [0, 1]; radius(t)."""
    points = []
    for i in range(along):
        t = i / along if closed else i / (along - 1)
        e = 1e-4
        p, q = centre(t), centre(t + e)
        d = [b - a for a, b in zip(p, q)]
        n = math.sqrt(sum(x * x for x in d))
        d = [x / n for x in d]
        u = [d[1], -d[0], 0] if abs(d[2]) < .9 else [0, d[2], -d[1]]
        # A frame that turns smoothly along these curves: perpendicular to a fixed axis.
        axis = (0, 0, 1) if abs(d[2]) < .9 else (1, 0, 0)
        u = [axis[1] * d[2] - axis[2] * d[1], axis[2] * d[0] - axis[0] * d[2],
             axis[0] * d[1] - axis[1] * d[0]]
        n = math.sqrt(sum(x * x for x in u))
        u = [x / n for x in u]
        v = [d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]]
        for j in range(around):
            c, s = math.cos(TAU * j / around), math.sin(TAU * j / around)
            points.append(tuple(p[k] + radius(t) * (c * u[k] + s * v[k]) for k in range(3)))
    return points, quads_to_triangles(along, around, closed, True)


def jug():
    def pour(ring, angle, r, h):  # a lip at the rim, on the +x side
        lip = max(0.0, math.cos(angle)) ** 8
        reach = {6: .25, 7: 1, 8: .9, 9: .2}.get(ring, 0)
        return r + .035 * lip * reach, h + .018 * lip * reach
    profile = [(0, 0), (.055, 0), (.064, .004), (.098, .06), (.108, .115), (.085, .18), (.048, .235),
               (.046, .265), (.062, .298), (.056, .298), (.039, .265), (.041, .235), (.07, .18),
               (.09, .115), (.08, .06), (.045, .018), (0, .014)]
    write_cage("jug", "A jug with a lip towards +x, 30 cm high, standing on y = 0.",
               *revolve(profile, 16, pour), 2)

    def handle(t):
        angle = math.radians(100 - 205 * t)
        return (-.062 - .075 * math.sin(math.pi * min(1, t)) ** .8 - .02 * (1 - t) * t,
                .18 + .082 * math.sin(angle), 0)
    write_cage("jug_handle", "The jug's handle, on the -x side.",
               *tube(handle, lambda t: .0125 + .003 * abs(2 * t - 1), 12, 6, False), 2)


def bowl():
    profile = [(0, .0), (.06, 0), (.066, .004), (.06, .018), (.1, .034), (.148, .075), (.172, .115),
               (.168, .121), (.161, .115), (.138, .08), (.094, .045), (.05, .032), (0, .03)]
    write_cage("bowl", "A bowl on a foot, 12 cm high, standing on y = 0.", *revolve(profile, 16), 2)


def knot():
    def trefoil(t):
        a = TAU * t
        r = .17 + .075 * math.cos(3 * a)
        return (r * math.cos(2 * a), r * math.sin(2 * a), .075 * math.sin(3 * a))
    write_cage("knot", "A trefoil knot in the plane z = 0, about 58 cm across, centred on the origin.",
               *tube(trefoil, lambda t: .046 + .010 * math.cos(3 * TAU * t), 48, 8, True), 2)


def cloth():
    """Lies on y = 0 for z < 0 and hangs over an edge along x at z = 0 in folds."""
    width, top, drop, columns, rows = .74, .80, .52, 40, 30
    points = []
    for i in range(rows):
        s = i / (rows - 1) * (top + drop) - top  # length along the cloth, < 0: on the table
        for j in range(columns):
            x = (j / (columns - 1) - .5) * width
            if s <= 0:
                wave = .0025 * math.sin(19 * x + 7 * s) * math.sin(5 * s + 1)
                points.append((x + .01 * math.sin(6 * s), .006 + wave, s))
                continue
            bend = min(1, s / .03)
            fold = min(1, s / .3)
            ripple = (.034 * math.sin(29 * x + .8 + 2 * s) + .012 * math.sin(53 * x + 2)) * fold
            points.append((x * (1 - .07 * fold) + .008 * fold * math.cos(29 * x),
                           .006 - max(0, s - .012), .016 * bend + (.035 + ripple) * fold))
    write_cage("cloth", "A cloth, 74 cm wide, that lies on y = 0 and hangs down in folds beyond z = 0.",
               points, quads_to_triangles(rows, columns, False, False, True), 1)


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


jug()
bowl()
knot()
cloth()
write_png("painting.png", 320, 240, painting)
write_png("tile_height.png", 160, 160, tile)
