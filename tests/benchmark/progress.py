#!/usr/bin/env python3
"""Measures the estimates of the time left that the progress bar shows.

Usage: progress.py PROGRAM WxH SEEDS SCENE[:OPTION ...] ...
Each scene is rendered in a pseudo-terminal of 120 columns, for example with
"scenes/toy-room/exphotonmap.pbrt:--target-error .004". The table has the ratio of the predicted to
the true total time, as the bar showed it last at 10, 20, 30 and 50 % of the time of the render. The
ratio is the geometric mean over the seeds, and (least to most) follows. "none" counts the seeds
without an estimate. The last row is the share of all estimates that are within a factor of 2.
"""
import math
import os
import pty
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import termios
import time
import fcntl

SHARES = .1, .2, .3, .5
DURATION = r"(?:(\d+) h (\d+) min|(\d+) min (\d+) s|([\d.]+) s)"
BAR = re.compile(r"%\s+" + DURATION + r"(?:, (?:about )?" + DURATION + " left)?")


def seconds(parts):
    hours, of_hour, minutes, of_minute, plain = parts
    if hours:
        return 3600 * int(hours) + 60 * int(of_hour)
    if minutes:
        return 60 * int(minutes) + int(of_minute)
    return float(plain) if plain else None


def watch(command):
    """Returns the elapsed time and the predicted total of each bar, and the time of the last."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 120, 0, 0))
    process = subprocess.Popen(command, stderr=slave, stdout=subprocess.DEVNULL,
                               env=dict(os.environ, TERM="xterm"))
    os.close(slave)
    bars, first, last, text = [], None, 0, ""
    while True:
        try:
            data = os.read(master, 65536)
        except OSError:
            break
        if not data:
            break
        now = time.monotonic()
        text = (text + data.decode(errors="replace"))[-2000:]
        found = list(BAR.finditer(text))
        if "\r\x1b[K" in data.decode(errors="replace"):
            last = now
        if found:
            parts = found[-1].groups()
            elapsed, left = seconds(parts[:5]), seconds(parts[5:])
            first = now - elapsed if first is None else first
            bars.append((now - first, None if left is None else elapsed + left))
            text = text[found[-1].end():]
    os.close(master)
    if process.wait() != 0:
        sys.exit(f"{shlex.join(command)} failed: {text}")
    return bars, last - first if first is not None else 0


def ratio_at(bars, total, share):
    shown = [predicted for elapsed, predicted in bars if elapsed <= share * total]
    return shown[-1] / total if shown and shown[-1] else None


def cell(ratios):
    known = [ratio for ratio in ratios if ratio]
    if not known:
        return "none"
    mean = math.exp(sum(map(math.log, known)) / len(known))
    text = f"{mean:.2f}"
    if len(known) > 1:
        text += f" ({min(known):.2f} to {max(known):.2f})"
    missing = len(ratios) - len(known)
    return text + (f", none: {missing}" if missing else "")


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    program, size, seeds = sys.argv[1:4]
    print("| scene | options | s | " + " | ".join(f"{share:.0%}" for share in SHARES) + " |")
    print("| --- | --- | --- |" + " --- |" * len(SHARES), flush=True)
    everything = [[] for _ in SHARES]
    for entry in sys.argv[4:]:
        path, _, options = entry.partition(":")
        columns, totals = [[] for _ in SHARES], []
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(1, int(seeds) + 1):
                bars, total = watch([program, "render", path, "--resolution", size, "--seed",
                                     str(seed), "-o", os.path.join(folder, "picture.exr"),
                                     "--nthreads", "2"] + shlex.split(options))
                totals.append(total)
                for column, share in zip(columns, SHARES):
                    column.append(ratio_at(bars, total, share))
        for column, part in zip(columns, everything):
            part += column
        name = "/".join(path.split("/")[-2:]).removesuffix(".pbrt")
        print(f"| {name} | {options} | {sum(totals) / len(totals):.2g} | "
              + " | ".join(map(cell, columns)) + " |", flush=True)
    near = [sum(1 for r in part if r and .5 <= r <= 2) / len(part) for part in everything]
    print("| within a factor of 2 | | | " + " | ".join(f"{share:.0%}" for share in near) + " |")


if __name__ == "__main__":
    main()
