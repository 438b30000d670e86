#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
# Writes two variants of scenes/skylight-room with more geometry, to compare exphotonmap with
# photonmap in complex scenes (docs/theory/source-figures.md):
#     tests/benchmark/complex_rooms.py FOLDER
# "fine" has 266,000 more triangles: a wrinkled torus on the floor. "many" has 300 boxes and balls
# on the floor. For each there are NAME.pbrt with the sun, NAME-emitters.pbrt with area lights in
# place of its patch, and NAME.study. All objects are below the beam of the sun.
import math
import os
import random
import sys

ROOM = os.path.realpath(os.path.join(os.path.dirname(__file__), "../../scenes/skylight-room"))
HEADER = """LookAt -.25 1.45 6.05   .27 1.02 1.4   0 1 0
Camera "perspective" "float fov" [ 37 ]
Film "image" "integer xresolution" [ 96 ] "integer yresolution" [ 72 ]
PixelFilter "triangle" "float xwidth" [ 1 ] "float ywidth" [ 1 ]
Sampler "lowdiscrepancy" "integer pixelsamples" [ 4 ]
SurfaceIntegrator "exphotonmap" "integer indirectphotons" [ 100000 ] "integer finalgathersamples" [ 32 ]
WorldBegin
"""
STUDY = """scene {name}.pbrt
resolution 96x72
seeds 4
reference-scene {name}-emitters.pbrt
make-reference path maxdepth=100
reference-time 150s
integrators exphotonmap,photonmap
vary finalgathersamples=32,64
vary spp=4,8
"""


def torus(rings, sectors):
    points, indices = [], []
    for i in range(rings):
        for j in range(sectors):
            u, v = 2 * math.pi * i / rings, 2 * math.pi * j / sectors
            r = .26 * (1 + .12 * math.sin(9 * u + 5 * v) * math.sin(7 * v))
            x, y = .62 + r * math.cos(v), r * math.sin(v)
            points.append("%.5f %.5f %.5f" % (x * math.cos(u), y, x * math.sin(u)))
            a, b = i * sectors + j, i * sectors + (j + 1) % sectors
            c, d = [((i + 1) % rings) * sectors + k for k in (j, (j + 1) % sectors)]
            indices.append("%d %d %d %d %d %d" % (a, b, c, b, d, c))
    return ('AttributeBegin\nMaterial "matte" "color Kd" [ .7 .5 .4 ]\nTranslate 1.0 .31 2.9\n'
            'Shape "trianglemesh" "integer indices" [ %s ]\n"point P" [ %s ]\nAttributeEnd\n'
            % ("\n".join(indices), "\n".join(points)))


def clutter(count):
    text, numbers = "", random.Random(1)
    for i in range(count):
        size = numbers.uniform(.04, .12)
        kd = " ".join("%.2f" % numbers.uniform(.2, .8) for _ in range(3))
        at = (numbers.uniform(-2.3, 2.3), numbers.uniform(size, .5), numbers.uniform(2.1, 4.6))
        text += ('AttributeBegin\nMaterial "matte" "color Kd" [ %s ]\nTranslate %.3f %.3f %.3f\n'
                 'Rotate %d 1 2 3\n' % (kd, *at, numbers.randrange(360)))
        if i % 2:
            text += 'Shape "sphere" "float radius" [ %.3f ]\n' % size
        else:
            text += 'Scale %.3f %.3f %.3f\nInclude "%s/../parts/box.pbrt"\n' % (
                size, 2 * size, size, ROOM)
        text += "AttributeEnd\n"
    return text


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for name, objects in (("fine", torus(365, 365)), ("many", clutter(300))):
        with open(os.path.join(folder, name + "-objects.pbrt"), "w") as file:
            file.write(objects)
        for suffix, light in (("", "sun"), ("-emitters", "patch")):
            with open(os.path.join(folder, name + suffix + ".pbrt"), "w") as file:
                file.write(HEADER + 'Include "%s/geometry.pbrt"\nInclude "%s-objects.pbrt"\n'
                           'Include "%s/%s.pbrt"\nWorldEnd\n' % (ROOM, name, ROOM, light))
        with open(os.path.join(folder, name + ".study"), "w") as file:
            file.write(STUDY.format(name=name))


main()
