# SPDX-License-Identifier: BSD-2-Clause
"""Images and meshes that scenes of the strips read."""
import os

from PIL import Image, ImageDraw


def bands():
    """Rings of light about the vertical axis."""
    image = Image.new("RGB", (64, 64), (20, 20, 24))
    draw = ImageDraw.Draw(image)
    for y in range(4, 64, 12):
        draw.rectangle((0, y, 63, y + 5), fill=(255, 244, 220))
    return image


def sectors():
    """Beams in eight directions, alternately warm and cool."""
    image = Image.new("RGB", (64, 32), (20, 20, 24))
    draw = ImageDraw.Draw(image)
    for i in range(8):
        draw.rectangle((8 * i, 0, 8 * i + 3, 31), fill=(255, 200, 120) if i % 2 else (120, 180, 255))
    return image


def sky():
    """A bright sun in a blue sky over brown ground; the top row is the zenith."""
    image = Image.new("RGB", (128, 64))
    draw = ImageDraw.Draw(image)
    for y in range(64):
        shade = (70 + 2 * y, 110 + 2 * y, 190 + y) if y < 32 else (80, 62, 46)
        draw.line((0, y, 127, y), fill=shade)
    draw.ellipse((86, 12, 96, 20), fill=(255, 255, 240))
    return image


def halves():
    """A warm half and a cool half."""
    image = Image.new("RGB", (64, 32), (40, 90, 200))
    ImageDraw.Draw(image).rectangle((0, 0, 31, 31), fill=(255, 170, 80))
    return image


def grid():
    """Thin lines on a light ground."""
    image = Image.new("RGB", (256, 256), (235, 225, 200))
    draw = ImageDraw.Draw(image)
    for i in range(0, 256, 32):
        draw.rectangle((i, 0, i + 7, 255), fill=(30, 60, 120))
        draw.rectangle((0, i, 255, i + 7), fill=(30, 60, 120))
    return image


# A box and, in a group of its own, a roof on it.
HOUSE = '''v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
v 0 0 1.8
g box
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
g roof
f 5 6 9
f 6 7 9
f 7 8 9
f 8 5 9
'''


def write_to(folder):
    """Writes all files to the folder of the scene."""
    for make in (bands, sectors, sky, halves, grid):
        make().save(os.path.join(folder, make.__name__ + ".png"))
    with open(os.path.join(folder, "house.obj"), "w") as out:
        out.write(HOUSE)
