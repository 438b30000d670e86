# SPDX-License-Identifier: BSD-2-Clause
"""Meshes for the scripts of the scenes: surfaces that several scenes need, and a class that collects
triangles with normals and texture coordinates and writes them as a pbrt file. y points up."""
import math

TAU = 2 * math.pi


def unit(a):
    length = math.sqrt(sum(x * x for x in a)) or 1
    return tuple(x / length for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def spline(points, t):
    """Catmull-Rom spline through the points, t in [0, 1]; a point given twice is a crease."""
    x = min(max(t, 0), 1) * (len(points) - 1)
    i = min(int(x), len(points) - 2)
    x -= i
    p = [points[min(max(j, 0), len(points) - 1)] for j in range(i - 1, i + 3)]
    if p[1] == p[2]:
        return p[1]
    p[0], p[3] = (p[1] if p[0] == p[1] else p[0]), (p[2] if p[3] == p[2] else p[3])
    return tuple(.5 * (2 * b + (c - a) * x + (2 * a - 5 * b + 4 * c - d) * x * x
                       + (3 * b - a - 3 * c + d) * x ** 3) for a, b, c, d in zip(*p))


def revolved(profile):
    """The surface of revolution about y of a profile of (radius, height)."""
    def surface(u, v):
        r, h = spline(profile, v)
        return (max(r, 0) * math.cos(TAU * u), h, max(r, 0) * math.sin(TAU * u))
    return surface


def tube(centre, radius, axis=(0, 1, 0)):
    """A tube about the curve centre(v), which is nowhere parallel to the axis; radius(v)."""
    def surface(u, v):
        e, p = 1e-4, centre(v)
        d = unit(sub(centre(v + e), centre(v - e)))
        x = unit(cross(axis, d))
        y = cross(d, x)
        c, s = radius(v) * math.cos(TAU * u), radius(v) * math.sin(TAU * u)
        return tuple(p[k] + c * x[k] + s * y[k] for k in range(3))
    return surface


class Mesh:
    """Triangles with normals and texture coordinates."""

    def __init__(self):
        self.points, self.normals, self.uvs, self.triangles = [], [], [], []

    def grid(self, surface, columns, rows, is_flipped=False):
        """Adds the surface p(u, v), u and v in [0, 1], as columns x rows quads. Normals are
        du x dv, or the opposite."""
        first, e = len(self.points), 1e-3
        for j in range(rows + 1):
            for i in range(columns + 1):
                u, v = i / columns, j / rows
                self.points.append(surface(u, v))
                self.uvs.append((u, v))
                u, v = min(max(u, 2 * e), 1 - 2 * e), min(max(v, 2 * e), 1 - 2 * e)
                n = unit(cross(sub(surface(u + e, v), surface(u - e, v)),
                               sub(surface(u, v + e), surface(u, v - e))))
                self.normals.append(tuple(-x for x in n) if is_flipped else n)
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                b, c, d = a + 1, a + columns + 2, a + columns + 1
                pair = ((a, c, b), (a, d, c)) if is_flipped else ((a, b, c), (a, c, d))
                self.triangles += [t for t in pair if len({self.rounded(k) for k in t}) == 3]

    def quad(self, a, b, c, d):
        """Adds a flat quadrilateral with u from a to b and v from a to d."""
        self.grid(lambda u, v: tuple((1 - u) * (1 - v) * p + u * (1 - v) * q + u * v * r
                                     + (1 - u) * v * s for p, q, r, s in zip(a, b, c, d)), 1, 1)

    def box(self, low, high):
        """Adds the six faces of a block; its normals look outwards."""
        (a, b, c), (d, e, f) = low, high
        self.quad((a, b, f), (d, b, f), (d, e, f), (a, e, f))
        self.quad((d, b, c), (a, b, c), (a, e, c), (d, e, c))
        self.quad((a, b, c), (a, b, f), (a, e, f), (a, e, c))
        self.quad((d, b, f), (d, b, c), (d, e, c), (d, e, f))
        self.quad((a, e, f), (d, e, f), (d, e, c), (a, e, c))
        self.quad((a, b, c), (d, b, c), (d, b, f), (a, b, f))

    def rounded(self, k):
        return tuple(round(x, 5) for x in self.points[k])

    def write(self, name, comment, has_uv=False, digits=4):
        def numbers(values, digits):
            return " ".join("%.7g" % (round(x, digits) + 0) for value in values for x in value)
        with open(name + ".pbrt", "w") as file:
            file.write("# %s\nShape \"trianglemesh\"\n\"integer indices\" [ %s ]\n"
                       "\"point P\" [ %s ]\n\"normal N\" [ %s ]\n"
                       % (comment, numbers(self.triangles, 0), numbers(self.points, digits),
                          numbers(self.normals, 3)))
            if has_uv:
                file.write("\"float uv\" [ %s ]\n" % numbers(self.uvs, 5))
