"""Renders pictures and measures their errors and CPU seconds, for the measurements beside this file."""
import os
import re
import resource
import subprocess
import sys

from read_exr import read_exr

OFFSET = .01  # of relMSE


def run(arguments, errors=False, most_seconds=None):
    """Returns what a program prints to standard output, or to standard error. Raises
    subprocess.TimeoutExpired after this time."""
    result = subprocess.run(arguments, capture_output=True, text=True, timeout=most_seconds)
    if result.returncode not in (0, 2):
        sys.exit(f"{' '.join(arguments)}\n{result.stderr}")
    return result.stderr if errors else result.stdout


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def folder_of(cache, path, size, reference, temporary):
    """Returns the folder of a scene's pictures, where a later run finds its reference."""
    if not cache:
        return temporary
    folder = os.path.join(cache, f"{path.split('/')[-2]}-{size}-{reference}")
    os.makedirs(folder, exist_ok=True)
    return folder


class Scene:
    def __init__(self, program, path, size, folder):
        self.program, self.path, self.size, self.folder = program, path, size, folder

    def render(self, name, *options, most_seconds=None):
        picture = os.path.join(self.folder, name + ".exr")
        before = cpu_seconds()
        run([self.program, self.path, "--resolution", self.size, "--footprint-spp", "16", "--float",
             "--quiet", "--no-progress", "-o", picture, *options], most_seconds=most_seconds)
        return picture, cpu_seconds() - before

    def rel_mse(self, picture, reference):
        text = run([self.program, "compare", reference, picture, "--max-relmse", "1e30"])
        return float(re.search(r"^relMSE\s+(\S+)", text, re.MULTILINE).group(1))

    def reference(self, cost, *options):
        """Renders two halves with guidedpath; keeps them and their squared difference. The cost of each
        is a number of seconds, or of samples, such as "256spp", which other work does not reduce.
        Halves that are in the folder already are not rendered again. Options go to both renders."""
        rule = (["--spp", cost.removesuffix("spp")] if cost.endswith("spp")
                else ["--time-limit", f"{cost}s"])
        self.halves = [os.path.join(self.folder, f"half{i}.exr") for i in (0, 1)]
        for i in (0, 1):
            if not os.path.exists(self.halves[i]):
                self.render(f"half{i}", "--integrator", "guidedpath", "--seed", str(1000 + i),
                            "--set", "SurfaceIntegrator.maxdepth=100", *rule, *options)
        first, second = self.references = [read_exr(half) for half in self.halves]
        # One half alone may miss a lamp that is smaller than a pixel, and would then give it the
        # level of a dark pixel. So levels are those of the mean.
        self.levels = {channel: [((a + b) / 2) ** 2 + OFFSET
                                 for a, b in zip(first[channel], second[channel])]
                       for channel in "RGB"}
        self.noise = self.mean(lambda channel, i: (first[channel][i] - second[channel][i]) ** 2)

    def mean(self, squared):
        """Returns the mean of a function of channel and pixel, relative to the squared radiance."""
        values = [squared(channel, i) / level for channel, levels in self.levels.items()
                  for i, level in enumerate(levels)]
        return sum(values) / len(values)

    def error(self, picture):
        """The relMSE of a picture, without the noise of the reference: (x - a)(x - b) has the
        expected value (x - truth)^2 if a and b are independent."""
        first, second = self.references
        x = read_exr(picture)
        return self.mean(lambda channel, i: ((x[channel][i] - first[channel][i]) *
                                             (x[channel][i] - second[channel][i])))
