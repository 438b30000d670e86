#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Writes the name of each material under its object. It needs Pillow.

    scenes/material-gallery/make_labels.py picture.png labelled.jpg
"""
import math
import sys

from PIL import Image, ImageDraw, ImageFont

from make_gallery import GROUPS, place

# As in exphotonmap.pbrt: distance of the camera, its height, and its field of view.
DISTANCE, HEIGHT, FOV = 15, 1.67, 15.2
LABEL_Z, LABEL_Y = .42, -.11      # of the strips at the fronts of the shelves


def main():
    picture = Image.open(sys.argv[1]).convert("RGB")
    width, height = picture.size
    scale = height / 2 / math.tan(math.radians(FOV / 2)) / (DISTANCE - LABEL_Z)
    font = ImageFont.truetype("DejaVuSans.ttf", round(height / 45))
    draw = ImageDraw.Draw(picture)
    for i, (name, _) in enumerate(GROUPS):
        x, y = place(i)
        draw.text((width / 2 + x * scale, height / 2 - (y + LABEL_Y - HEIGHT) * scale), name,
                  fill=(238, 226, 204), font=font, anchor="mm")
    picture.save(sys.argv[2], quality=90)


main()
