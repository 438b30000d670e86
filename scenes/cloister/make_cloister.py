#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the meshes of the cloister: parts of one bay, and shapes of revolution.
Run it in this folder: python3 make_cloister.py. Its output is kept beside it. Metres; y points up.
A bay is 3 m long (z from -1.5 to 1.5) and 3.2 m wide (x from 0, the wall, to 3.2, the arcade)."""
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "parts"))
from meshes import cross, sub, unit

WIDTH, HALF_BAY = 3.2, 1.5
ARCH_RADIUS, ARCH_SPRING = 1.22, 2.75
ARCADE_NEAR, ARCADE_FAR, WALL_TOP = 3.2, 3.7, 5.3
VAULT_SPRING, VAULT_RISE = 3.1, 1.75


class Mesh:
    """Triangles with normals; grid() adds a surface p(i, j) of (columns + 1) x (rows + 1) points."""

    def __init__(self):
        self.points, self.normals, self.triangles = [], [], []

    def grid(self, surface, columns, rows, is_flipped=False):
        first = len(self.points)
        e = 1e-3
        for j in range(rows + 1):
            for i in range(columns + 1):
                u, v = i / columns, j / rows
                self.points.append(surface(u, v))
                u, v = min(max(u, 2 * e), 1 - 2 * e), min(max(v, 2 * e), 1 - 2 * e)
                n = unit(cross(sub(surface(u + e, v), surface(u - e, v)),
                               sub(surface(u, v + e), surface(u, v - e))))
                self.normals.append(tuple(-x for x in n) if is_flipped else n)
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                b, c, d = a + 1, a + columns + 2, a + columns + 1
                self.triangles += [t for t in ((a, b, c), (a, c, d))
                                   if len({self.rounded(k) for k in t}) == 3]

    def rounded(self, k):
        return tuple(round(x, 4) for x in self.points[k])

    def write(self, name, comment):
        def numbers(values, digits):
            return " ".join("%g" % (round(x, digits) + 0) for value in values for x in value)
        with open(name + ".pbrt", "w") as file:
            file.write("# %s Written by make_cloister.py.\nShape \"trianglemesh\"\n"
                       "\"integer indices\" [ %s ]\n\"point P\" [ %s ]\n\"normal N\" [ %s ]\n"
                       % (comment, numbers(self.triangles, 0), numbers(self.points, 4),
                          numbers(self.normals, 2)))


def on_circle(profile_radius, angle):
    return profile_radius * math.cos(angle), profile_radius * math.sin(angle)


def revolved(profile, sectors, steps=4):
    """The profile is a list of runs of (radius, height); runs meet in creases."""
    mesh = Mesh()
    for run in profile:
        def surface(u, v, run=run):
            x = min(max(v, 0), 1) * (len(run) - 1)
            i = min(int(x), len(run) - 2)
            p = [run[min(max(k, 0), len(run) - 1)] for k in range(i - 1, i + 3)]
            x -= i
            r, y = (.5 * (2 * b + (c - a) * x + (2 * a - 5 * b + 4 * c - d) * x * x
                          + (3 * b - a - 3 * c + d) * x ** 3) for a, b, c, d in zip(*p))
            return (r * math.cos(2 * math.pi * u), y, -r * math.sin(2 * math.pi * u))
        mesh.grid(surface, sectors, steps * (len(run) - 1) if len(run) > 2 else 1)
    return mesh


def arcade():
    """The wall above the columns with a round arch, its underside, and a moulding on each face."""
    mesh = Mesh()

    def edge(angle):  # of the rectangle round the arch, seen from its centre
        c, s = math.cos(angle), math.sin(angle)
        scale = min(HALF_BAY / max(abs(c), 1e-9), (WALL_TOP - ARCH_SPRING) / max(s, 1e-9))
        return scale * c, scale * s
    corner = math.atan2(WALL_TOP - ARCH_SPRING, HALF_BAY)
    for begin, end in ((0, corner), (corner, math.pi - corner), (math.pi - corner, math.pi)):
        def face(u, v, x, begin=begin, end=end):
            angle = begin + (end - begin) * u
            z, y = edge(angle)
            cz, cy = on_circle(ARCH_RADIUS, angle)
            return (x, ARCH_SPRING + cy + (y - cy) * v, cz + (z - cz) * v)
        mesh.grid(lambda u, v: face(u, v, ARCADE_NEAR), 16, 1)
        mesh.grid(lambda u, v: face(u, v, ARCADE_FAR), 16, 1, True)

    def underside(u, v):
        z, y = on_circle(ARCH_RADIUS, math.pi * u)
        return (ARCADE_NEAR + (ARCADE_FAR - ARCADE_NEAR) * v, ARCH_SPRING + y, z)
    mesh.grid(underside, 48, 1)
    for x in (ARCADE_NEAR, ARCADE_FAR):
        def moulding(u, v, x=x):
            y, out = on_circle(.055, 2 * math.pi * v)
            z, height = on_circle(ARCH_RADIUS + .075 + y, math.pi * u)
            return (x + out, ARCH_SPRING + height, z)
        mesh.grid(moulding, 48, 10, True)
    return mesh


def vault_height(u, v):
    return VAULT_SPRING + VAULT_RISE * math.sqrt(max(1 - min(u * u, v * v), 0))


def at(u, v, lower=0.):
    return (WIDTH / 2 * (1 + u), vault_height(u, v) - lower, HALF_BAY * v)


def vault():
    """A groin vault: two crossing barrels. Each of its four webs is a smooth surface."""
    mesh = Mesh()
    for axis, side in ((0, -1), (0, 1), (1, -1), (1, 1)):
        def web(s, t, axis=axis, side=side):
            far, across = side * s, s * math.sin((t - .5) * math.pi)
            return at(far, across) if axis == 0 else at(across, far)
        mesh.grid(web, 10, 24, (side == 1) != (axis == 0))
    return mesh


def ribs():
    """Ribs along both groins, and one across the walk at the end of the bay."""
    mesh = Mesh()
    for path, radius in ((lambda a: at(-math.cos(a), -math.cos(a), .03), .075),
                         (lambda a: at(-math.cos(a), math.cos(a), .03), .075),
                         (lambda a: (WIDTH / 2 * (1 - math.cos(a)),
                                     VAULT_SPRING + VAULT_RISE * math.sin(a) - .03, -HALF_BAY), .11)):
        chord = sub(path(math.pi), path(0))
        side = unit((-chord[2], 0, chord[0]))  # level, across the rib

        def tube(u, v, path=path, radius=radius, side=side):
            a = math.pi * u
            up = cross(side, unit(sub(path(a + .01), path(a - .01))))
            c, s = on_circle(radius, 2 * math.pi * v)
            return tuple(p + c * x + s * y for p, x, y in zip(path(a), side, up))
        mesh.grid(tube, 32, 12)
    return mesh


def sphere_clump(seed):
    """A leafy crown: a sphere with a few waves."""
    def surface(u, v):
        phi, theta = 2 * math.pi * u, math.pi * v
        r = 1 + .10 * math.sin(5 * phi + seed) * math.sin(4 * theta) + \
            .07 * math.sin(11 * phi) * math.sin(9 * theta + seed)
        return (r * math.sin(theta) * math.cos(phi), r * math.cos(theta),
                r * math.sin(theta) * math.sin(phi))
    mesh = Mesh()
    mesh.grid(surface, 40, 24)
    return mesh


def main():
    arcade().write("arcade", "The arcade wall of one bay.")
    vault().write("vault", "The groin vault of one bay.")
    ribs().write("ribs", "The ribs of one bay.")
    revolved([[(.17, .85), (.17, .91)], [(.17, .91), (.185, .935), (.17, .96), (.125, .975)],
              [(.125, .975), (.12, .99), (.125, 1.005), (.15, 1.02), (.15, 1.045), (.12, 1.06)],
              [(.1, 1.06), (.1, 1.4), (.098, 1.8), (.09, 2.28)],
              [(.09, 2.28), (.115, 2.295), (.115, 2.31), (.09, 2.325)],
              [(.09, 2.325), (.1, 2.39), (.14, 2.47), (.185, 2.53), (.19, 2.6)]],
             24, 2).write("column", "A column, from the parapet to the abacus.")
    revolved([[(.02, 2.62), (.05, 2.66), (.03, 2.70)], [(.03, 2.70), (.09, 2.8), (.2, 2.98)],
              [(.22, 2.98), (.22, 3.1)]], 20, 2).write("corbel", "A corbel below the ribs.")
    revolved([[(.30, 0), (.33, .06), (.36, .3), (.42, .55), (.44, .62)],
              [(.44, .62), (.48, .63), (.48, .7), (.44, .71)], [(.44, .71), (.40, .66), (.01, .64)]],
             28, 2).write("pot", "A terracotta pot, .7 m high.")
    revolved([[(1.25, 0), (1.25, .18)], [(1.25, .18), (1.0, .18)], [(1.0, .18), (.95, .9)],
              [(.95, .9), (1.08, .92), (1.08, 1.04), (.95, 1.06)], [(.95, 1.06), (.74, 1.06)],
              [(.74, 1.06), (.74, .3)]], 32, 2).write("well", "The head of a well.")
    revolved([[(.05, .3), (.55, .9), (.72, 2.0), (.66, 3.6), (.42, 5.4), (.16, 6.8), (.01, 7.3)]],
             24, 5).write("cypress", "A cypress.")
    sphere_clump(1.).write("bush", "A bush of radius 1.")


main()
