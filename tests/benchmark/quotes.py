#!/usr/bin/env python3
"""Measures how well `exphoton quote` predicts: renders what it quotes and compares.

Usage: quotes.py PROGRAM WxH REFERENCE_SECONDS MOST_SECONDS SCENE ...
Quotes of more than MOST_SECONDS are not rendered. The error of a picture is measured against a
reference of guidedpath (picture_errors.py). REFERENCE_SECONDS may be samples, such as 256spp. The
error is a root mean square over three seeds, because the error of one picture can be far from the
mean where bright samples are rare. "to reach" is the CPU time to reach the accuracy: that of the
command, with the time of its samples times the squared ratio of errors, but at least one sample.
"""
import json
import os
import sys
import tempfile

from picture_errors import Scene, run
from quote_offers import offers

SEEDS = "77", "78", "79"


def main():
    if len(sys.argv) < 6:
        sys.exit(__doc__)
    program, size, reference, most_seconds = sys.argv[1:5]
    count = near = inside = 0
    print("| scene | error | integrator | quoted s | command s | error reached | to reach s |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    for path in sys.argv[5:]:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(program, path, size, folder)
            scene.reference(reference)
            text = run([program, "quote", path, "--resolution", size, "--accuracies", "10,5,2%",
                        "--quiet"])
            for accuracy, name, predicted, least, most, options in offers(text):
                if predicted > float(most_seconds):
                    continue
                at = options.index("--resolution")
                del options[at:at + 2]
                errors, times, parts = [], [], []
                report = os.path.join(folder, "report.json")
                for seed in SEEDS:
                    picture, seconds = scene.render("picture", *options, "--seed", seed,
                                                    "--stats-json", report)
                    errors.append(scene.error(picture))
                    times.append(seconds)
                    with open(report, encoding="utf-8") as file:
                        statistics = json.load(file)
                    parts += [phase["cpuSeconds"] for phase in statistics["phases"]
                              if phase["name"] in ("render", "share")]
                samples = statistics["samplesPerPixel"]
                cpu, of_samples = sum(times) / len(times), sum(parts) / len(times)
                error = max(sum(errors) / len(errors), 0) ** .5
                needed = cpu + of_samples * (max((error / accuracy) ** 2, 1 / samples) - 1)
                count += 1
                near += 1 / 1.5 <= needed / predicted <= 1.5
                inside += least <= needed <= most
                print(f"| {path.split('/')[-2]} | {100 * accuracy:g} % | {name} | {predicted:.3g} "
                      f"({least:.3g} to {most:.3g}) | {cpu:.3g} | {100 * error:.2g} % | {needed:.3g} |",
                      flush=True)
    print(f"{near} of {count} within a factor of 1.5, {inside} inside their intervals")


main()
