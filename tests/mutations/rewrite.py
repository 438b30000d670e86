"""Rewrites a C++ source so that it holds several defects, each switched on by a flag at run time.

A defect replaces a text of one line by another. It becomes a choice between both: of a statement,
`if (exphoton_defects[7]) { changed } else { original }`, or of an expression, `(exphoton_defects[7]
? (changed) : (original))`. These are mutant schemata (Untch, Offutt and Harrold 1993).

The parser below knows brackets and statements, but no types. It therefore offers several choices
for each defect, small ones first, and the compiler decides which is C++ (together.py).
"""
import re
from dataclasses import dataclass, field

TOKEN = re.compile(r"""
    (?P<skip> \s+ | //[^\n]* | /\*.*?\*/ | ^[ \t]*\#(?:[^\n\\]|\\.)* )
  | (?P<raw> R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)" )
  | "(?:[^"\\\n]|\\.)*" | (?<![0-9a-fA-F])'(?:[^'\\\n]|\\.)*'
  | \.?\d(?:[\w.']|(?<=[eE])[+-])* | \w+
  | <=> | [-+*/%&|^=!<>]= | && | \|\| | << | -> | :: | \+\+ | -- | .
""", re.VERBOSE | re.DOTALL | re.MULTILINE)
CLOSING = {"(": ")", "[": "]", "{": "}"}
CONTROL = {"if", "for", "while", "switch", "do", "try", "else"}
BEFORE_BLOCK = {")", "else", "do", "try", "const", "noexcept", "override", "mutable", "]", "}"}
DECLARATION = re.compile(r"(?:const|constexpr|static|auto|using|struct|unsigned|alignas)\b"
                         r"|(?!return\b|throw\b|delete\b|new\b|goto\b|case\b)"
                         r"(?:[\w:]+)(?:<[^;=()]*>)?(?:::\w+)?\s*[&*]*\s+[&*]*\w+\s*[=({;,\[]")


@dataclass
class Choice:
    """One way to compile a defect in: the span of the source that exists twice."""
    start: int
    end: int
    kind: str  # "statement" or "expression"
    edits: tuple = ()  # (start, end, text): words that must change as well, such as constexpr


@dataclass
class Defect:
    number: int
    name: str
    start: int = 0  # of the characters that change
    end: int = 0
    instead: str = ""
    choices: list = field(default_factory=list)
    chosen: int = 0

    def choice(self):
        return self.choices[self.chosen] if self.chosen < len(self.choices) else None


class Source:
    """The tokens of a file, its pairs of brackets, and its defects."""

    def __init__(self, text):
        self.text = text
        self.defects = []
        self.start, self.end, self.word = [], [], []
        for token in TOKEN.finditer(text):
            if token.group("skip") is None:
                self.start.append(token.start())
                self.end.append(token.end())
                self.word.append(token.group())
        count = len(self.word)
        self.match = [None] * count   # of a bracket: the other one
        self.parent = [-1] * count    # the bracket that encloses the token
        open_ = []
        for i, word in enumerate(self.word):
            if word in (")", "]", "}") and open_:
                self.match[i] = open_.pop()
                self.match[self.match[i]] = i
            self.parent[i] = open_[-1] if open_ else -1
            if word in CLOSING:
                open_.append(i)

    def add(self, number, name, text, instead):
        """Adds a defect; one that cannot be compiled in has no choices."""
        defect = Defect(number, name)
        self.defects.append(defect)
        at = self.text.find(text)
        if at < 0:
            return defect
        before = 0
        while before < min(len(text), len(instead)) and text[before] == instead[before]:
            before += 1
        after = 0
        while (after < min(len(text), len(instead)) - before and
               text[-1 - after] == instead[-1 - after]):
            after += 1
        defect.start, defect.end = at + before, at + len(text) - after
        defect.instead = instead[before:len(instead) - after]
        tokens = self.tokens_of(defect.start, defect.end)
        if tokens:
            seen = set()
            for first, last, kind in self.spans(*tokens):
                if first > last or (first, last, kind) in seen:
                    continue
                if kind == "expression" and self.has_separator(first, last):
                    continue  # (a, b) would be an operator
                seen.add((first, last, kind))
                start, end = self.start[first], self.end[last]
                if start <= defect.start and defect.end <= end:
                    defect.choices.append(Choice(start, end, kind, self.constant_edits(first)))
        return defect

    def tokens_of(self, start, end):
        """The tokens that the characters touch, widened until their brackets are in pairs."""
        touched = [i for i in range(len(self.word))
                   if self.start[i] <= end and self.end[i] >= start and
                   (start == end or (self.start[i] < end and self.end[i] > start))]
        if not touched:
            return None
        if start == end:  # an insertion between two tokens belongs to the first
            touched = touched[:1]
        first, last = touched[0], touched[-1]
        wider = True
        while wider:
            wider = False
            for i in range(first, last + 1):
                other = self.match[i]
                if other is not None and not first <= other <= last:
                    first, last, wider = min(first, other), max(last, other), True
        return first, last

    def spans(self, first, last):
        """Yields (first token, last token, kind), the best choice first."""
        while True:
            bracket = self.parent[first]
            if bracket >= 0 and self.is_block(bracket):
                statements = self.statements_around(bracket, first, last)
                for s, e in reversed(statements):
                    if self.word[s] in CONTROL or not self.is_declaration(s, e):
                        yield s, e, "statement"
                    if self.word[s] not in CONTROL:
                        yield *self.piece(first, last), "expression"
                yield bracket + 1, self.match[bracket] - 1, "statement"
            else:
                statement = self.statement_of(first, last)
                if statement:
                    yield *statement, "statement"
                yield *self.piece(first, last), "expression"
            if bracket < 0 or self.is_scope(bracket):
                return
            first, last = bracket, self.match[bracket]

    def is_scope(self, bracket):
        """Whether the bracket opens a namespace or a class."""
        i = bracket - 1
        while i >= 0 and self.word[i] not in (";", "{", "}", ")", "="):
            if self.word[i] in ("namespace", "class", "struct", "enum", "union"):
                return True
            i -= 1
        return False

    def statement_of(self, first, last):
        """The innermost statement that is no control statement and no declaration, if that exists."""
        bracket = self.parent[first]
        while bracket >= 0 and not self.is_block(bracket):
            first, last, bracket = bracket, self.match[bracket], self.parent[bracket]
        statements = self.statements_around(bracket, first, last) if bracket >= 0 else []
        if not statements:
            return None
        s, e = statements[-1]
        is_plain = self.word[s] not in CONTROL and not self.is_declaration(s, e)
        return (s, e) if is_plain else None

    def is_block(self, bracket):
        if self.word[bracket] != "{" or bracket == 0:
            return False
        before = self.word[bracket - 1]
        if before in ("{", ";", ":"):
            return self.parent[bracket] >= 0 and self.is_block(self.parent[bracket])
        if before in BEFORE_BLOCK:
            return True
        i = bracket - 1  # a trailing return type: ) -> Type {
        while i > 0 and self.word[i] not in (";", "{", "}", ")", "="):
            if self.word[i] == "->":
                return True
            i -= 1
        return False

    def statements_around(self, bracket, first, last):
        """The statements of a block that hold these tokens, the outermost first."""
        i, close = bracket + 1, self.match[bracket]
        while i < close:
            end = self.statement_end(i)
            if i <= first and last <= end:
                return self.nested(i, end, first, last)
            if end >= first:
                return []
            i = end + 1
        return []

    def nested(self, i, end, first, last):
        start = self.after_labels(i)
        if start > first:
            return []
        found = [(start, end)]
        for s in self.parts(start):
            e = self.statement_end(s)
            if s <= first and last <= e and self.word[s] != "{":
                found += self.nested(s, e, first, last)
        return found

    def after_labels(self, i):
        while self.word[i] in ("case", "default"):
            while self.word[i] != ":":
                i += 1
            i += 1
        return i

    def parts(self, i):
        """The first tokens of the statements that a control statement consists of."""
        if self.word[i] in ("if", "for", "while", "switch"):
            i += 2 if self.word[i + 1] in ("constexpr",) else 1
            body = self.match[i] + 1
            yield body
            end = self.statement_end(body)
            if end + 1 < len(self.word) and self.word[end + 1] == "else":
                yield end + 2
        elif self.word[i] in ("do", "else"):
            yield i + 1

    def statement_end(self, i):
        i = self.after_labels(i)
        word = self.word[i]
        if word == "{":
            return self.match[i]
        if word in ("if", "for", "while", "switch"):
            end = i
            for part in self.parts(i):
                end = self.statement_end(part)
            return end
        if word in ("do", "try"):
            i = self.statement_end(i + 1) + 1
            while word == "try" and self.word[i] == "catch":
                i = self.match[self.match[i + 1] + 1] + 1
            if word == "try":
                return i - 1
        while i < len(self.word) and self.word[i] != ";":
            if self.word[i] in CLOSING and self.match[i] is not None:
                i = self.match[i]
            elif self.word[i] in (")", "]", "}"):
                return i - 1
            i += 1
        return min(i, len(self.word) - 1)

    def is_declaration(self, first, last):
        return bool(DECLARATION.match(self.text, self.start[first], self.end[last]))

    def piece(self, first, last):
        """The tokens between the nearest separators on this level of brackets."""
        separators = (",", ";", "=", "return", "{", "(", "[", "?", ":") if self.in_initializers(first) \
            else (",", ";", "=", "return", "{", "(", "[")
        s = first
        while s > 0 and self.word[s - 1] not in separators:
            s = self.match[s - 1] if self.word[s - 1] in (")", "]", "}") and \
                self.match[s - 1] is not None else s - 1
        e = last
        while e + 1 < len(self.word) and self.word[e + 1] not in (",", ";", ")", "]", "}", "="):
            e = self.match[e + 1] if self.word[e + 1] in CLOSING else e + 1
        return s, e

    def has_separator(self, first, last):
        level = self.parent[first]
        return any(self.word[i] in (",", ";", "=") and self.parent[i] == level
                   for i in range(first, last + 1))

    def in_initializers(self, first):
        """Whether the token is after the colon of a range-based for."""
        bracket = self.parent[first]
        return bracket > 0 and self.word[bracket] == "(" and self.word[bracket - 1] == "for"

    def constant_edits(self, first):
        """Words constexpr of the declarations around a token: a flag is no constant."""
        edits = []
        i = first
        while i >= 0:
            is_function, before = False, i - 1
            while before >= 0 and self.word[before] not in (";", "{", "}", "public", "private"):
                if self.word[before] in (")", "]") and self.match[before] is not None:
                    is_function = is_function or self.word[before] == ")"
                    before = self.match[before]
                if self.word[before] == "constexpr" and self.word[before - 1] != "if":
                    is_function = is_function or self.word[i] == "{" and self.word[i - 1] != "="
                    other = "const"
                    if is_function and "=" not in self.word[before:i]:
                        other = "" if "inline" in self.word[max(before - 3, 0):before] else "inline"
                    elif self.word[before + 1] == "const":
                        other = ""
                    elif self.word[before - 1] == "static" and not self.is_block(
                            max(self.parent[before], 0)):
                        other = "inline const"
                    edits.append((self.start[before], self.end[before], other))
                before -= 1
            i = self.parent[i]
        return tuple(dict.fromkeys(edits))

    def drop_conflicts(self):
        """Spans lie in each other or apart. Gives a defect its next choice where they overlap."""
        taken = []
        for defect in self.defects:
            while defect.choice() and any(overlap(defect.choice(), c) for c in taken):
                defect.chosen += 1
            if defect.choice():
                taken.append(defect.choice())

    def rewritten(self):
        """The text with all defects; and (number, start, end, start, end) of spans and changes."""
        self.drop_conflicts()
        edits = {e for d in self.defects if d.choice() for e in d.choice().edits}
        groups = {}
        for defect in self.defects:
            choice = defect.choice()
            if choice:
                groups.setdefault((choice.start, -choice.end, choice.kind != "statement"),
                                  []).append(defect)
        order = sorted(groups)
        text, self.marks = [], []
        self.length = 0

        def put(part):
            text.append(part)
            self.length += len(part)

        def original(start, end):
            for a, b, other in sorted(e for e in edits if start <= e[0] and e[1] <= end):
                put(self.text[start:a] + other)
                start = b
            put(self.text[start:end])

        def span(start, end, inner):
            while inner:
                key = inner.pop(0)
                original(start, key[0])
                within = [k for k in inner if -k[1] <= -key[1]]
                inner = inner[len(within):]
                group(key, within)
                start = -key[1]
            original(start, end)

        def group(key, within):
            start, end, is_expression = key[0], -key[1], key[2]
            opening = self.length
            put("(" if is_expression else "{ ")
            changes = []
            for defect in groups[key]:
                flag = f"exphoton_defects[{defect.number}]"
                put(f"{flag} ? (" if is_expression else f"if ({flag}) {{ ")
                from_ = self.length
                original(start, defect.start)
                put(defect.instead)
                original(defect.end, end)
                changes.append((from_, self.length))
                put("\n) : " if is_expression else "\n} else ")
            put("(" if is_expression else "{ ")
            span(start, end, within)
            put("\n))" if is_expression else "\n} }")
            for defect, change in zip(groups[key], changes):
                self.marks.append((defect.number, opening, self.length, *change))

        span(0, len(self.text), order)
        return "".join(text), self.marks


def overlap(a, b):
    """Whether two spans cross each other."""
    return (a.start < b.start < a.end < b.end) or (b.start < a.start < b.end < a.end)
