#!/usr/bin/env python3
"""Measures whether `--accuracy` keeps its promise, and what it costs.

Usage: accuracy.py PROGRAM WxH REFERENCE_SECONDS MOST_SECONDS SEEDS SCENE ...
                   [--accuracies PERCENT,...] [--cache FOLDER]
Renders each scene with accuracies of 10, 5 and 2 %, or with those that are given. The error of a
picture is measured against a reference of guidedpath (picture_errors.py). REFERENCE_SECONDS may be
samples, such as 256spp. The grid has path, guidedpath and exphotonmap, the latter with the gather
rays of the scene and with 16, and 1 to 4096 samples a pixel. A setting ends where a render would
take more than MOST_SECONDS, where another setting is cheaper, or where the error is below half of
the smallest accuracy. Each setting has two seeds: the mean of their relMSE and the smaller time.
"Best" is the CPU time of the cheapest setting for the mean error that the dial reached,
interpolated in the grid. "Times best" is the ratio of both. Where a picture takes more than 3
MOST_SECONDS by the clock, the accuracy is out of reach. Accuracies where the noise of the reference
exceeds a fifth of the squared error are left out. The folder of
--cache keeps references and grids for later runs. Another reference or size has other files there.
The seconds of a grid are comparable only with runs on the same machine under the same load, so
delete two-grids-*.json there where this has changed.
"""
import argparse
import json
import math
import os
import subprocess
import tempfile

from picture_errors import Scene, folder_of

THREAD = ("--nthreads", "1")
# The likely cheapest ones come first, so that the others end early.
SETTINGS = {"exphotonmap": [],
            "exphotonmap with 16 rays": ["--set", "SurfaceIntegrator.finalgathersamples=16"],
            "path": [], "guidedpath": []}
PATIENCE = 3  # The picture of an accuracy may take 3 MOST_SECONDS by the clock.
LEAST_SHARE = .5  # of the smallest accuracy: the error that the grid has to reach


def grid_of(scene, most_seconds, least_error):
    """Returns for each setting a list of (relMSE, seconds), by falling error. It ends after the
    first point below the least error, or above the time of another setting for this error."""
    kept = os.path.join(scene.folder, f"two-grids-{most_seconds:g}-{least_error:g}.json")
    if os.path.exists(kept):
        with open(kept, encoding="utf-8") as file:
            return json.load(file)
    grid = {}
    limit = most_seconds
    for name, options in SETTINGS.items():
        points = []
        for octave in range(0, 13):
            errors, times = [], []
            for seed in ("500", "501"):
                picture, cpu = scene.render("grid", "--integrator", name.split()[0], "--spp",
                                            str(2 ** octave), "--seed", seed, *THREAD, *options)
                errors.append(scene.error(picture))
                times.append(cpu)
            cpu = min(times)
            points.append((max(sum(errors) / len(errors), 1e-12), cpu))
            reaches = 1e-12 < points[-1][0] < least_error ** 2
            if reaches or cpu > limit or 2 * cpu > most_seconds:
                limit = min(limit, cpu) if reaches else limit
                break
        grid[name] = points
    with open(kept, "w", encoding="utf-8") as file:
        json.dump(grid, file)
    return grid


def seconds_for(points, rel_mse, least_error):
    """Interpolates log seconds over log relMSE. Where a setting ended at the least error, seconds
    beyond it grow as without bias. None beyond the last point of other settings."""
    for (error, cpu), (next_error, next_cpu) in zip(points, points[1:]):
        if next_error <= rel_mse:
            if error <= rel_mse:
                return cpu
            t = math.log(error / rel_mse) / math.log(error / next_error)
            return cpu * (next_cpu / cpu) ** t
    error, cpu = points[-1]
    return cpu * error / rel_mse if error < least_error ** 2 else None


def best_of(grid, rel_mse, least_error):
    times = {name: seconds_for(points, rel_mse, least_error) for name, points in grid.items()}
    times = {name: time for name, time in times.items() if time is not None}
    if not times:
        return None, None
    name = min(times, key=times.get)
    return name, times[name]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "size", "reference"):
        parser.add_argument(name)
    parser.add_argument("most_seconds", type=float)
    parser.add_argument("seeds", type=int)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--accuracies", default="10,5,2")
    parser.add_argument("--cache")
    return parser.parse_args()


class Table:
    def __init__(self, given):
        self.given = given
        self.count = self.kept = self.thrifty = 0
        self.ratios = []
        print("| scene | accuracy | chosen | true errors | kept | CPU s (of it pilots) | best, CPU s |"
              " times best |")
        print("| --- | --- | --- | --- | --- | --- | --- | --- |", flush=True)

    def add_scene(self, path):
        with tempfile.TemporaryDirectory() as temporary:
            given = self.given
            folder = folder_of(given.cache, path, given.size, given.reference, temporary)
            scene = Scene(given.program, path, given.size, folder)
            scene.reference(given.reference)
            accuracies = [float(text) for text in given.accuracies.split(",")]
            self.least_error = LEAST_SHARE * min(accuracies) / 100
            grid = grid_of(scene, given.most_seconds, self.least_error)
            scene.folder = temporary
            for percent in accuracies:
                label = f"| {path.split('/')[-2]} | {percent:g} % |"
                if scene.noise / 4 > .2 * (percent / 100) ** 2:
                    print(label, "the reference is too noisy | | | | | |", flush=True)
                else:
                    self.add_row(label, scene, grid, percent / 100)

    def add_row(self, label, scene, grid, accuracy):
        errors, times, pilots, chosen = [], [], [], set()
        report = os.path.join(scene.folder, "report.json")
        for seed in range(1, self.given.seeds + 1):
            try:
                picture, cpu = scene.render(
                    "picture", "--accuracy", f"{100 * accuracy:g}%", "--seed", str(seed),
                    "--stats-json", report, *THREAD, most_seconds=PATIENCE * self.given.most_seconds)
            except subprocess.TimeoutExpired:
                self.count_promises(errors, accuracy)
                print(label, f"out of reach after {len(errors)} pictures | | | | | |", flush=True)
                return
            with open(report, encoding="utf-8") as file:
                statistics = json.load(file)
            errors.append(max(scene.error(picture), 0) ** .5)
            times.append(cpu)
            pilots += [phase["cpuSeconds"] for phase in statistics["phases"]
                       if phase["name"] == "pilots"]
            chosen.add(statistics["integrator"])
        hits = self.count_promises(errors, accuracy)
        name, best = best_of(grid, sum(error ** 2 for error in errors) / len(errors),
                             self.least_error)
        time = sum(times) / len(times)
        if best:
            self.ratios.append(time / best)
        print(label, f"{', '.join(sorted(chosen))} | "
              f"{', '.join(f'{100 * error:.2g}' for error in errors)} % | "
              f"{hits} of {len(errors)} | {time:.3g} ({sum(pilots) / len(pilots):.2g}) | "
              + (f"{name}, {best:.3g} | {time / best:.2f} |" if best else "not in the grid | |"),
              flush=True)

    def count_promises(self, errors, accuracy):
        """Returns how many of the errors keep the promise."""
        hits = sum(error <= accuracy for error in errors)
        self.count += len(errors)
        self.kept += hits
        self.thrifty += sum(error >= accuracy / 2 for error in errors)
        return hits

    def print_sums(self):
        print(f"{self.kept} of {self.count} promises kept; {self.thrifty} errors above half of the "
              f"accuracy; times {', '.join(f'{ratio:.2g}' for ratio in sorted(self.ratios))} times "
              "the best")


def main():
    given = arguments()
    table = Table(given)
    for path in given.scenes:
        table.add_scene(path)
    table.print_sums()


main()
