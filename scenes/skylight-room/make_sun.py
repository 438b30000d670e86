#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes skylight.pbrt (ceiling and roof with the hole), sun.pbrt (the sun, a far spot),
distant_sun.pbrt (the same as a distant light) and patch.pbrt (area lights that stand for the patch
that the sun lights on the left wall).
Run it in this folder: python3 make_sun.py. Metres throughout; the numbers below are the design."""
import math

HALF_WIDTH, DEPTH, CEILING, ROOF = 2.6, 6.4, 3.4, 3.72   # the room: x in [-2.6, 2.6], z in [0, 6.4]
HOLE_X, HOLE_Z = (-.90, .55), (2.25, 3.75)               # the skylight, in the roof's plane
TOWARDS = (-.75, -.62, -.17)                              # where sunlight goes
DISTANCE = 26.                                            # of the spot from the skylight
INTENSITY = (54000., 50000., 44000.)                      # of the spot: W / sr
WALL = (.84, .82, .77)                                    # reflectance of the lit wall
THICKNESS = .3                                            # of the black outer walls, with the air
MARGIN = .08                                              # of the ceiling's hole round the beam
CELLS_Y, CELLS_Z = 6, 6                                 # area lights for the patch


def scaled(v, s):
    return tuple(x * s for x in v)


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    return scaled(v, 1 / math.sqrt(dot(v, v)))


def numbers(*values):
    return " ".join("%.7g" % v for v in values)


direction = unit(TOWARDS)
centre = (sum(HOLE_X) / 2, ROOF, sum(HOLE_Z) / 2)
source = plus(centre, scaled(direction, -DISTANCE))
corners = [(x, ROOF, z) for x in HOLE_X for z in HOLE_Z]


def onto(p, axis, value):
    """Where the ray from the spot through p meets the plane p[axis] = value."""
    d = minus(p, source)
    return plus(source, scaled(d, (value - source[axis]) / d[axis]))


def quad(a, b, c, d):
    """Two triangles; the normal points to where a, b, c run anticlockwise."""
    points = "  ".join(numbers(*p) for p in (a, b, c, d))
    return f'Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]\n  "point P" [ {points} ]\n'


def slab_with_hole(y, x0, x1, z0, z1, hx, hz):
    """Four rectangles of the plane y round a hole; their normals point downwards."""
    parts = [(x0, x1, z0, hz[0]), (x0, x1, hz[1], z1), (x0, hx[0], *hz), (hx[1], x1, *hz)]
    return "".join(quad((a, y, c), (b, y, c), (b, y, d), (a, y, d)) for a, b, c, d in parts)


def skylight():
    inside = [onto(c, 1, CEILING) for c in corners] + corners
    hx = (min(p[0] for p in inside) - MARGIN, max(p[0] for p in inside) + MARGIN)
    hz = (min(p[2] for p in inside) - MARGIN, max(p[2] for p in inside) + MARGIN)
    w = HALF_WIDTH
    text = "# Ceiling, reveal and roof round the skylight. Made by make_sun.py.\n"
    text += '# The roof is black: of the sun it lets through what passes the hole, and no more.\n'
    text += 'AttributeBegin\nMaterial "matte" "color Kd" [ 0 0 0 ]\n'
    text += slab_with_hole(ROOF, -w - .5, w + .5, -.5, DEPTH + .5, HOLE_X, HOLE_Z)
    text += "AttributeEnd\n# ceiling\n"
    text += slab_with_hole(CEILING, -w, w, 0, DEPTH, hx, hz)
    text += "# the reveal, from the ceiling's hole up to the roof\n"
    ring = [(hx[0], hz[0]), (hx[1], hz[0]), (hx[1], hz[1]), (hx[0], hz[1])]
    for (xa, za), (xb, zb) in zip(ring, ring[1:] + ring[:1]):
        text += quad((xa, CEILING, za), (xb, CEILING, zb), (xb, ROOF, zb), (xa, ROOF, za))
    return text


def sun():
    axis = unit(minus(centre, source))
    reach = max(math.acos(dot(axis, unit(minus(c, source)))) for c in corners)
    angle = math.degrees(reach) + .04
    text = "# The sun is a spot light 26 m away. Its cone just encloses the skylight, so nearly half of its\n"
    text += "# photons enter the room. Made by make_sun.py.\n"
    text += f'LightSource "spot" "color I" [ {numbers(*INTENSITY)} ]\n'
    text += f'  "point from" [ {numbers(*source)} ] "point to" [ {numbers(*centre)} ]\n'
    text += f'  "float coneangle" [ {angle:.4f} ] "float conedeltaangle" [ .03 ]\n'
    return text


def distant_sun():
    """The irradiance at the skylight equals the spot's, so the same power enters. The sun shines on
    the outer sides of two walls, which are black here: photons on them would leak in at the edges of
    the floor."""
    text = "# The sun as a distant light, and black outer walls on the sides that it shines on. Made by\n"
    text += "# make_sun.py.\n"
    text += f'LightSource "distant" "color L" [ {numbers(*scaled(INTENSITY, DISTANCE ** -2))} ]\n'
    text += f'  "point from" [ {numbers(*source)} ] "point to" [ {numbers(*centre)} ]\n'
    text += 'AttributeBegin\nMaterial "matte" "color Kd" [ 0 0 0 ]\n'
    x0, x1, z0, z1 = -HALF_WIDTH, HALF_WIDTH, -THICKNESS, DEPTH
    w, e, low = x1 + THICKNESS, z1 + THICKNESS, -THICKNESS
    text += quad((w, low, z0), (w, low, e), (w, CEILING, e), (w, CEILING, z0))
    text += quad((w, low, e), (x0, low, e), (x0, CEILING, e), (w, CEILING, e))
    text += quad((x1, CEILING, z0), (w, CEILING, z0), (w, CEILING, e), (x1, CEILING, e))
    text += quad((x0, CEILING, z1), (x1, CEILING, z1), (x1, CEILING, e), (x0, CEILING, e))
    return text + "AttributeEnd\n"


def patch():
    """The skylight's image on the wall x = -HALF_WIDTH, cell by cell: the cells are images of equal
    rectangles of the skylight, so they tile the patch exactly. Each has the radiance
    L = Kd / pi * E, E = I cos / d^2, averaged over the cell by Simpson's rule."""
    def on_wall(u, v):
        x = HOLE_X[0] + (HOLE_X[1] - HOLE_X[0]) * u
        z = HOLE_Z[0] + (HOLE_Z[1] - HOLE_Z[0]) * v
        return onto((x, ROOF, z), 0, -HALF_WIDTH)

    def per_intensity(p):
        d = minus(p, source)
        d2 = dot(d, d)
        return abs(d[0]) / math.sqrt(d2) / d2  # cos / d^2 at the wall

    lift = .0005  # in front of the wall, so that the patch is what rays meet
    text = "# The sunlit patch as area lights: radiance Kd / pi * E in every cell. They lie half a\n"
    text += "# millimetre before the wall and reflect as it does. Made by make_sun.py.\n"
    text += f'AttributeBegin\nMaterial "matte" "color Kd" [ {numbers(*WALL)} ]\n'
    power = 0
    for i in range(CELLS_Y):
        for j in range(CELLS_Z):
            u0, u1, v0, v1 = i / CELLS_Y, (i + 1) / CELLS_Y, j / CELLS_Z, (j + 1) / CELLS_Z
            e = 0
            for a, wa in ((u0, 1), ((u0 + u1) / 2, 4), (u1, 1)):
                for b, wb in ((v0, 1), ((v0 + v1) / 2, 4), (v1, 1)):
                    e += wa * wb / 36 * per_intensity(on_wall(a, b))
            radiance = [r / math.pi * e * s for r, s in zip(WALL, INTENSITY)]
            p = [plus(on_wall(a, b), (lift, 0, 0)) for a, b in ((u0, v0), (u0, v1), (u1, v1), (u1, v0))]
            ab, ac, ad = minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0])
            normal_x = ab[1] * ac[2] - ab[2] * ac[1]
            if normal_x < 0:
                p = [p[0], p[3], p[2], p[1]]
            area = (abs(ab[1] * ac[2] - ab[2] * ac[1]) + abs(ac[1] * ad[2] - ac[2] * ad[1])) / 2
            power += area * math.pi * radiance[1]
            text += f'AreaLightSource "area" "color L" [ {numbers(*radiance)} ]\n' + quad(*p)
    text += "AttributeEnd\n"
    ends = [on_wall(u, v) for u in (0, 1) for v in (0, 1)]
    print("patch: y %.3f to %.3f, z %.3f to %.3f; green power %.2f W" % (
        min(p[1] for p in ends), max(p[1] for p in ends), min(p[2] for p in ends),
        max(p[2] for p in ends), power))
    return text


for name, text in (("skylight", skylight()), ("sun", sun()), ("distant_sun", distant_sun()),
                   ("patch", patch())):
    with open(name + ".pbrt", "w") as out:
        out.write(text)
