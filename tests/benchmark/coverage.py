#!/usr/bin/env python3
"""Measures how often the intervals that exphoton prints contain the truth.

Usage: coverage.py PROGRAM WxH REFERENCE_SECONDS SEEDS SCENE ... [--quotes QUOTES]
- Studies of four seeds: noise, bias^2 and relMSE with their +- (one standard error, so the share
  should be 68 %). The truth is what all seeds together say; for bias^2, with the reference.
- --two-halves: the noise within 1.96 standard errors (95 %). The truth is the variance of all seeds,
  relative to levels of the same integrator that do not depend on these seeds.
- --accuracy 10% with QUOTES seeds (default 10): the upper end of the error (95 %).
- Quotes with QUOTES seeds: the 90 % interval of the price of 10 %. The truth is the CPU time for this
  error, interpolated between renders whose errors are means over four seeds.
The intervals of --certify have a command of their own. For each share, the 99 % interval (Clopper and
Pearson) is printed, and a row with an upper end below the nominal share fails.
"""
import argparse
import csv
import json
import math
import os
import re
import shutil
import sys
import tempfile

from binomial import binomial_end
from picture_errors import Scene, run
from quote_offers import offers
from read_exr import read_exr

SEEDS_OF_A_STUDY = 4
SAMPLES = 4
INTEGRATORS = "exphotonmap", "path"
OFFSET = .01  # of relMSE
LEVEL_SAMPLES = 1024  # of each of the two pictures whose mean is the level
LEVEL_SEED = 2000


class Table:
    def __init__(self):
        self.fails = False
        print("| scene | interval | contains the truth | nominal | 99 % interval |")
        print("| --- | --- | --- | --- | --- |", flush=True)

    def add(self, scene, what, hits, nominal):
        count, trials = sum(hits), len(hits)
        ends = [binomial_end(count, trials, .005, is_upper) for is_upper in (False, True)]
        is_low = ends[1] < nominal
        self.fails = self.fails or is_low
        print(f"| {scene} | {what} | {count} of {trials} | {100 * nominal:.0f} % | "
              f"{100 * ends[0]:.0f} to {100 * ends[1]:.0f} %{' TOO LOW' if is_low else ''} |",
              flush=True)


def weights_of(first, second):
    """Returns 1 / (r^2 + .01) by channel and pixel, for two independent pictures with the mean r. The
    variance of r makes the inverse too large, and the second order of this is removed."""
    weights = {}
    for channel in "RGB":
        weights[channel] = []
        for a, b in zip(first[channel], second[channel]):
            square, variance = ((a + b) / 2) ** 2, (a - b) ** 2 / 4
            weight = 1 / (square + OFFSET)
            excess = variance * (3 * square - OFFSET) * weight ** 2
            weights[channel].append(weight / (1 + max(excess, 0)))
    return weights


def variance_of(pictures, weights):
    """Returns the variance of one picture, as a part of relMSE. The weights must not depend on the
    pictures: pixels that are too bright by chance have too large a variance and too small a weight."""
    count, total, values = len(pictures), 0., 0
    for channel in "RGB":
        for weight, pixel in zip(weights[channel], zip(*(p[channel] for p in pictures))):
            mean = sum(pixel) / count
            total += sum((x - mean) ** 2 for x in pixel) / (count - 1) * weight
            values += 1
    return total / values


def two_halves(scene, name, seeds, table):
    """The noise that is printed is that of the mean of both halves, so of the picture."""
    pictures, printed = [], []
    for seed in range(1, seeds + 1):
        statistics = os.path.join(scene.folder, "statistics.json")
        picture, _ = scene.render("halves", "--integrator", name, "--two-halves", "--spp",
                                  str(2 * SAMPLES), "--seed", str(seed), "--stats-json", statistics)
        pictures.append(read_exr(picture))
        with open(statistics) as file:
            values = json.load(file)
        printed.append((values["noise"], values["noiseError"]))
    levels = [read_exr(scene.render("levels", "--integrator", name, "--spp", str(LEVEL_SAMPLES),
                                    "--seed", str(LEVEL_SEED + i))[0]) for i in (0, 1)]
    truth = variance_of(pictures, weights_of(*levels))
    table.add(scene.name, f"--two-halves of {name}",
              [abs(noise - truth) <= 1.96 * error for noise, error in printed], .95)


def study(scene, seeds, folder):
    run([scene.program, "study", scene.path, "--out", folder, "--resolution", scene.size,
         "--integrators", ",".join(INTEGRATORS), "--vary", f"spp={SAMPLES}", "--seeds", str(seeds),
         "--reference", scene.halves[0], "--reference", scene.halves[1], "--no-maps", "--quiet",
         "--nthreads", "1"])


def summary_of(program, folder, seeds):
    """Returns the rows of the summary of a study with these seeds alone, by integrator."""
    part = folder + "-part"
    shutil.rmtree(part, ignore_errors=True)
    shutil.copytree(folder, part)
    results = os.path.join(part, "results.json")
    with open(results) as file:
        values = json.load(file)
    values["runs"] = [row for row in values["runs"] if row["seed"] in seeds]
    values["seeds"] = len(seeds)
    with open(results, "w") as file:
        json.dump(values, file)
    run([program, "report", part])
    with open(os.path.join(part, "summary.csv"), newline="") as file:
        return {row["integrator"]: row for row in csv.DictReader(file)}


def studies(scene, seeds, table):
    folder = os.path.join(scene.folder, "study")
    study(scene, seeds, folder)
    truth = summary_of(scene.program, folder, set(range(1, seeds + 1)))
    groups = [set(range(first, first + SEEDS_OF_A_STUDY))
              for first in range(1, seeds - SEEDS_OF_A_STUDY + 2, SEEDS_OF_A_STUDY)]
    parts = [summary_of(scene.program, folder, group) for group in groups]
    for name in INTEGRATORS:
        for what in "relMSE", "noise", "bias2":
            true = float(truth[name][what])
            table.add(scene.name, f"{what} of {name}, study",
                      [abs(float(part[name][what]) - true) <= float(part[name][what + " +-"])
                       for part in parts], .683)


def price_of(scene, name, root):
    """Returns the CPU seconds for a root of relMSE, from renders with doubling samples."""
    last = None
    for octave in range(14):
        results = [scene.render("price", "--integrator", name, "--spp", str(2 ** octave), "--seed",
                                str(seed)) for seed in range(1, SEEDS_OF_A_STUDY + 1)]
        point = (sum(scene.error(picture) for picture, _ in results) / len(results),
                 sum(seconds for _, seconds in results) / len(results))
        if point[0] <= root ** 2:
            if last is None:
                return point[1]
            share = math.log(last[0] / root ** 2) / math.log(last[0] / point[0])
            return last[1] * (point[1] / last[1]) ** share
        last = point
    return None


def quotes(scene, count, table):
    truth = {name: price_of(scene, name, .1) for name in INTEGRATORS}
    hits = {name: [] for name in INTEGRATORS}
    for seed in range(count):
        text = run([scene.program, "quote", scene.path, "--resolution", scene.size, "--integrators",
                    ",".join(INTEGRATORS), "--accuracies", "10%", "--quiet", "--seed", str(seed)])
        for _, name, _, least, most, _ in offers(text):
            if truth[name] is not None:
                hits[name].append(least <= truth[name] <= most)
    for name in INTEGRATORS:
        if hits[name]:
            table.add(scene.name, f"price of 10 % with {name}", hits[name], .9)


def dial(scene, count, table):
    """The upper end of the error that --accuracy prints."""
    hits = []
    for seed in range(1, count + 1):
        picture = os.path.join(scene.folder, "dial.exr")
        text = run([scene.program, scene.path, "--resolution", scene.size, "--footprint-spp", "16",
                    "--float", "--accuracy", "10%", "--seed", str(seed), "-o", picture], errors=True)
        end = re.search(r"the error lies below ([\d.]+) %", text)
        hits.append(end is not None and scene.error(picture) <= (float(end.group(1)) / 100) ** 2)
    table.add(scene.name, "end of --accuracy 10%", hits, .95)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("size")
    parser.add_argument("reference_seconds")
    parser.add_argument("seeds", type=int)
    parser.add_argument("scenes", nargs="+", metavar="scene")
    parser.add_argument("--quotes", type=int, default=10)
    options = parser.parse_args()
    table = Table()
    for path in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(options.program, path, options.size, folder)
            scene.name = path.split("/")[-2]
            scene.reference(options.reference_seconds)
            for name in INTEGRATORS:
                two_halves(scene, name, options.seeds, table)
            studies(scene, options.seeds, table)
            dial(scene, options.quotes, table)
            quotes(scene, options.quotes, table)
    sys.exit(table.fails)


main()
