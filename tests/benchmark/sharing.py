#!/usr/bin/env python3
"""Measures what shared gathers save: error and CPU seconds with and without them, by scene.

Usage: sharing.py PROGRAM WxH REFERENCE SEEDS SHARED UNSHARED SCENE ... [-- OPTION ...]
SHARED and UNSHARED are lists of settings: samples a pixel, gather rays, and the number of indirect
photons if it is not the file's number, such as 8x4,2x8x50000. "file" stands for the file's settings,
and "file*2" for twice the file's samples a pixel.
REFERENCE is one of:
- an EXR file, whose noise then counts as error;
- a number of samples such as 256spp, for two halves by guidedpath without noise in the result;
- "seeds", for the noise between at least two seeds. The squared bias of sharing is added to shared
  settings: the mean of the products of two seeds' differences from the pictures of the setting without
  sharing that has the least noise. The bias of the photon maps is in both, and is left out. This is
  the choice for large pictures and for scenes whose references are too noisy.
All settings of a seed are rendered one after the other with one thread, and the smallest time of all
seeds counts. OPTIONs go to each render.

The last column is the time of the other kind of settings at the same error, divided by the time of the
row. It is interpolated between the settings that no other of their kind beats in time and error. A
mark says where the error lies outside of them: "> 3" where they do not get there, and "< 3" where the
cheapest of them is already better. Errors below the noise of the reference are not compared, because
they may be anything, even negative; more samples of the reference resolve them.
"""
import itertools
import math
import os
import re
import sys
import tempfile

from picture_errors import Scene
from read_exr import read_exr

SURFACE = "SurfaceIntegrator."
OFFSET = .01  # of relMSE


def samples_of(path):
    with open(path, encoding="utf-8") as file:
        return int(re.search(r'"integer pixelsamples"\s*\[?\s*(\d+)', file.read()).group(1))


def options_of(path, setting, is_shared):
    options = ["--nthreads", "1", "--set", f"{SURFACE}sharedgather={str(is_shared).lower()}"]
    if setting == "file":
        return options
    if setting.startswith("file*"):
        return options + ["--spp", str(samples_of(path) * int(setting.removeprefix("file*")))]
    samples, rays, *photons = setting.split("x")
    options += ["--spp", samples, "--set", f"{SURFACE}finalgathersamples={rays}"]
    if photons:
        options += ["--set", f"{SURFACE}indirectphotons={photons[0]}"]
    return options


def front(rows):
    """Returns the (error, seconds) that no other row beats, by falling error."""
    best, least = [], math.inf
    for seconds, error in sorted((r["seconds"], r["error"]) for r in rows):
        if error < least:
            best.append((error, seconds))
            least = error
    return best


def time_at(error, rows):
    """Returns the seconds at this error, and a mark if it is a bound."""
    points = front(rows)
    if error >= points[0][0]:
        return points[0][1], "" if error == points[0][0] else "< "
    for (e0, t0), (e1, t1) in zip(points, points[1:]):
        if error >= e1:
            part = math.log(error / e0) / math.log(e1 / e0)
            return t0 * (t1 / t0) ** part, ""
    return points[-1][1], "> "


def measure(scene, error, seeds, settings, more):
    """Without `error`, keeps the pictures' values in the rows."""
    rows = [{"shared": shared, "setting": setting, "error": 0, "seconds": math.inf, "pictures": []}
            for shared, names in settings.items() for setting in names]
    for seed in range(1, seeds + 1):
        for row in rows:
            picture, seconds = scene.render("picture", "--seed", str(seed), *more,
                                            *options_of(scene.path, row["setting"], row["shared"]))
            if error:
                row["error"] += error(picture) / seeds
            else:
                row["pictures"].append(colours(picture))
            row["seconds"] = min(row["seconds"], seconds)
    return rows


def colours(picture):
    channels = read_exr(picture)
    return channels["R"] + channels["G"] + channels["B"]


def mean_product(pairs, weights):
    """Returns the mean of (a - b)(c - d) w over all values, for pairs of ((a, b), (c, d))."""
    total = sum((a - b) * (c - d) * w for first, second in pairs
                for a, b, c, d, w in zip(*first, *second, weights))
    return total / (len(pairs) * len(weights))


def compare_seeds(rows):
    """Sets the errors of rows that have pictures."""
    pictures = [picture for row in rows for picture in row["pictures"]]
    weights = [1 / ((sum(values) / len(pictures)) ** 2 + OFFSET) for values in zip(*pictures)]
    for row in rows:
        pairs = list(itertools.combinations(row["pictures"], 2))
        row["error"] = mean_product([(pair, pair) for pair in pairs], weights) / 2
    best = min((row for row in rows if not row["shared"]), key=lambda row: row["error"])
    for row in rows:
        if row["shared"]:
            changes = list(zip(row["pictures"], best["pictures"]))
            row["bias"] = mean_product(list(itertools.combinations(changes, 2)), weights)
            row["error"] += row["bias"]


def ratio(row, others):
    """Returns the last column of a row."""
    if not others:
        return "none is resolved"
    seconds, mark = time_at(row["error"], others)
    return f"{mark}{seconds / row['seconds']:.2f}"


def print_rows(rows, least):
    """Errors below `least` are not resolved by the reference."""
    print("| gathers | samples x rays | relMSE | CPU s | time of the others at this error |\n"
          "| --- | --- | --- | --- | --- |")
    resolved = [row for row in rows if row["error"] > least]
    for row in rows:
        kind = "shared" if row["shared"] else "not shared"
        if row in resolved:
            error = f"{row['error']:.5f}"
            last = ratio(row, [r for r in resolved if r["shared"] != row["shared"]])
        else:
            error, last = f"< {least:.5f}", "not resolved by the reference"
        print(f"| {kind} | {row['setting']} | {error} | {row['seconds']:.2f} | {last} |", flush=True)


def main():
    arguments = sys.argv[1:]
    more = []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, more = arguments[:at], arguments[at + 1:]
    if len(arguments) < 7:
        sys.exit(__doc__)
    program, size, reference, seeds, shared, unshared, *paths = arguments
    settings = {True: shared.split(","), False: unshared.split(",")}
    if reference == "seeds" and int(seeds) < 2:
        sys.exit("\"seeds\" needs at least two seeds")
    for path in paths:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(program, path, size, folder)
            least, error = 0, None
            if reference.endswith(".exr"):
                def error(picture):
                    return scene.rel_mse(picture, reference)
            elif reference != "seeds":
                scene.reference(reference, *more)
                error, least = scene.error, scene.noise / 4  # of the mean of both halves
            print(f"\n{os.path.basename(os.path.dirname(path))}/{os.path.basename(path)}, {size} pixels"
                  f"{', ' if more else ''}{' '.join(more)}\n", flush=True)
            rows = measure(scene, error, int(seeds), settings, more)
            if not error:
                compare_seeds(rows)
            print_rows(rows, least)
            for row in rows:
                if "bias" in row:
                    print(f"\nShared {row['setting']}: the squared bias of sharing is {row['bias']:.5f}.")


main()
