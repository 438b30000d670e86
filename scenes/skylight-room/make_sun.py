#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes skylight.pbrt (ceiling and roof with the hole), outer_walls.pbrt (black walls), sun.pbrt
(the sun, a distant light), spot_sun.pbrt (a far spot with the same irradiance) and patch.pbrt (an
area light in place of the sunlit patch on the left wall).
Run it in this folder: python3 make_sun.py. Metres throughout; the numbers below are the design."""
import math

HALF_WIDTH, DEPTH, CEILING, ROOF = 2.6, 6.4, 3.4, 3.72   # the room: x in [-2.6, 2.6], z in [0, 6.4]
HOLE_X, HOLE_Z = (-.90, .55), (2.25, 3.75)               # the skylight, in the roof's plane
TOWARDS = (-.75, -.62, -.17)                              # where sunlight goes
DISTANCE = 26.                                            # of the spot from the skylight
INTENSITY = (54000., 50000., 44000.)                      # of the spot: W / sr
SUN = tuple(i / DISTANCE ** 2 for i in INTENSITY)         # "L" of the sun: W / m2 across the beam
WALL = (.84, .82, .77)                                    # reflectance of the lit wall
THICKNESS = .3                                            # of the black outer walls, with the air
MARGIN = .08                                              # of the ceiling's hole round the beam


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
    text = "# The sun. Made by make_sun.py.\n"
    text += f'LightSource "distant" "color L" [ {numbers(*SUN)} ]\n'
    text += f'  "point from" [ {numbers(*source)} ] "point to" [ {numbers(*centre)} ]\n'
    return text + 'Include "outer_walls.pbrt"\n'


def outer_walls():
    """The sun shines on the outer sides of two walls. Photons there would leak in at the edges of the
    floor, so black walls stand before them."""
    text = "# Black walls before the right wall and the front wall. Made by make_sun.py.\n"
    text += 'AttributeBegin\nMaterial "matte" "color Kd" [ 0 0 0 ]\n'
    x0, x1, z0, z1 = -HALF_WIDTH, HALF_WIDTH, -THICKNESS, DEPTH
    w, e, low = x1 + THICKNESS, z1 + THICKNESS, -THICKNESS
    text += quad((w, low, z0), (w, low, e), (w, CEILING, e), (w, CEILING, z0))
    text += quad((w, low, e), (x0, low, e), (x0, CEILING, e), (w, CEILING, e))
    text += quad((x1, CEILING, z0), (w, CEILING, z0), (w, CEILING, e), (x1, CEILING, e))
    text += quad((x0, CEILING, z1), (x1, CEILING, z1), (x1, CEILING, e), (x0, CEILING, e))
    return text + "AttributeEnd\n"


def spot_sun():
    """The irradiance at the centre of the skylight equals the sun's."""
    axis = unit(minus(centre, source))
    reach = max(math.acos(dot(axis, unit(minus(c, source)))) for c in corners)
    angle = math.degrees(reach) + .04
    text = "# The sun as a spot light 26 m away. Its cone just encloses the skylight, so nearly half of its\n"
    text += "# photons enter the room. Made by make_sun.py.\n"
    text += f'LightSource "spot" "color I" [ {numbers(*INTENSITY)} ]\n'
    text += f'  "point from" [ {numbers(*source)} ] "point to" [ {numbers(*centre)} ]\n'
    text += f'  "float coneangle" [ {angle:.4f} ] "float conedeltaangle" [ .03 ]\n'
    return text


def patch():
    """The skylight's image along the sunlight on the wall x = -HALF_WIDTH. Sunlight is parallel, so
    the image is a parallelogram with one irradiance E = L cos, and reflects Kd / pi * E."""
    def on_wall(x, z):
        s = (-HALF_WIDTH - x) / direction[0]
        return plus((x, ROOF, z), scaled(direction, s))

    lift = (.0005, 0, 0)  # in front of the wall, so that the patch is what rays meet
    (x0, x1), (z0, z1) = HOLE_X, HOLE_Z
    p = [on_wall(*c) for c in ((x0, z0), (x0, z1), (x1, z1), (x1, z0))]
    radiance = [r / math.pi * l * -direction[0] for r, l in zip(WALL, SUN)]
    ab, ac, ad = minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0])
    area = (abs(ab[1] * ac[2] - ab[2] * ac[1]) + abs(ac[1] * ad[2] - ac[2] * ad[1])) / 2
    if ab[1] * ac[2] < ab[2] * ac[1]:  # the normal must point into the room
        p.reverse()
    text = "# The sunlit patch as an area light of radiance Kd / pi * E. It lies half a millimetre before\n"
    text += "# the wall and reflects as it does. Made by make_sun.py.\n"
    text += f'AttributeBegin\nMaterial "matte" "color Kd" [ {numbers(*WALL)} ]\n'
    text += f'AreaLightSource "area" "color L" [ {numbers(*radiance)} ]\n'
    text += quad(*[plus(corner, lift) for corner in p]) + "AttributeEnd\n"
    print("patch: y %.3f to %.3f, z %.3f to %.3f; green power %.2f W" % (
        min(c[1] for c in p), max(c[1] for c in p), min(c[2] for c in p), max(c[2] for c in p),
        area * math.pi * radiance[1]))
    return text


for name, text in (("skylight", skylight()), ("outer_walls", outer_walls()), ("sun", sun()),
                   ("spot_sun", spot_sun()), ("patch", patch())):
    with open(name + ".pbrt", "w") as out:
        out.write(text)
