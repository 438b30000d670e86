#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes toys.pbrt, the 300 small objects of the toy room: balls, bricks and drums.
Run it in this folder: python3 make_toys.py. Its output is kept beside it. Metres; y points up.
Half of the objects lie on the floor, half on the shelves; no two of them overlap."""
import random

COLOURS = ((.78, .24, .18), (.82, .62, .16), (.22, .46, .66), (.30, .56, .30), (.80, .76, .68),
           (.62, .40, .26), (.72, .50, .56), (.34, .34, .38))
BOARDS = (.03, .43, .83, 1.23, 1.63)  # heights of the upper sides of the shelves' boards
ON_FLOOR, ON_BOARD = 150, 30


def shape(kind, size, height, turn):
    """The directives of an object on the plane y = 0 that fits into a circle of radius `size`."""
    if kind == "ball":
        return 'Translate 0 %.3f 0 Shape "sphere" "float radius" %.3f' % (size, size)
    if kind == "brick":
        return ('Rotate %d 0 1 0 Scale %.3f %.3f %.3f Include "../parts/box.pbrt"'
                % (turn, 1.6 * size, height, 1.1 * size))
    return ('Rotate -90 1 0 0 Shape "cylinder" "float radius" %.3f "float zmin" 0 "float zmax" %.3f '
            'Shape "disk" "float radius" %.3f "float height" %.3f'
            % (.8 * size, height, .8 * size, height))


def toy(draw, x, y, z, size):
    colour = draw.choice(COLOURS)
    shade = draw.uniform(.8, 1)
    kind = draw.choice(("ball", "brick", "drum"))
    return ('AttributeBegin Material "matte" "color Kd" [ %.2f %.2f %.2f ] Translate %.3f %.2f %.3f\n'
            '  %s AttributeEnd\n'
            % (*(shade * c for c in colour), x, y, z,
               shape(kind, size, draw.uniform(1, 2.2) * size, draw.randrange(90))))


def on_floor(draw):
    placed = []
    while len(placed) < ON_FLOOR:
        size = draw.uniform(.05, .13)
        x, z = draw.uniform(-2.4, 2.4), draw.uniform(.6, 3.9)
        if all((x - a) ** 2 + (z - b) ** 2 > (size + c) ** 2 for a, b, c in placed):
            placed.append((x, z, size))
    return [toy(draw, x, 0, z, size) for x, z, size in placed]


def on_shelves(draw):
    width = 4.8 / ON_BOARD
    return [toy(draw, -2.4 + width * (i + .5), y, .2 + draw.uniform(-.04, .04),
                draw.uniform(.05, .075))
            for y in BOARDS for i in range(ON_BOARD)]


def main():
    draw = random.Random(300)
    toys = on_floor(draw) + on_shelves(draw)
    with open("toys.pbrt", "w") as file:
        file.write("# %d balls, bricks and drums. Written by make_toys.py.\n%s"
                   % (len(toys), "".join(toys)))


main()
