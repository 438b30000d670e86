#!/usr/bin/env python3
"""Draws defects at random: draw.py SEED COUNT [FOLDER ...] >TABLE

Picks lines of the sources at random and changes an operator, a number, a name or a condition of
each, or drops a statement. It prints a table in the form of defects.txt, without tests. Lines of
the other tables are left out, and so are headers: nearly every file includes them, so each form
that does not compile would cost a whole build. Some defects that it draws change nothing that anybody can see; who
looks at the survivors must say which.
"""
import random
import re
import sys
from pathlib import Path

from rewrite import CONTROL, Source

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
FOLDERS = ["core", "integrators", "accelerators", "shapes", "lights", "materials", "samplers"]
OPERATORS = {
    "<": ["<=", ">"], ">": [">=", "<"], "<=": ["<", ">="], ">=": [">", "<="], "==": ["!="],
    "!=": ["=="], "&&": ["||"], "||": ["&&"], "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"],
    "+=": ["-=", "="], "-=": ["+="], "*=": ["/=", "="], "/=": ["*="], "%": ["/"],
}
NAMES = {
    "x": "y", "y": "x", "z": "y", "min": "max", "max": "min", "sin": "cos", "cos": "sin",
    "true": "false", "false": "true", "first": "second", "second": "first", "u": "v", "v": "u",
    "ng": "n", "dpdu": "dpdv", "dpdv": "dpdu", "dndu": "dndv", "dndv": "dndu", "width": "height",
    "height": "width", "Width": "Height", "Height": "Width", "pMin": "pMax", "pMax": "pMin",
    "x0": "x1", "x1": "x0", "y0": "y1", "y1": "y0", "wi": "wo", "wo": "wi", "continue": "break",
    "begin": "end", "front": "back", "back": "front", "Min": "Max", "Max": "Min",
    "floor": "ceil", "ceil": "floor", "AbsDot": "Dot", "Dot": "AbsDot", "sqrt": "abs",
    "tMin": "tMax", "tMax": "tMin", "columns": "rows", "rows": "columns", "u0": "u1", "u1": "u0",
}
NUMBER = re.compile(r"\d+(\.\d*)?|\.\d+")
OPERAND_END = re.compile(r"[\w)\]]$")


def other_number(word):
    """A number near the given one, or twice as large."""
    value = float(word)
    if "." not in word:
        return str(int(value) + 1)
    return ("%g" % (2 * value if value else 1)) + ("." if (2 * value or 1) % 1 == 0 else "")


class Lines:
    """The defects that a source offers, by line."""

    def __init__(self, path):
        self.source = Source(path.read_text())
        self.text = self.source.text
        self.starts = [0] + [m.end() for m in re.finditer("\n", self.text)]
        self.by_line = {}
        for i in range(len(self.source.word)):
            if self.in_function(i):
                self.offer(i)
                self.offer_without_statement(i)

    def in_function(self, i):
        bracket = self.source.parent[i]
        while bracket >= 0:
            if self.source.is_block(bracket):
                return True
            bracket = self.source.parent[bracket]
        return False

    def line_of(self, at):
        return self.text.count("\n", 0, at)

    def add(self, start, end, instead):
        line = self.line_of(start)
        if line == self.line_of(end):
            self.by_line.setdefault(line, []).append((start, end, instead))

    def offer(self, i):
        s = self.source
        word, start, end = s.word[i], s.start[i], s.end[i]
        before, after = self.text[start - 1], self.text[end:end + 1]
        if word in OPERATORS and before == " " and after in " \n" and OPERAND_END.search(s.word[i - 1]):
            for other in OPERATORS[word]:
                self.add(start, end, other)
        elif word == "!" and after not in " =":
            self.add(start, end, "!!")  # without "!" the two forms may have different types
        elif NUMBER.fullmatch(word):
            self.add(start, end, other_number(word))
        elif word in NAMES and s.word[i - 1] != "#":
            self.add(start, end, NAMES[word])

    def offer_without_statement(self, i):
        s = self.source
        if s.word[i - 1] not in (";", "{", "}") or not s.is_block(s.parent[i]):
            return
        last = s.statement_end(i)
        if s.word[i] in CONTROL or s.word[i] in ("return", "case", "default", "using", "{"):
            return
        if s.word[last] == ";" and not s.is_declaration(i, last):
            is_call_or_assignment = any(w in ("(", "=", "++") or w in OPERATORS
                                        for w in s.word[i:last])
            if is_call_or_assignment and re.match(r"[\w:.\->\[\]*+]+\s*([(=+*/-]|\+\+)",
                                                  self.text[s.start[i]:s.end[last]]):
                self.add(s.start[i], s.end[last], ";")


def lines_of_tables():
    """(file, line) of the defects that there are."""
    known = set()
    for table in [*HERE.glob("*.txt"), *HERE.glob("*.list")]:
        file = None
        for line in table.read_text().split("\n"):
            if line.startswith("- "):
                path = TOP / file
                text = path.read_text() if path.exists() else ""
                at = text.find(line[2:])
                if at >= 0:
                    known.add((file, text.count("\n", 0, at)))
            elif line and line[0] not in "+!#":
                file = line.split()[-1]
    return known


def main():
    seed, count = int(sys.argv[1]), int(sys.argv[2])
    draw = random.Random(seed)
    known = lines_of_tables()
    places = []
    for folder in sys.argv[3:] or FOLDERS:
        for path in sorted((TOP / folder).rglob("*")):
            if path.suffix not in (".cpp", ".inl"):
                continue
            file = str(path.relative_to(TOP))
            lines = Lines(path)
            places += [(file, line, lines) for line in sorted(lines.by_line)
                       if (file, line) not in known]
    draw.shuffle(places)
    print(f"# {count} defects that draw.py drew with seed {seed}.\n")
    number = 0
    for file, line, lines in places:
        if number == count:
            break
        start = lines.starts[line]
        whole = lines.text[start:].split("\n")[0]
        text = whole.strip()
        if lines.text.find(text) != start + whole.find(text):
            continue
        a, b, instead = draw.choice(lines.by_line[line])
        offset = a - start - whole.find(text)
        changed = text[:offset] + instead + text[offset + b - a:]
        number += 1
        print(f"drawn-{seed}-{number} {file}\n- {text}\n+ {changed}\n! line {line + 1}\n")


main()
