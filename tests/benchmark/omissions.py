#!/usr/bin/env python3
"""Measures how often the bounds of effects that --accuracy leaves out contain what is missing.

Usage: omissions.py PROGRAM ACCURACY RUNS TRUTH_SEEDS SCENE ...
Each scene is rendered with RUNS seeds and --accuracy. The truth is the root of relMSE between the mean
pictures with and without the effect, of TRUTH_SEEDS seeds each. For the share of the bounds that are
not below the truth, the 99 % interval (Clopper and Pearson) is printed; a row with an upper end below
95 % fails.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

from binomial import binomial_end
from read_exr import read_exr

OFFSET = .01  # of relMSE
SAMPLES = "16"


def render(program, scene, folder, *options):
    picture, statistics = os.path.join(folder, "a.exr"), os.path.join(folder, "a.json")
    result = subprocess.run([program, scene, "--quiet", "--no-progress", "--nthreads", "1", "--float",
                             "-o", picture, "--stats-json", statistics, *options],
                            capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(result.stderr)
    with open(statistics) as file:
        return read_exr(picture), json.load(file)


def true_change(program, scene, effect, seeds, folder):
    """The mean over pairs of different seeds of the product of their changes has the expected value
    change^2, so noise does not add to it."""
    level, total, squares = {}, {}, {}
    for seed in range(1, seeds + 1):
        both = [render(program, scene, folder, "--effects", f"{effect}={state}", "--spp", SAMPLES,
                       "--seed", str(10000 + seed))[0] for state in ("on", "off")]
        for key in "RGB":
            for i, (x, y) in enumerate(zip(both[0][key], both[1][key])):
                place = key, i
                level[place] = level.get(place, 0) + x / seeds
                total[place] = total.get(place, 0) + x - y
                squares[place] = squares.get(place, 0) + (x - y) ** 2
    pairs = seeds * (seeds - 1)
    mean = sum((total[p] ** 2 - squares[p]) / pairs / (level[p] ** 2 + OFFSET) for p in level)
    return math.sqrt(max(mean / len(level), 0))


def main():
    program, accuracy, runs, seeds = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    fails = False
    print("| scene | effect | true change | bounds, least to most | hold | 99 % interval |")
    print("| --- | --- | --- | --- | --- | --- |", flush=True)
    for scene in sys.argv[5:]:
        bounds = {}
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(1, runs + 1):
                record = render(program, scene, folder, "--integrator", "exphotonmap", "--accuracy",
                                accuracy, "--seed", str(seed))[1]
                for omitted in record["accuracy"]["omitted"]:
                    bounds.setdefault(omitted["effect"], []).append(omitted["bound"])
            for effect, found in bounds.items():
                truth = true_change(program, scene, effect, seeds, folder)
                hits = sum(bound >= truth for bound in found)
                ends = [100 * binomial_end(hits, len(found), .005, is_upper)
                        for is_upper in (False, True)]
                fails = fails or ends[1] < 95
                print(f"| {os.path.basename(scene)} | {effect} | {100 * truth:.3g} % | "
                      f"{100 * min(found):.3g} to {100 * max(found):.3g} % | {hits} of {len(found)} | "
                      f"{ends[0]:.0f} to {ends[1]:.0f} %{' TOO LOW' if ends[1] < 95 else ''} |",
                      flush=True)
    sys.exit(fails)


main()
