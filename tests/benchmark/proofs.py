#!/usr/bin/env python3
"""Measures what the proofs about lights save: CPU seconds with --effects auto and all, in turn.

Usage: proofs.py PROGRAM REPEATS SCENE ...
Prints medians. Fails if two pictures differ, or if a proof saves less than 20 % of the time.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

from read_exr import read_exr


def main():
    program, repeats, fails = sys.argv[1], int(sys.argv[2]), False
    print("| scene | all | auto | saved |")
    print("| --- | --- | --- | --- |", flush=True)
    for scene in sys.argv[3:]:
        seconds, pictures = {"auto": [], "all": []}, set()
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(repeats):
                for effects, times in seconds.items():
                    picture, counts = (os.path.join(folder, name) for name in ("a.exr", "a.json"))
                    subprocess.run([program, scene, "--effects", effects, "--nthreads", "1",
                                    "--float", "--quiet", "-o", picture, "--stats-json", counts],
                                   check=True)
                    pictures.add(repr(sorted(read_exr(picture).items())))
                    with open(counts) as file:
                        times.append(json.load(file)["cpuSeconds"])
        whole, less = (statistics.median(seconds[key]) for key in ("all", "auto"))
        fails = fails or len(pictures) != 1 or less > .8 * whole
        print(f"| {os.path.basename(scene)} | {whole:.3g} | {less:.3g} | "
              f"{100 * (1 - less / whole):.0f} %{'' if len(pictures) == 1 else ', DIFFERENT'} |",
              flush=True)
    sys.exit(fails)


main()
