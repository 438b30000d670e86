#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Draws the speed-up of exphotonmap against the error, from the folders of studies:

    docs/guide/images/speedup.py OUT.svg "TITLE=FOLDER" ...

The time of an integrator to an error is interpolated on its front, linearly in log-log, as in
core/app/analysis/curves.cpp, and never beyond its ends. Errors below ten times the reference's noise
are left out.
"""
import csv
import math
import sys

LABELS = {"photonmap": "photonmap", "path": "path tracing", "bidirectional": "bidirectional path tracing"}
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 440, 64, 24, 62, 56

STYLE = """
text{font:13px system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;fill:#3a3a38}
.title{font-size:16px;font-weight:650}.name{font-weight:650}.grid{stroke:#8884;stroke-width:1}
.base{stroke:#888a;stroke-width:1.4}.band{fill:none;stroke-width:2.6;stroke-linejoin:round}
.c0{stroke:#d55e00}.c1{stroke:#009e73}.c2{stroke:#b0568f}.c3{stroke:#0072b2}
text.c0{fill:#c25500}text.c1{fill:#00835f}text.c2{fill:#a24c83}text.c3{fill:#0067a0}text{stroke:none}
circle{stroke-width:2;fill:#fff}.s1{stroke-dasharray:7 4}
@media (prefers-color-scheme:dark){text{fill:#d6d3cd}circle{fill:#0d1117}
.c0{stroke:#ff9a4d}.c1{stroke:#3fd0a4}.c2{stroke:#e39bcb}.c3{stroke:#5ab4f0}
text.c0{fill:#ff9a4d}text.c1{fill:#3fd0a4}text.c2{fill:#e39bcb}text.c3{fill:#5ab4f0}}
text.c0,text.c1,text.c2,text.c3{stroke:none}
"""


def fronts(folder):
    """Returns {label: [(error, seconds)]}, each with falling errors and growing seconds."""
    points, noise = {}, 0
    with open(folder + "/summary.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            error = float(row["error"] or "nan")
            noise = max(noise, float(row["relMSE"] or 0) - error)
            if error > 0 and row["label"] == row["integrator"]:
                points.setdefault(row["label"], []).append((float(row["cpuSeconds"]), error))
    result = {}
    for label, own in points.items():
        front = []
        for seconds, error in sorted(own):
            if not front or error < front[-1][0]:
                front.append((error, seconds))
        result[label] = front
    return result, 10 * noise


def seconds_to(front, error):
    for (e0, s0), (e1, s1) in zip(front, front[1:]):
        if e1 <= error <= e0:
            t = math.log(error / e0) / math.log(e1 / e0)
            return s0 * (s1 / s0) ** t
    return None


def curve(own, other, limit):
    """Returns [(error, ratio)] at the corners and between them, where both have a time."""
    low = max(own[-1][0], other[-1][0], limit)
    high = min(own[0][0], other[0][0])
    if not low < high:
        return []
    steps = 60
    result = []
    for i in range(steps + 1):
        error = high * (low / high) ** (i / steps)
        a, b = seconds_to(own, error), seconds_to(other, error)
        if a and b:
            result.append((error, b / a))
    return result


def ticks(low, high):
    for power in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1):
        for digit in (1, 2, 5):
            value = digit * 10.0**power
            if low <= value <= high:
                yield value


class Drawing:
    def __init__(self, curves, scene):
        self.scene = scene
        errors = [e for _, _, c in curves for e, _ in c]
        ratios = [r for _, _, c in curves for _, r in c] + [1]
        self.errors = (min(errors) / 1.15, max(errors) * 1.15)
        self.ratios = (min(ratios) / 1.3, max(ratios) * 1.35)
        self.parts = []
        self.names = []  # right end and y of each curve's name

    def x(self, error):  # smaller errors are on the right
        low, high = self.errors
        return LEFT + (WIDTH - RIGHT - LEFT) * math.log(high / error) / math.log(high / low)

    def y(self, ratio):
        low, high = self.ratios
        share = math.log(ratio / low) / math.log(high / low)
        return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * share

    def text(self, x, y, text, extra=""):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" {extra}>{text}</text>')

    def line(self, x0, y0, x1, y1, kind):
        self.parts.append(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" '
                          f'class="{kind}"/>')

    def axes(self):
        for value in ticks(*self.ratios):
            kind = "base" if value == 1 else "grid"
            self.line(LEFT, self.y(value), WIDTH - RIGHT, self.y(value), kind)
            self.text(LEFT - 8, self.y(value) + 4, f"{value:g}×", 'text-anchor="end"')
        for value in ticks(*self.errors):
            self.line(self.x(value), TOP, self.x(value), HEIGHT - BOTTOM, "grid")
            self.text(self.x(value), HEIGHT - BOTTOM + 18, f"{value:g}", 'text-anchor="middle"')
        self.text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 14, "error (relMSE): more accurate →",
                  'text-anchor="middle"')
        self.text(LEFT, 24, "exphotonmap is this many times as fast, at equal error, as …",
                  'class="title"')
        self.text(LEFT, 43, self.scene)

    def curve(self, title, label, points, number, style):
        path = " ".join(f"{self.x(e):.1f},{self.y(r):.1f}" for e, r in points)
        self.parts.append(f'<polyline points="{path}" class="band c{number} s{style}"/>')
        for e, r in (points[0], points[-1]):
            self.parts.append(f'<circle cx="{self.x(e):.1f}" cy="{self.y(r):.1f}" r="3.5" '
                              f'class="c{number}"/>')
        # A name stands over a curve that rises to its right end and under one that falls. Where that
        # place is taken, it stands to the right of the curve.
        e, r = points[-1]
        name = f"… {LABELS.get(label, label)}" + (f", {title}" if title else "")
        rises = r >= points[-2][1]
        x, y, anchor = self.x(e) + (40 if rises else 0), self.y(r) + (-10 if rises else 24), "end"
        width = 8 * len(name)
        if any(abs(y - above) < 16 and abs(x - end) < width for end, above in self.names):
            x, y, anchor = self.x(e) + 9, self.y(r) + 4, "start"
        self.names.append((x if anchor == "end" else x + width, y))
        self.text(x, y, name, f'class="name c{number}" text-anchor="{anchor}"')


def main():
    out, studies = sys.argv[1], [argument.split("=", 1) for argument in sys.argv[2:]]
    curves = []
    for title, folder in studies:
        all_fronts, limit = fronts(folder)
        own = all_fronts.pop("exphotonmap")
        for label, front in all_fronts.items():
            points = curve(own, front, limit)
            if points:
                curves.append((title, label, points))
                print(f"{title}, {label}: " + ", ".join(
                    f"{r:.1f} at {e:.3g}" for e, r in points[:: max(1, len(points) // 4)]))
    titles = [title for title, _ in studies]
    is_one = len(titles) == 1
    drawing = Drawing(curves, titles[0] if is_one else "")
    drawing.axes()
    for number, (title, label, points) in enumerate(curves):
        drawing.curve("" if is_one else title, label, points, number % 4, titles.index(title))
    with open(out, "w", encoding="utf-8") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
                   f'role="img" aria-label="Speed-up of exphotonmap against error">'
                   f'<style>{STYLE}</style>\n' + "\n".join(drawing.parts) + "\n</svg>\n")


main()
