#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Renders a part of the hall by three integrators in equal CPU time, and writes the pictures side by
side with their times and errors. It needs Pillow.

    scenes/swimming-hall/make_triptych.py build/bin/exphoton --seconds 60 --reference-seconds 1800

A time is CPU time from reading the scene to writing the picture. A short render of each integrator
gives its price of a sample; the number of samples of the picture follows from it, and a render
whose time is wrong by more than a tenth is repeated once. The error is relMSE against a picture by
exphotonmap with another seed, ten times as many photons, and the samples that fit into the time of the
reference.
"""
import argparse
import json
import os
import subprocess
import tempfile

from PIL import Image, ImageDraw, ImageFont

FOLDER = os.path.dirname(os.path.abspath(__file__))
# The part of the picture, with water, wall and vault.
WINDOW = ".02,.36,.30,.96"
EXPOSURE = "-.2"
# The photons of a picture that takes a minute. Only the photon integrators have them.
PHOTONS = {"causticphotons": 150000, "indirectphotons": 100000, "maxphotonpaths": 6000000}
PHOTON_INTEGRATORS = ("exphotonmap", "photonmap")
LINE = 26


class Hall:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def file(self, name):
        return os.path.join(self.folder, name)

    def render(self, integrator, name, samples, seed=1, photons=1):
        """Renders a picture of one integrator and returns its CPU seconds."""
        command = [self.program, "render", os.path.join(FOLDER, integrator + ".pbrt"), "--quiet",
                   "--cropwindow", WINDOW, "--sampler", "random", "--spp", str(samples), "--seed", str(seed),
                   "--footprint-spp", "16", "-o", self.file(name + ".exr"),
                   "--stats-json", self.file(name + ".json")]
        if integrator in PHOTON_INTEGRATORS:
            for key, value in PHOTONS.items():
                command += ["--set", "SurfaceIntegrator.%s=%d" % (key, value * photons)]
        subprocess.run(command, check=True)
        with open(self.file(name + ".json")) as file:
            return json.loads(file.readline())["cpuSeconds"]

    def render_for(self, integrator, name, seconds, **options):
        """Renders for a CPU time and returns it."""
        few, more = (self.render(integrator, name, n, **options) for n in (1, 2))
        price = max(more - few, .02 * few)
        samples = max(1, round(1 + (seconds - few) / price))
        used = self.render(integrator, name, samples, **options)
        if abs(used / seconds - 1) > .1 and samples > 1:
            samples = max(1, round(samples * seconds / used))
            used = self.render(integrator, name, samples, **options)
        print("%s: %d samples a pixel, %.1f s" % (name, samples, used), flush=True)
        return used

    def error(self, name):
        result = subprocess.run([self.program, "compare", "--max-relmse", "1e9", self.file("reference.exr"),
                                 self.file(name + ".exr")], check=True, capture_output=True, text=True)
        words = result.stdout.replace(":", " ").split()
        return float(words[words.index("relMSE") + 1])

    def picture(self, name):
        png = self.file(name + ".png")
        subprocess.run([self.program, "convert", self.file(name + ".exr"), png, "--exposure", EXPOSURE,
                        "--tone-curve", "filmic"], check=True, stderr=subprocess.DEVNULL)
        return Image.open(png).convert("RGB")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("program")
    options.add_argument("--seconds", type=float, default=60)
    options.add_argument("--reference-seconds", type=float, default=1800)
    options.add_argument("--out", default=os.path.join(FOLDER, "images", "triptych.jpg"))
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        hall = Hall(given.program, folder)
        hall.render_for("exphotonmap", "reference", given.reference_seconds, seed=2, photons=10)
        columns = []
        for integrator in ("exphotonmap", "path", "photonmap"):
            seconds = hall.render_for(integrator, integrator, given.seconds)
            error = hall.error(integrator)
            number = "%.0f" % error if error > 100 else "%.3g" % error
            columns.append((hall.picture(integrator), integrator,
                            "%.0f s, relMSE %s" % (seconds, number)))
    width, height = columns[0][0].size
    sheet = Image.new("RGB", (3 * width + 16, height + 2 * LINE + 8), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.truetype("DejaVuSans.ttf", 18)
    for i, (image, *lines) in enumerate(columns):
        x = i * (width + 8)
        sheet.paste(image, (x, 0))
        for j, line in enumerate(lines):
            draw.text((x + width / 2, height + 4 + (j + .5) * LINE), line, fill="black", font=font,
                      anchor="mm")
    sheet.save(given.out, quality=90, optimize=True)


main()
