#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Renders the pictures of docs/reference that show what a parameter does. It needs Pillow.

    docs/reference/images/make_strips.py build/bin/exphoton [PAGE | PAGE/STRIP ...]

A strip has one small picture for each value of one parameter. Its file is PAGE/PLUGIN-PARAMETER.jpg
and strips/PAGE.py defines it. The table kStrips in core/parser/reference/parameter_strips.cpp puts
it onto the page of its plugin. Without names the script renders all strips.

A page links to the strip of another plugin where a parameter has the same name and meaning.
These parameters have neither strip nor link:
- names and data: filename, namedmaterial1, indices, P, Pz, knots and weights;
- parameters that act as one with a strip does: halffov as fov, ysamples as xsamples, maxsamples as
  pixelsamples, vscale, vdelta and v2 as uscale, udelta and v1, nv, vorder, v0 and v1 as nu, uorder,
  u0 and u1, ny and nz as nx, "to" of a distant light as "from", green and blue as red, tex2 of scale
  as tex1, maxspeculardepth and the maxdepth of igi as the maxdepth of directlighting;
- parameters that change only the time and the noise: how photons start and how their paths and
  gather rays end, gatherphotons, gatherangle, and how many rays find the light beyond the glimit of igi;
- thresholds of precomputed radiance, which keep the look by design;
- S and st of a mesh: S shows only with anisotropic gloss, and st is another name of uv;
- parameters for the inspection of photon maps (show), and those of accelerators.
"""
import importlib
import os
import sys
import tempfile

from PIL import Image

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, FOLDER)

from strips import files, stage  # noqa: E402

PAGES = ("integrators volumeintegrators shapes lights materials textures samplers filters cameras "
         "volumes").split()
QUALITY = 70  # of a JPEG file


def values_of(text):
    """Returns the values of a strip. Semicolons separate them where a value has spaces."""
    return [value.strip() for value in text.split(";")] if ";" in text else text.split()


def render(program, page, name, values, scene):
    values = values_of(values)
    strip = Image.new("RGB", (stage.SIZE * len(values), stage.SIZE))
    with tempfile.TemporaryDirectory() as folder:
        files.write_to(folder)
        for i, value in enumerate(values):
            strip.paste(stage.picture(program, scene(value), folder), (stage.SIZE * i, 0))
    file = os.path.join(FOLDER, page, name + ".jpg")
    os.makedirs(os.path.dirname(file), exist_ok=True)
    strip.save(file, quality=QUALITY, optimize=True)
    print("%s/%s %d bytes" % (page, name, os.path.getsize(file)), flush=True)


def main():
    names = sys.argv[2:]
    for page in PAGES:
        for name, (values, scene) in importlib.import_module("strips." + page).STRIPS.items():
            if not names or page in names or page + "/" + name in names:
                render(sys.argv[1], page, name, values, scene)


main()
