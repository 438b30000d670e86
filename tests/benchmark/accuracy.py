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
"Best" is the CPU time of the cheapest setting in the grid for the error that the dial reached,
interpolated between two numbers of samples. They are rendered beside each picture of the dial,
because machines are noisy. Each picture has the setting for its own error. "Times best" is the ratio
of the mean times. Where a picture takes more than 3
MOST_SECONDS by the clock, the accuracy is out of reach. Accuracies where the noise of the reference
exceeds a fifth of the squared error are left out. The folder of
--cache keeps references and grids for later runs. Another reference or size has other files there.
The seconds of a grid choose the cheapest setting and are not printed.
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
    for name in SETTINGS:
        points = []
        for octave in range(0, 13):
            errors, times = [], []
            for seed in (500, 501):
                picture, cpu = render_of_grid(scene, name, octave, seed)
                errors.append(scene.error(picture))
                times.append(cpu)
            cpu = min(times)
            points.append((max(mean(errors), 1e-12), cpu))
            reaches = 1e-12 < points[-1][0] < least_error ** 2
            if reaches or cpu > limit or 2 * cpu > most_seconds:
                limit = min(limit, cpu) if reaches else limit
                break
        grid[name] = points
    with open(kept, "w", encoding="utf-8") as file:
        json.dump(grid, file)
    return grid


def mean(values):
    return sum(values) / len(values)


def render_of_grid(scene, name, octave, seed):
    """Returns the file and the CPU seconds of a render of a setting with 2^octave samples a pixel."""
    return scene.render("grid", "--integrator", name.split()[0], "--spp", str(2 ** octave), "--seed",
                        str(seed), *THREAD, *SETTINGS[name])


def place_of(points, rel_mse, least_error):
    """Returns where a setting has this error: its octave, the part of the way to the next one by
    log relMSE, and a factor on the seconds. Where a setting ended at the least error, seconds
    beyond it grow as without bias. None beyond the last point of other settings."""
    for octave, ((error, _), (next_error, _)) in enumerate(zip(points, points[1:])):
        if next_error <= rel_mse:
            if error <= rel_mse:
                return octave, 0, 1
            return octave, math.log(error / rel_mse) / math.log(error / next_error), 1
    error = points[-1][0]
    return (len(points) - 1, 0, max(error / rel_mse, 1)) if error < least_error ** 2 else None


def seconds_at(place, seconds_of):
    """Interpolates log seconds. `seconds_of` returns those of an octave."""
    octave, part, factor = place
    cpu = seconds_of(octave)
    return factor * (cpu * (seconds_of(octave + 1) / cpu) ** part if part > 0 else cpu)


def best_of(grid, rel_mse, least_error):
    """Returns the name and the place of the cheapest setting for an error; None: there is none."""
    found = []
    for name, points in grid.items():
        place = place_of(points, rel_mse, least_error)
        if place:
            found.append((seconds_at(place, lambda octave: points[octave][1]), name, place))
    return min(found)[1:] if found else None


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
        errors, times, pilots, chosen, best = [], [], [], set(), []
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
            best.append(self.best_beside(scene, grid, errors[-1], seed))
        hits = self.count_promises(errors, accuracy)
        time = mean(times)
        print(label, f"{', '.join(sorted(chosen))} | "
              f"{', '.join(f'{100 * error:.2g}' for error in errors)} % | "
              f"{hits} of {len(errors)} | {time:.3g} ({mean(pilots):.2g}) | "
              + self.text_of_best(best, time), flush=True)

    def best_beside(self, scene, grid, error, seed):
        """Renders with the cheapest setting for an error, beside the picture that has this error.
        Returns the name of the setting and its seconds; None: no setting has this error."""
        found = best_of(grid, max(error, 1e-6) ** 2, self.least_error)
        if not found:
            return None
        name, place = found
        return name, seconds_at(place, lambda octave: render_of_grid(scene, name, octave, seed)[1])

    def text_of_best(self, best, time):
        if None in best:
            return "not in the grid | |"
        names = ", ".join(sorted({name for name, _ in best}))
        seconds = mean([seconds for _, seconds in best])
        self.ratios.append(time / seconds)
        return f"{names}, {seconds:.3g} | {time / seconds:.2f} |"

    def count_promises(self, errors, accuracy):
        """Returns how many of the errors keep the promise."""
        hits = sum(error <= accuracy for error in errors)
        self.count += len(errors)
        self.kept += hits
        self.thrifty += sum(error >= accuracy / 2 for error in errors)
        return hits

    def print_sums(self):
        logs = [math.log(ratio) for ratio in self.ratios]
        geometric = f", geometric mean {math.exp(mean(logs)):.3g}" if logs else ""
        print(f"{self.kept} of {self.count} promises kept; {self.thrifty} errors above half of the "
              f"accuracy; times {', '.join(f'{ratio:.2g}' for ratio in sorted(self.ratios))} times "
              f"the best{geometric}")


def main():
    given = arguments()
    table = Table(given)
    for path in given.scenes:
        table.add_scene(path)
    table.print_sums()


main()
