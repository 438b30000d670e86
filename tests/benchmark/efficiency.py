#!/usr/bin/env python3
"""Measures how efficient exphotonmap is beside path, in scenes of scenes/ with their files' settings.

Usage: efficiency.py PROGRAM WxH FACTOR SEEDS [SCENE ...]
Without names it takes all scenes. The two references are renders by guidedpath with FACTOR times the
samples of a scene's file. Efficiency is 1 / (relMSE x CPU seconds); reading the scene and
building the accelerator do not count. The error has no noise of the reference: of two independent
references a and b without bias, (x - a)(x - b) has the expected value (x - truth)^2. "at full size"
is the ratio for the file's number of pixels, if errors stay: photons are shot once, for any number of
pixels. The two last columns have the parts of exphotonmap's CPU seconds and error. The program ends
with status 1 if exphotonmap is less efficient than path in a scene at this size. It warns where the
reference has more noise than exphotonmap: pixels where both references miss rare light then have the
level of dark ones, so that their errors count too much.
"""
import json
import os
import re
import sys
import tempfile

from picture_errors import run
from read_exr import read_exr

SCENES = os.path.realpath(os.path.join(os.path.dirname(__file__), "../../scenes"))
PARTS = ("emission", "direct", "caustic", "indirect", "specular")
UNCOUNTED = ("parse", "accelerator", "write")
BY_PIXELS = ("render", "share")  # phases whose time grows with the number of pixels


class Picture:
    """The layers of a render as flat lists of numbers, and its CPU seconds by phase."""

    def __init__(self, program, scene, integrator, folder, options):
        exr, figures = (os.path.join(folder, "picture." + end) for end in ("exr", "json"))
        variant = os.path.join(SCENES, scene, "path.pbrt" if integrator == "guidedpath"
                               else integrator + ".pbrt")
        run([program, "render", variant, "--integrator", integrator, "--footprint-spp", "16",
             "--float", "--quiet", "--no-progress", "--nthreads", "1", "-o", exr, "--stats-json",
             figures, "--aov", ",".join(PARTS), *options])
        channels = read_exr(exr)
        self.layers = {layer: [x for c in "RGB" for x in channels[layer + c]]
                       for layer in ("", *(part + "." for part in PARTS))}
        with open(figures) as file:
            phases = json.loads(file.readline())["phases"]
        self.seconds = {p["name"]: p["cpuSeconds"] for p in phases if p["name"] not in UNCOUNTED}


class Reference:
    def __init__(self, a, b):
        self.a, self.b = a.layers, b.layers
        pairs = list(zip(self.a[""], self.b[""]))
        self.weights = [1 / (((x + y) / 2) ** 2 + .01) for x, y in pairs]
        # relMSE of the noise of the mean of both
        self.noise = sum((x - y) ** 2 / 4 * w for (x, y), w in zip(pairs, self.weights)) / len(pairs)

    def error(self, picture, layer=""):
        terms = zip(picture.layers[layer], self.a[layer], self.b[layer], self.weights)
        return sum((x - a) * (x - b) * w for x, a, b, w in terms) / len(self.weights)


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def number(scene, name):
    """Returns the first number of a parameter in the file of exphotonmap, or in another of its scene."""
    folder = os.path.join(SCENES, scene)
    for file in ("exphotonmap.pbrt", *sorted(f for f in os.listdir(folder) if f.endswith(".pbrt"))):
        with open(os.path.join(folder, file)) as text:
            found = re.search(rf'"integer {name}"\s*\[?\s*(\d+)', text.read())
        if found:
            return int(found.group(1))
    sys.exit(f"{scene} has no {name}")


def at_full_size(seconds, scene, size):
    width, height = map(int, size.split("x"))
    pixels = number(scene, "xresolution") * number(scene, "yresolution") / (width * height)
    return sum(t * (pixels if name in BY_PIXELS else 1) for name, t in seconds.items())


def measure(program, scene, size, factor, seeds):
    with tempfile.TemporaryDirectory() as folder:
        def render(integrator, *options):
            return Picture(program, scene, integrator, folder, ("--resolution", size, *options))
        samples = str(factor * number(scene, "pixelsamples"))
        reference = Reference(*(render("guidedpath", "--seed", str(1000 + i), "--spp", samples)
                                for i in (0, 1)))
        pictures = {"path": [], "exphotonmap": []}
        for seed in range(1, seeds + 1):  # in turn, because machines are noisy
            for integrator, found in pictures.items():
                found.append(render(integrator, "--seed", str(seed)))
    product, full, row = {}, {}, f"| {scene} |"
    for integrator, found in pictures.items():
        cpu = mean(sum(p.seconds.values()) for p in found)
        error = mean(reference.error(p) for p in found)
        product[integrator] = cpu * error
        full[integrator] = error * mean(at_full_size(p.seconds, scene, size) for p in found)
        row += f" {cpu:.2f} s, {error:.2g} |"
    ratio = product["path"] / product["exphotonmap"]
    ours = pictures["exphotonmap"]
    times = {name: mean(p.seconds[name] for p in ours) for name in ours[0].seconds}
    errors = {layer: mean(reference.error(p, layer + ".") for p in ours) for layer in PARTS}
    print(row, f"{ratio:.2f} | {full['path'] / full['exphotonmap']:.2f} |",
          ", ".join(f"{n} {t:.2f}" for n, t in times.items()), "|",
          ", ".join(f"{n} {e:.2g}" for n, e in errors.items()), "|", flush=True)
    ours_error = mean(reference.error(p) for p in ours)
    if reference.noise > ours_error:
        print(f"warning: the reference of {scene} has the noise {reference.noise:.2g}, and exphotonmap "
              f"the error {ours_error:.2g}; a larger FACTOR is needed", file=sys.stderr, flush=True)
    return product["exphotonmap"] <= product["path"]


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    program, size, factor, seeds, *scenes = sys.argv[1:]
    variants = ("exphotonmap.pbrt", "path.pbrt")
    scenes = scenes or [s for s in sorted(os.listdir(SCENES))
                        if all(os.path.exists(os.path.join(SCENES, s, v)) for v in variants)]
    print("| scene | path: CPU s, relMSE | exphotonmap: CPU s, relMSE | efficiency, ratio | "
          "at full size | exphotonmap: CPU s | relMSE |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    missed = [s for s in scenes if not measure(program, s, size, int(factor), int(seeds))]
    if missed:
        sys.exit("less efficient than path: " + ", ".join(missed))


main()
