#!/usr/bin/env python3
"""Measures how the error of progressive passes falls with CPU time, beside passes of fixed radii.

Usage: progressive.py PROGRAM SCENE WxH REFERENCE_SECONDS PASSES,... [INTEGRATOR]
The reference has two halves, rendered with guidedpath. Their noise is subtracted from all errors.
"slope" is the slope of log relMSE over log CPU seconds from a hundredth of the largest number of
passes on, by least squares. Theory expects -2/3 for progressive passes; errors of fixed radii level off.
"""
import math
import sys
import tempfile

from picture_errors import Scene

ALPHAS = {"progressive": None, "fixed radii": "1"}


def slope(points):
    xs, ys = zip(*[(math.log(x), math.log(y)) for x, y in points])
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / sum((a - x) ** 2 for a in xs)


def main():
    if len(sys.argv) not in (6, 7):
        sys.exit(__doc__)
    program, path, size, seconds, passes = sys.argv[1:6]
    integrator = sys.argv[6] if len(sys.argv) > 6 else "exphotonmap"
    counts = [int(n) for n in passes.split(",")]
    with tempfile.TemporaryDirectory() as folder:
        scene = Scene(program, path, size, folder)
        scene.reference(seconds)
        print(f"{path}, {size}, {integrator}: relMSE of the reference's noise {scene.noise / 4:.2g}")
        print("| passes | " + " | ".join(f"{k}: CPU s | relMSE" for k in ALPHAS) + " |")
        print("| --- |" + " --- | --- |" * len(ALPHAS), flush=True)
        points = {name: [] for name in ALPHAS}
        for count in counts:
            row = f"| {count} |"
            for name, alpha in ALPHAS.items():
                options = ["--progressive-alpha", alpha] if alpha else []
                picture, cpu = scene.render("picture", "--integrator", integrator, "--spp", "1",
                                            "--progressive", "--max-passes", str(count), *options,
                                            "--seed", str(count))
                error = scene.error(picture)
                row += f" {cpu:.2f} | {error:.2e} |"
                if error > 0 and 100 * count >= counts[-1]:
                    points[name].append((cpu, error))
            print(row, flush=True)
        for name, found in points.items():
            if len(found) > 1:
                print(f"slope of {name}: {slope(found):.2f}")


main()
