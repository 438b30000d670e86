#!/usr/bin/env python3
"""Measures the guiding distributions of the final gather: noise at equal rays, and CPU seconds.

Usage: guides.py PROGRAM WxH SEEDS
Each scene is rendered with one sample of 16 gather rays a pixel, without shared gathers. The noise is
the relMSE that two seeds have on average, in units of one picture; photons differ by seed too.
"noise x rays" is the relative variance of one ray, if the noise of the maps is small.
"""
import itertools
import json
import os
import sys
import tempfile

from picture_errors import run
from read_exr import read_exr

SCENES = os.path.realpath(os.path.join(os.path.dirname(__file__), "../../scenes"))
RAYS = 16
HEAD = """LookAt 1.1 1.6 3.7  4 1.1 0  0 1 0
Camera "perspective" "float fov" 60
Film "image"
Sampler "lowdiscrepancy" "integer pixelsamples" 1
SurfaceIntegrator "exphotonmap"
WorldBegin
Material "matte" "color Kd" [.7 .68 .6]
"""
ROOM = """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 5 2 7 3 2 6 7 1 6 2 1 5 6 0 3 7 0 7 4]
  "point P" [0 0 0 4 0 0 4 0 4 0 0 4 0 3 0 4 3 0 4 3 4 0 3 4]
AttributeBegin Translate 3 .4 1 Shape "sphere" "float radius" .4 AttributeEnd
"""
SPOT = ('LightSource "spot" "color I" [900 860 780] "point from" [2 2.9 2] "point to" [%s] '
        '"float coneangle" 13 "float conedeltaangle" 3\n')
PANEL = """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [.5 0 2.4 .5 0 3.4 .5 3 3.4 .5 3 2.4]
"""
MADE = {
    "one patch": HEAD + ROOM + SPOT % "0 1.8 2.4" + "WorldEnd\n",
    "two patches": HEAD + ROOM + SPOT % "0 1.8 2.4" + SPOT % "2.6 1.2 4" + "WorldEnd\n",
    "half-hidden patch": HEAD + ROOM + PANEL + SPOT % "0 1.8 2.4" + "WorldEnd\n",
    "uniform": HEAD + 'LightSource "point" "color I" [900 900 900] Shape "sphere" "float radius" 9\nWorldEnd\n',
}
FILES = {"skylight": "skylight-room", "glossy": "glossy-floor-room"}
NARROW = ("gatherangle=3", "gatherphotons=1000")
GUIDES = {
    "bsdf": ("gathersampling=bsdf",),
    "cones, 10 degrees of 50": (),
    "cones, 3 degrees of 1000": NARROW,
    "jensen, 50": ("gathersampling=jensen",),
    "jensen, 1000": ("gathersampling=jensen", "gatherphotons=1000"),
    "hey, 50": ("gathersampling=hey",),
    "hey, 200": ("gathersampling=hey", "gatherphotons=200"),
}


def render(program, scene, folder, options):
    """Returns the pixels, and the CPU seconds of the phase that gathers."""
    exr, figures = (os.path.join(folder, "picture." + end) for end in ("exr", "json"))
    run([program, "render", scene, "--float", "--quiet", "--no-progress", "--nthreads", "1", "--spp",
         "1", "-o", exr, "--stats-json", figures, *options])
    channels = read_exr(exr)
    with open(figures) as file:
        phases = json.loads(file.readline())["phases"]
    seconds = next(p["cpuSeconds"] for p in phases if p["name"] == "render")
    return [x for c in "RGB" for x in channels[c]], seconds


def noise(pictures):
    pairs = list(itertools.combinations(pictures, 2))
    total = sum((x - y) ** 2 / 2 / (((x + y) / 2) ** 2 + .01)
                for a, b in pairs for x, y in zip(a, b))
    return total / len(pairs) / len(pictures[0])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, size, seeds = sys.argv[1], sys.argv[2], int(sys.argv[3])
    scenes = {name: os.path.join(SCENES, folder, "exphotonmap.pbrt") for name, folder in FILES.items()}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in MADE.items():
            scenes[name] = os.path.join(folder, name.replace(" ", "-") + ".pbrt")
            with open(scenes[name], "w") as file:
                file.write(text)
        print("| scene | " + " | ".join(GUIDES) + " |\n| --- |" + " --- |" * len(GUIDES))
        for name, scene in scenes.items():
            row = f"| {name} |"
            for settings in GUIDES.values():
                options = ["--resolution", size]
                for setting in (f"finalgathersamples={RAYS}", "sharedgather=false", "edgesamples=1", *settings):
                    options += ["--set", "SurfaceIntegrator." + setting]
                found = [render(program, scene, folder, [*options, "--seed", str(seed)])
                         for seed in range(1, seeds + 1)]
                variance = noise([pixels for pixels, _ in found]) * RAYS
                row += f" {variance:.2f}, {sum(s for _, s in found) / seeds:.2f} s |"
            print(row, flush=True)


main()
