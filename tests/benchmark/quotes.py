#!/usr/bin/env python3
"""Measures how well `exphoton quote` predicts: renders what it quotes and compares.

Usage: quotes.py PROGRAM WxH REFERENCE_SECONDS MOST_SECONDS SCENE ...
                 [--accuracies PERCENT,...] [--cache FOLDER]
Quotes of more than MOST_SECONDS are not rendered. The error of a picture is measured against a
reference of guidedpath (picture_errors.py). REFERENCE_SECONDS may be samples, such as 256spp. The
error is a root mean square over three seeds, because the error of one picture can be far from the
mean where bright samples are rare. "to reach" is the CPU time to reach the accuracy: that of the
command, with the time of its samples times the squared ratio of errors. Fewer samples than the
command's are a half of them, a quarter and so on, because samplers take such numbers.
Accuracies where the noise of the reference exceeds a fifth of the squared error are left out. The
folder of --cache keeps references for later runs.
"""
import argparse
import json
import math
import os
import tempfile

from picture_errors import Scene, folder_of, run
from quote_offers import offers

SEEDS = "77", "78", "79"


def share_needed(ratio, samples):
    """Returns the share of the samples that brings this ratio of errors to 1."""
    share = max(ratio ** 2, 1 / samples)
    return share if share > 1 else 2 ** -math.floor(math.log2(1 / share))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "size", "reference"):
        parser.add_argument(name)
    parser.add_argument("most_seconds", type=float)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--accuracies", default="10,5,2")
    parser.add_argument("--cache")
    given = parser.parse_args()
    count = near = inside = 0
    print("| scene | error | integrator | quoted s | command s | error reached | to reach s |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    for path in given.scenes:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(given.program, path, given.size,
                          folder_of(given.cache, path, given.size, given.reference, folder))
            scene.reference(given.reference)
            scene.folder = folder
            text = run([given.program, "quote", path, "--resolution", given.size, "--accuracies",
                        given.accuracies + "%", "--quiet"])
            for accuracy, name, predicted, least, most, options in offers(text):
                is_unknown = scene.noise / 4 > .2 * accuracy ** 2
                if predicted > given.most_seconds or is_unknown:
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
                needed = cpu + of_samples * (share_needed(error / accuracy, samples) - 1)
                count += 1
                near += 1 / 1.5 <= needed / predicted <= 1.5
                inside += least <= needed <= most
                print(f"| {path.split('/')[-2]} | {100 * accuracy:g} % | {name} | {predicted:.3g} "
                      f"({least:.3g} to {most:.3g}) | {cpu:.3g} | {100 * error:.2g} % | {needed:.3g} |",
                      flush=True)
    print(f"{near} of {count} within a factor of 1.5, {inside} inside their intervals")


main()
