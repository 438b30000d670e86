#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Measures how often `exphoton compare` fails equal pictures, and misses a recoloured wall.

usage: compare_rates.py PROGRAM [INTEGRATOR ...] [--trials N] [--from FIRST] [--paints PAINT ...]

Each trial renders a room with two seeds and, with other seeds, the same room with a wall of another
paint. Integrators with photon maps get four references with halves, which four trials in turn
share. The table of docs/guide/regression-tests.md comes from here.
"""
import argparse
import os
import subprocess
import tempfile

SIGNIFICANCES = ("0.05", "0.01")
PAINT = ".72 .29 .05"
OTHER_PAINTS = {"clear": ".60 .36 .10", "slight": ".72 .33 .05"}
REFERENCES = {"exphotonmap": 4, "photonmap": 4}  # for each picture; others need one


def wall(points, color):
    return (f'AttributeBegin Material "matte" "color Kd" [{color}] Shape "trianglemesh" '
            f'"integer indices" [0 1 2 0 2 3] "point P" [{points}] AttributeEnd\n')


def room(paint):
    """Returns a closed room of 4 m with a lamp and a wall of this paint."""
    return ('LookAt 0 0 -3.2  0 0 0  0 1 0 Camera "perspective" "float fov" [60]\n'
            'Film "image" "integer xresolution" [48] "integer yresolution" [36]\n'
            'PixelFilter "gaussian" Sampler "lowdiscrepancy" "integer pixelsamples" [16]\n'
            'SurfaceIntegrator "exphotonmap" WorldBegin\n'
            'AttributeBegin AreaLightSource "area" "color L" [12 11 9] Material "matte"\n'
            'Translate .4 1.2 .3 Shape "sphere" "float radius" [.3] AttributeEnd\n' +
            wall("-2 -2 2  2 -2 2  2 2 2  -2 2 2", ".7 .7 .7") +
            wall("-2 -2 -4  -2 -2 2  -2 2 2  -2 2 -4", paint) +
            wall("2 -2 -4  2 -2 2  2 2 2  2 2 -4", ".2 .5 .6") +
            wall("-2 -2 -4  2 -2 -4  2 -2 2  -2 -2 2", ".5 .5 .5") +
            wall("-2 2 -4  2 2 -4  2 2 2  -2 2 2", ".8 .8 .8") +
            wall("-2 -2 -4  2 -2 -4  2 2 -4  -2 2 -4", ".5 .5 .5") + 'WorldEnd\n')


class Experiment:
    """Counts verdicts for one integrator."""

    def __init__(self, program, integrator, folder, paints):
        self.paints = paints
        self.program, self.integrator, self.folder = program, integrator, folder
        self.counts = {}
        scenes = {"room": PAINT, **OTHER_PAINTS}
        for name, paint in scenes.items():
            with open(self.path(name + ".pbrt"), "w", encoding="utf-8") as file:
                file.write(room(paint))

    def path(self, name):
        return os.path.join(self.folder, name)

    def render(self, scene, seed, picture):
        subprocess.run([self.program, "render", self.path(scene + ".pbrt"), "--integrator",
                        self.integrator, "--two-halves", "--float", "--quiet", "--nthreads", "1",
                        "--seed", str(seed), "-o", self.path(picture)],
                       check=True, capture_output=True)

    def compare(self, kind, references, picture):
        for count in sorted({1, len(references)}):
            more = [word for name in references[1:count]
                    for word in ("--more-reference", self.path(name))]
            for significance in SIGNIFICANCES:
                result = subprocess.run(
                    [self.program, "compare", self.path(references[0]), self.path(picture),
                     "--z-test", "--significance", significance] + more,
                    check=False, capture_output=True)
                if result.returncode > 1:
                    raise SystemExit(result.stderr.decode())
                key = (kind, count, significance)
                self.counts[key] = self.counts.get(key, 0) + result.returncode

    def trial(self, number):
        count = REFERENCES.get(self.integrator, 1)
        shared = number // count
        references = [f"reference{i}.exr" for i in range(count)]
        if number % count == 0:
            for i, name in enumerate(references):
                self.render("room", 1_000_000 + shared * count + i, name)
        kinds = [("equal", "room")] + [(name, name) for name in self.paints]
        for offset, (kind, scene) in enumerate(kinds):
            self.render(scene, 10 * number + 1 + offset, "picture.exr")
            self.compare(kind, references, "picture.exr")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("integrators", nargs="*",
                        default=["path", "directlighting", "exphotonmap"])
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--paints", nargs="*", choices=list(OTHER_PAINTS),
                        default=list(OTHER_PAINTS))
    arguments = parser.parse_args()
    print("integrator, pictures, references, significance: failures of trials")
    for integrator in arguments.integrators:
        with tempfile.TemporaryDirectory() as folder:
            experiment = Experiment(arguments.program, integrator, folder, arguments.paints)
            for number in range(arguments.first, arguments.first + arguments.trials):
                experiment.trial(number)
            for (kind, count, significance), failures in sorted(experiment.counts.items()):
                print(f"{integrator}, {kind}, {count}, {significance}: "
                      f"{failures} of {arguments.trials}", flush=True)


if __name__ == "__main__":
    main()
