#!/usr/bin/env python3
"""Compiles many defects into one build: together.py FOLDER TARGET ...

FOLDER/src is a copy of the sources and FOLDER/build its build. The defects come from standard
input: a line "number name file", a line "- text" and a line "+ replacement" for each. Each becomes a choice at run time (rewrite.py), and the environment variable
EXPHOTON_DEFECTS switches on those whose numbers it lists. Where a rewritten line does not
compile, the defects there get their next choice; the messages of the compiler say which. The
numbers of the defects that are in the build go to FOLDER/numbers, one a line. Afterwards
FOLDER/src holds the sources as they were, because some tests read them.
"""
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from rewrite import Source

# A defect is asked for by exphoton_defects[7], which also notes that the line was reached.
SWITCH_HEADER = """#pragma once
#ifdef __cplusplus
extern "C" __attribute__((visibility("default"))) unsigned char exphoton_switches[];
extern "C" __attribute__((visibility("default"))) unsigned char exphoton_reached[];
struct ExphotonDefects {
  bool operator[](unsigned number) const {
    if (!exphoton_reached[number]) exphoton_reached[number] = 1;
    return exphoton_switches[number];
  }
};
static constexpr ExphotonDefects exphoton_defects{};
#endif
"""
SWITCH_FILE = "core/base/error.cpp"  # the variables are added to its end
# EXPHOTON_REACHED names a file, to which each process adds a line at its end: what
# EXPHOTON_REACHED_BY says, a tab, and the numbers that were reached.
SWITCH_SOURCE = """
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <unistd.h>
// Set before the constructors of other files run, because constants may depend on it.
extern "C" __attribute__((visibility("default"))) unsigned char exphoton_switches[{size}] = {{}};
extern "C" __attribute__((visibility("default"))) unsigned char exphoton_reached[{size}] = {{}};
__attribute__((constructor(101))) static void ReadDefects() {{
  const char* text = std::getenv("EXPHOTON_DEFECTS");
  while (text && *text) {{
    char* end = nullptr;
    const unsigned long number = std::strtoul(text, &end, 10);
    if (end == text) return;
    if (number < {size}) exphoton_switches[number] = 1;
    text = *end == ',' ? end + 1 : end;
  }}
}}
__attribute__((destructor(101))) static void WriteReached() {{
  const char* path = std::getenv("EXPHOTON_REACHED");
  const char* by = std::getenv("EXPHOTON_REACHED_BY");
  if (!path) return;
  std::string line = std::string(by ? by : "") + "\\t";
  for (int i = 0; i < {size}; ++i)
    if (exphoton_reached[i]) line += std::to_string(i) + " ";
  line += "\\n";
  const int file = open(path, O_WRONLY | O_APPEND | O_CREAT, 0644);
  if (file < 0) return;
  (void)!write(file, line.data(), line.size());
  close(file);
}}
"""
MESSAGE = re.compile(r"^(/[^:\n]+):(\d+):(\d+):\s+(error|fatal error|note|required from)?", re.M)
MAX_ROUNDS = 25
# A defect is left out after this many forms that do not compile.
MOST_FORMS = int(os.environ.get("MUTATION_FORMS") or 1000)
MOST_FLAGS = 8192


class Together:
    def __init__(self, folder):
        self.folder = folder
        self.src = folder / "src"
        self.build = folder / "build"
        self.sources = {}  # by file
        self.numbers = {}  # of the caller, by flag
        self.memory = folder / "known.json"  # flag and choice, by name and texts
        self.known = json.loads(self.memory.read_text()) if self.memory.exists() else {}

    def read(self, lines):
        for i in range(0, len(lines) - 2, 3):
            number, name, file = lines[i].split()
            text, instead = lines[i + 1][2:], lines[i + 2][2:]
            if Path(file).suffix not in (".cpp", ".h", ".inl"):
                continue
            if file not in self.sources:
                self.sources[file] = Source((self.src / file).read_text())
            key = f"{name} {text} {instead}"
            flag, chosen = self.known.setdefault(key, [len(self.known), 0])
            if flag >= MOST_FLAGS:
                sys.exit(f"more than {MOST_FLAGS} defects: remove {self.memory}")
            self.numbers[flag] = number
            defect = self.sources[file].add(flag, name, text, instead)
            defect.key, defect.chosen = key, chosen

    def defects(self):
        return [d for source in self.sources.values() for d in source.defects]

    def write(self):
        """Puts the rewritten sources into src; equal ones keep their times."""
        self.marks = {}
        for file, source in self.sources.items():
            text, marks = source.rewritten()
            if file == SWITCH_FILE:
                text += SWITCH_SOURCE.format(size=MOST_FLAGS)
            kept = self.folder / "rewritten" / file
            kept.parent.mkdir(parents=True, exist_ok=True)
            if not kept.exists() or kept.read_text() != text:
                kept.write_text(text)
            shutil.copy2(kept, self.src / file)
            starts = [0] + [m.end() for m in re.finditer("\n", text)]
            self.marks[str(self.src / file)] = (marks, starts)

    def take_out(self, originals):
        for file in self.sources:
            shutil.copy2(originals / file, self.src / file)

    def compile(self, targets, jobs):
        result = subprocess.run(["ninja", "-C", self.build, "-j", str(jobs), "-k", "0", *targets],
                                capture_output=True, text=True, errors="replace")
        (self.folder / "build.log").write_text(result.stdout)
        return result.returncode == 0, result.stdout

    def blamed(self, file, line, column):
        """The defects whose change is at this place; or whose span is; or the one before it."""
        marks, starts = self.marks[file]
        at = starts[min(line, len(starts)) - 1] + column - 1
        changed = [m[0] for m in marks if m[3] <= at <= m[4]]
        if changed:
            return changed, True
        inside = sorted((m[2] - m[1], m[0]) for m in marks if m[1] <= at <= m[2])
        if inside:
            return [inside[0][1]], True
        before = [m for m in marks if m[2] <= at]
        return ([max(before, key=lambda m: m[2])[0]] if before else [m[0] for m in marks[:1]]), False

    def next_choices(self, log):
        """Gives the defects that messages point to their next choice; returns whether any was."""
        sure, unsure = set(), set()
        for step in re.split(r"^FAILED: ", log, flags=re.M)[1:]:
            sure_here, unsure_here = set(), set()
            for match in MESSAGE.finditer(step):
                if match.group(1) not in self.marks or match.group(4) == "note" and sure_here:
                    continue
                numbers, inside = self.blamed(match.group(1), int(match.group(2)),
                                              int(match.group(3)))
                (sure_here if inside else unsure_here).update(numbers)
            if not sure_here and not unsure_here:
                first = step.split("\n")[0]
                print(f"no defect found for: {first}", file=sys.stderr)
            sure |= sure_here
            unsure |= unsure_here
        changed = sure or unsure
        for defect in self.defects():
            if defect.number in changed:
                defect.chosen += 1
                if defect.chosen >= MOST_FORMS:
                    defect.chosen = len(defect.choices)
        return changed

    def remember(self):
        for defect in self.defects():
            self.known[defect.key][1] = defect.chosen
        self.memory.write_text(json.dumps(self.known))


def main():
    folder, targets = Path(sys.argv[1]).resolve(), sys.argv[2:]
    jobs = int(os.environ.get("JOBS") or os.cpu_count())
    together = Together(folder)
    originals = folder / "unchanged"
    together.read(sys.stdin.read().split("\n"))
    together.sources.setdefault(SWITCH_FILE, Source((together.src / SWITCH_FILE).read_text()))
    header = folder / "defects.h"
    if not header.exists() or header.read_text() != SWITCH_HEADER:
        header.write_text(SWITCH_HEADER)
    for file in together.sources:
        (originals / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(together.src / file, originals / file)
    try:
        for round_ in range(MAX_ROUNDS):
            together.write()
            done, log = together.compile(targets, jobs)
            if done:
                break
            changed = together.next_choices(log)
            print(f"compilation {round_ + 1}: {len(changed)} defects get another form",
                  file=sys.stderr, flush=True)
            together.remember()
            if not changed:
                sys.exit("the build fails, and no defect is near the messages: see build.log")
        else:
            sys.exit("the build still fails: see build.log")
        together.remember()
    finally:
        together.take_out(originals)
    with open(folder / "flags", "w") as out:
        for defect in together.defects():
            if defect.choice():
                print(together.numbers[defect.number], defect.number, file=out)


main()
