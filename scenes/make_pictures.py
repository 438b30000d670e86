#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Renders the pictures of the gallery and writes them as JPEG. It needs Pillow.

    scenes/make_pictures.py build/bin/exphoton [SCENE ...]

Without names it renders all of them. Each line that it prints has a scene and its CPU seconds.
"""
import json
import os
import subprocess
import sys
import tempfile

from PIL import Image

FOLDER = os.path.dirname(os.path.abspath(__file__))
# The samples a pixel of a pass, the passes, and the exposure of the picture. Each pass shoots its own
# photons, so that passes also take away the blotches of photons. Pictures of DENOISED have one pass
# of two halves, with photons of their own, and `exphoton denoise` filters them.
PICTURES = {
    "cloister": (32, 4, -.3),
    "glass-still-life": (32, 1, -.4),
    "spiral-staircase": (32, 2, -.1),
    "swimming-hall": (32, 2, -.2),
    "sculpture-hall": (32, 8, -1),
    "night-corridor": (32, 2, -.3),
    "blinds-and-haze": (64, 1, .5),
    "dusk-motion": (64, 1, .4),
    "material-gallery": (32, 1, 0),
}
DENOISED = ["blinds-and-haze", "glass-still-life", "dusk-motion", "material-gallery"]
# More lights take the grain from the rim of the wheel, which is a small part of the picture's error.
OPTIONS = {"dusk-motion": ["--set", "SurfaceIntegrator.directlights=16"]}
# A target that no picture reaches, so that all passes are rendered.
NO_NOISE = "1e-12"


def make(program, scene, temporary):
    samples, passes, exposure = PICTURES[scene]
    variant = os.path.join(FOLDER, scene, "exphotonmap.pbrt")
    exr, png, figures = (os.path.join(temporary, "picture." + end) for end in ("exr", "png", "json"))
    passes_of = ["--target-error", NO_NOISE, "--max-passes", str(passes)]
    if scene in DENOISED:
        passes_of = ["--two-halves", "--aov", "albedo,N"]
    passes_of += OPTIONS.get(scene, [])
    subprocess.run([program, "render", variant, "--quiet", "--spp", str(samples), *passes_of, "-o", exr,
                    "--stats-json", figures], check=True)
    if scene in DENOISED:
        noisy, exr = exr, os.path.join(temporary, "denoised.exr")
        subprocess.run([program, "denoise", noisy, "-o", exr], check=True)
    subprocess.run([program, "convert", exr, png, "--exposure", str(exposure), "--tone-curve", "filmic"],
                   check=True)
    name = os.path.join(FOLDER, scene, "images", "exphotonmap.jpg")
    Image.open(png).convert("RGB").save(name, quality=90, optimize=True, progressive=True)
    if scene == "material-gallery":
        labels = os.path.join(FOLDER, scene, "make_labels.py")
        subprocess.run([sys.executable, labels, png, name.replace("exphotonmap", "labelled")], check=True)
    with open(figures) as file:
        print("%s %.0f" % (scene, json.loads(file.readline())["cpuSeconds"]), flush=True)


def main():
    for scene in sys.argv[2:] or PICTURES:
        with tempfile.TemporaryDirectory() as temporary:
            make(sys.argv[1], scene, temporary)


main()
