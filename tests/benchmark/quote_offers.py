"""Reads what `exphoton quote` prints."""
import re
import shlex

UNITS = {"s": 1, "min": 60, "h": 3600}
TIME = r"([\d.]+) (s|min|h)"


def seconds(value, unit):
    return float(value) * UNITS[unit]


def offers(text):
    """Yields (accuracy, integrator, predicted, least, most, options) for each price."""
    accuracy = None
    lines = text.splitlines()
    for line, following in zip(lines, lines[1:] + [""]):
        if match := re.match(r"error ([\d.]+) %", line):
            accuracy = float(match.group(1)) / 100
        elif match := re.match(rf"  (\S+)\s+{TIME} \({TIME} to (?:{TIME}|no known limit)\)", line):
            name, *times = match.groups()
            pairs = list(zip(times[::2], times[1::2]))
            most = seconds(*pairs[2]) if pairs[2][0] else float("inf")
            yield accuracy, name, seconds(*pairs[0]), seconds(*pairs[1]), most, shlex.split(following)[2:]
