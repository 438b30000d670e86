#!/usr/bin/env python3
"""Measures whether `--accuracy` keeps its promise, and what it costs.

Usage: accuracy.py PROGRAM WxH REFERENCE_SECONDS MOST_SECONDS SEEDS SCENE ...
Renders each scene with accuracies of 10, 5 and 2 %. The error of a picture is measured against a
reference of guidedpath (picture_errors.py). REFERENCE_SECONDS may be samples, such as 256spp. The grid has path, guidedpath and exphotonmap, the latter
with the gather rays of the scene and with 16, and 1 to 4096 samples a pixel, as far as a render takes
at most MOST_SECONDS. "Best" is the CPU time of the cheapest setting for the mean error that the dial
reached, interpolated in the grid. Accuracies that the grid does not reach are left out, and so are
those where the noise of the reference exceeds a fifth of the squared error.
"""
import json
import math
import os
import sys
import tempfile

from picture_errors import Scene

SETTINGS = {"path": [], "guidedpath": [], "exphotonmap": [],
            "exphotonmap with 16 rays": ["--set", "SurfaceIntegrator.finalgathersamples=16"]}
ACCURACIES = (.10, .05, .02)


def grid_of(scene, most_seconds):
    """Returns for each setting a list of (relMSE, seconds), by falling error."""
    grid = {}
    for name, options in SETTINGS.items():
        points = []
        for octave in range(0, 13):
            picture, cpu = scene.render("grid", "--integrator", name.split()[0], "--spp",
                                        str(2 ** octave), "--seed", "500", *options)
            points.append((max(scene.error(picture), 1e-12), cpu))
            if 2 * cpu > most_seconds:
                break
        grid[name] = points
    return grid


def seconds_for(points, rel_mse):
    """Interpolates log seconds over log relMSE; None beyond the last point."""
    for (error, cpu), (next_error, next_cpu) in zip(points, points[1:]):
        if next_error <= rel_mse:
            if error <= rel_mse:
                return cpu
            t = math.log(error / rel_mse) / math.log(error / next_error)
            return cpu * (next_cpu / cpu) ** t
    return None


def best_of(grid, rel_mse):
    times = {name: seconds_for(points, rel_mse) for name, points in grid.items()}
    times = {name: time for name, time in times.items() if time is not None}
    if not times:
        return None, None
    name = min(times, key=times.get)
    return name, times[name]


def main():
    if len(sys.argv) < 7:
        sys.exit(__doc__)
    program, size, reference, most_seconds, seeds = sys.argv[1:6]
    count = kept = thrifty = 0
    ratios = []
    print("| scene | accuracy | chosen | true errors | kept | CPU s (of it pilots) | best, CPU s |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    for path in sys.argv[6:]:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(program, path, size, folder)
            scene.reference(reference)
            grid = grid_of(scene, float(most_seconds))
            label = path.split("/")[-2]
            for accuracy in ACCURACIES:
                if scene.noise / 4 > .2 * accuracy ** 2:
                    print(f"| {label} | {100 * accuracy:g} % | the reference is too noisy | | | | |",
                          flush=True)
                    continue
                if best_of(grid, accuracy ** 2)[1] is None:
                    print(f"| {label} | {100 * accuracy:g} % | out of reach | | | | |", flush=True)
                    continue
                errors, times, pilots, chosen = [], [], [], set()
                for seed in range(1, int(seeds) + 1):
                    report = os.path.join(folder, "report.json")
                    picture, cpu = scene.render("picture", "--accuracy", f"{100 * accuracy:g}%",
                                                "--seed", str(seed), "--stats-json", report)
                    with open(report, encoding="utf-8") as file:
                        statistics = json.load(file)
                    errors.append(max(scene.error(picture), 0) ** .5)
                    times.append(cpu)
                    pilots += [phase["cpuSeconds"] for phase in statistics["phases"]
                               if phase["name"] == "pilots"]
                    chosen.add(statistics["integrator"])
                count += len(errors)
                hits = sum(error <= accuracy for error in errors)
                kept += hits
                thrifty += sum(error >= accuracy / 2 for error in errors)
                mean = sum(error ** 2 for error in errors) / len(errors)
                name, best = best_of(grid, mean)
                time = sum(times) / len(times)
                if best:
                    ratios.append(time / best)
                print(f"| {label} | {100 * accuracy:g} % | {', '.join(sorted(chosen))} | "
                      f"{', '.join(f'{100 * error:.2g}' for error in errors)} % | "
                      f"{hits} of {len(errors)} | {time:.3g} ({sum(pilots) / len(pilots):.2g}) | "
                      + (f"{name}, {best:.3g} |" if best else "not in the grid |"), flush=True)
    print(f"{kept} of {count} promises kept; {thrifty} errors above half of the accuracy; times "
          f"{', '.join(f'{ratio:.2g}' for ratio in sorted(ratios))} times the best")


main()
