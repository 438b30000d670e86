#!/usr/bin/env python3
"""Runs for each defect only what reaches it: reach.py FOLDER.

FOLDER has a build with many defects in it (together.py) and a file "names", whose lines are the
number of a switch and the name of its defect. First everything runs without a defect, each test
and each recorded scene in a process of its own, and writes which lines it reaches. Then each
defect is switched on for the scenes, tests and commands that reach its line, the quick ones first,
until one fails. A survivor that nothing reaches needs a test; one that is reached needs a look.
"""
import json
import os
import re
import subprocess
import sys
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FOLDER = Path(sys.argv[1]).resolve()
BIN = FOLDER / "build" / "bin"
PROGRAMS = ["unit", "parser", "plugin", "cli"]
LONGEST = 5.  # seconds of a test that is tried
# By kind of test: those with the least time that reach a line are tried, up to this many seconds.
BUDGET = {"unit": 10., "parser": 8., "plugin": 8., "cli": 20., "scene": 20.}
JOBS = int(os.environ.get("JOBS") or os.cpu_count())


def run(program, *arguments, timeout=600., **environment):
    """Returns status, output and seconds; 124 is the status of a time-out."""
    start = time.time()
    try:
        result = subprocess.run([BIN / f"test_{program}", *arguments], cwd=FOLDER / "build",
                                env={**os.environ, **environment}, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                timeout=timeout, text=True, errors="replace")
        return result.returncode, result.stdout, time.time() - start
    except subprocess.TimeoutExpired:
        return 124, "", time.time() - start


def names_of_tests(program):
    names, suite = [], ""
    for line in run(program, "--gtest_list_tests")[1].split("\n"):
        if re.match(r"\S+\.(\s|$)", line):
            suite = line.split()[0]
        elif line.startswith("  "):
            names.append(suite + line.split()[0])
    return [n for n in names if "DISABLED_" not in n]


class Reach:
    def __init__(self):
        self.path = FOLDER / "reached"
        self.seconds = {}                # of each item: ("unit", "Suite.Name") or ("scene", name)
        self.items = defaultdict(list)   # by switch

    def note_test(self, item):
        program, name = item
        status, _, seconds = run(program, f"--gtest_filter={name}", EXPHOTON_REACHED=str(self.path),
                                 EXPHOTON_REACHED_BY=f"{program} {name}")
        if status == 0 and seconds <= LONGEST:
            self.seconds[item] = seconds

    def note_scenes(self):
        output = run("recorded", "--apart", timeout=3600, EXPHOTON_REACHED=str(self.path))[1]
        for line in output.split("\n"):
            match = re.match(r"(\d+\.\d+) (.+)", line)
            if match:
                self.seconds["scene", match.group(2)] = float(match.group(1))

    def note_check(self, what):
        file = FOLDER / f"check.{what}"
        file.write_text(what + "\n")
        status, output, seconds = run("recorded", "--check", file, timeout=3600,
                                      EXPHOTON_REACHED=str(self.path), EXPHOTON_REACHED_BY=what)
        if status:
            print(f"{what} differ without a defect, and are left out: {output}", flush=True)
        else:
            self.seconds["check", what] = seconds

    def measure(self):
        """Again only if something was built since."""
        memory = FOLDER / "seconds.json"
        if memory.exists() and memory.stat().st_mtime > (BIN / "test_cli").stat().st_mtime:
            self.seconds = {tuple(item): seconds for item, seconds in json.loads(memory.read_text())}
        else:
            self.run_all()
            memory.write_text(json.dumps(list(self.seconds.items())))
        self.read_reached()

    def run_all(self):
        self.path.unlink(missing_ok=True)
        with ThreadPoolExecutor(JOBS) as pool:
            tasks = [pool.submit(self.note_scenes), pool.submit(self.note_check, "outputs"),
                     pool.submit(self.note_check, "figures")]
            tasks += [pool.submit(self.note_test, (program, name)) for program in PROGRAMS
                      for name in names_of_tests(program)]
            for task in tasks:
                task.result()

    def read_reached(self):
        by_name = {" ".join(i) if i[0] in PROGRAMS else i[1]: i for i in self.seconds}
        reached = defaultdict(set)
        for line in self.path.read_text(errors="replace").split("\n"):
            name, _, numbers = line.partition("\t")
            if name in by_name:
                for number in numbers.split():
                    reached[int(number)].add(by_name[name])
        for number, items in reached.items():
            self.items[number] = sorted(items, key=lambda item: self.seconds[item])


def batches(reach, number):
    """(program, arguments, names, expected seconds) of what reaches a switch, quick ones first."""
    items = reach.items[number]
    for program in ["unit", "parser", "plugin"] + ["recorded"] + ["cli"]:
        kinds = ("figures", "scene", "outputs") if program == "recorded" else (program,)
        for kind in kinds:
            chosen, total = [], 0.
            for item in items:
                is_kind = item == ("check", kind) or item[0] == kind
                if is_kind and total + reach.seconds[item] <= BUDGET.get(kind, 1e9):
                    chosen.append(item[1])
                    total += reach.seconds[item]
            if chosen:
                yield program, chosen, total


def try_defect(reach, number):
    """Says what notices the defect of a switch, or what reaches its line and does not."""
    defect = {"EXPHOTON_DEFECTS": str(number)}
    for program, names, seconds in batches(reach, number):
        if program == "recorded":
            file = FOLDER / f"check.{number}"
            file.write_text("\n".join(names) + "\n")
            arguments = ["--check", file]
        else:
            arguments = ["--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + ":".join(names)]
        status, output, _ = run(program, *arguments, timeout=20 + 4 * seconds, **defect)
        if status == 124:
            return f"{program} did not end"
        if status < 0:
            return f"{program}: signal {-status}"
        if status:
            if program == "recorded":
                return (output.split("\n") or [""])[0] or f"recorded: status {status}"
            failed = re.search(r"^\[  FAILED  \] ([^ ,]+)", output, re.M)
            return failed.group(1) if failed else f"{program}: status {status}"
    kinds = defaultdict(int)
    for item in reach.items[number]:
        kinds[item[1] if item[0] == "check" else item[0]] += 1
    reached = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    return f"NOT NOTICED, reached by {reached or 'nothing'}"


def main():
    defects = [line.split(" ", 1) for line in (FOLDER / "names").read_text().split("\n") if line]
    reach = Reach()
    start = time.time()
    reach.measure()
    print(f"{len(reach.seconds)} tests and scenes; {time.time() - start:.0f} s", flush=True)
    missed = 0
    with ThreadPoolExecutor(JOBS) as pool:
        results = [(name, pool.submit(try_defect, reach, int(number)))
                   for number, name in defects]
        for name, result in results:
            missed += "NOT NOTICED" in result.result()
            print(f"{name}: {result.result()}", flush=True)
    print(f"{len(defects) - missed} of {len(defects)} noticed; {time.time() - start:.0f} s")


main()
