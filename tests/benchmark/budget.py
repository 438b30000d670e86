#!/usr/bin/env python3
"""Measures whether the parts of `exphoton budget` add up to the error against a reference.

Usage: budget.py PROGRAM WxH REFERENCE_SAMPLES SEEDS SCENE ...
A scene is a file, or the name of a folder of scenes/, which means its exphotonmap.pbrt. Parameters of
the integrator may follow, and --spp and --effects: cornell-caustic:nused=300:spp=8:effects=caustics=off.
Each row is one budget, in units of 1e-4 of relMSE. "measured" is the error of renders with other seeds
against guidedpath with REFERENCE_SAMPLES samples a pixel. +- is half of a 95 % interval. The program
ends with status 1 if a difference is larger than its +-.
"""
import os
import re
import sys

from picture_errors import run

SCENES = os.path.realpath(os.path.join(os.path.dirname(__file__), "../../scenes"))
CAUSES = ("camera sampling", "gather directions", "photon noise", "blur of the maps",
          "caustic kernel", "sharing", "depth limits", "skipped effects")
TOTALS = "sum of the parts", "measured", "difference"
UNIT = 1e4


def budget(program, scene, size, samples, seeds):
    """Returns (value, half width) by the names of the rows, and the text around the table."""
    scene, *parameters = scene.split(":")
    if not os.path.exists(scene):
        scene = os.path.join(SCENES, scene, "exphotonmap.pbrt")
    options = []
    for parameter in parameters:
        name, _, value = parameter.partition("=")
        options += (["--" + name, value] if name in ("spp", "effects")
                    else ["--set", "SurfaceIntegrator." + parameter])
    text = run([program, "budget", scene, "--resolution", size, "--reference-spp", samples, "--seeds",
                seeds, "--quiet", *options])
    rows = {}
    for line in text.splitlines():
        for name in CAUSES + TOTALS:
            found = re.match(rf"  {name} +(-?[0-9.]+)(?: +([0-9.]+))?", line)
            if found:
                rows[name] = float(found[1]), float(found[2] or 0)
    missing = [name for name in CAUSES + TOTALS if name not in rows]
    if missing or "against guidedpath" not in text:
        sys.exit(f"{scene}: no row of {missing}\n{text}")
    return rows, text


def main():
    program, size, samples, seeds, *scenes = sys.argv[1:]
    print("| scene | " + " | ".join(CAUSES + TOTALS) + " | blocks | times the bound |")
    print("| --- " * (len(CAUSES) + len(TOTALS) + 3) + "|", flush=True)
    is_wrong = False
    for scene in scenes:
        rows, text = budget(program, scene, size, samples, seeds)
        cells = []
        for name in CAUSES + TOTALS:
            value, width = (UNIT * x for x in rows[name])
            cells.append(f"{value:.3g} ± {width:.2g}" if width else f"{value:.0f}")
        difference, width = rows["difference"]
        is_out = abs(difference) > width
        is_wrong = is_wrong or is_out
        blocks = re.search(r"over blocks of (\d+)", text)[1]
        bound = re.search(r"([0-9.e+]+) times the lower bound", text)[1]
        print(f"| {scene} | " + " | ".join(cells) + (" OUT" if is_out else "") +
              f" | {blocks} | {bound} |", flush=True)
    return is_wrong


if __name__ == "__main__":
    sys.exit(main())
