"""What the sources are like, in figures: rooms with their units and floors, comments, long functions, large classes.

``./dev house`` prints them. A room is a folder of ``src``, and each folder within it counts by itself, a unit is a header with
its source, or either alone. The floors of a folder are the units on the longest chain of includes within it. Comments are counted in sources (.cpp)
as lines that hold nothing else; a function of TOLD lines and more tells its steps by a comment directly above its head or
within its body. A class that is larger for a reason is listed with it in ``large_classes.toml`` next to this file.
Sizes are read by a scanner of braces, not by a compiler: macros and preprocessor branches are text like any
other.
"""

from __future__ import annotations

import argparse
import re
import sys
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

LONG_FUNCTION = 60  #: lines, from the name to the closing brace
TOLD = 30  #: lines of a function from which on a comment has to tell its steps
METHODS, MEMBERS = 12, 15  #: of a class: public methods and data members beyond which it is large

LARGE_FOR_A_REASON = Path(__file__).with_name("large_classes.toml")  #: classes beyond the bounds that stay so, with why

_BLANKED = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
_TYPE = re.compile(r"\b(?<!enum )(class|struct|union)\s+(?:\[\[[^\]]*\]\]\s*)?(\w+)(?:<[^{;]*>)?\s*(?:final\s*)?(?::[^:][^{;]*)?$", re.S)
_NAME = re.compile(r"(~?\w+|operator\s*\S+)\s*\($")


@dataclass
class Function:
    name: str
    file: str
    line: int
    lines: int
    comments: int = 0  #: lines of comment directly above its head and in its body


@dataclass
class Class:
    name: str
    file: str
    line: int
    plain: bool = False  #: a struct: its members are data that belong together
    methods: int = 0  #: public
    members: int = 0

    @property
    def large(self) -> bool:
        return self.methods > METHODS or (self.members > MEMBERS and not self.plain)


@dataclass
class Room:
    units: int = 0
    files: int = 0
    floors: int = 0
    lines: int = 0  #: of its sources (.cpp)
    comments: int = 0  #: of these, lines that are comments


@dataclass
class House:
    rooms: dict[str, Room] = field(default_factory=dict)
    functions: list[Function] = field(default_factory=list)
    classes: list[Class] = field(default_factory=list)


def reasons() -> dict[str, str]:
    """Of the classes that are large for a reason, by file below src and name."""
    return {name: kind["reason"] for kind in tomllib.loads(LARGE_FOR_A_REASON.read_text(encoding="utf-8")).values() for name in kind["classes"]}


def placed(one: Class) -> str:
    """A class as ``reasons`` names it."""
    return f"{one.file.removeprefix('src/')} {one.name}"


def blanked(text: str) -> str:
    """Comments and literals as blanks, lines as they were."""
    return _BLANKED.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), re.sub(r"^\s*#.*(?:\\\n.*)*$", "", text, flags=re.M))


def head_of(text: str, brace: int) -> tuple[str, int]:
    """What is written before a brace since the end of the statement before it, and where that begins."""
    depth = 0
    for i in range(brace - 1, -1, -1):
        c = text[i]
        if c in ")]":
            depth += 1
        elif c in "([":
            depth -= 1
        elif depth == 0 and c in ";{}":
            return text[i + 1 : brace], i + 1
    return text[:brace], 0


def function_name(head: str) -> str | None:
    """The name of the function whose body follows; None where it is no function's."""
    if re.search(r"(^|[^=!<>])=\s*$", head) or re.search(r"\b(if|for|while|switch|catch|do|else|try|return)\b[^;]*$", head):
        return None
    opening = head.find("(")
    if opening < 0:
        return None
    found = _NAME.search(head[: opening + 1])
    return found[1] if found else None


def scan(text: str, file: str) -> tuple[list[Function], list[Class]]:
    """The functions and classes of a file."""
    code = blanked(text)
    functions: list[Function] = []
    classes: list[Class] = []
    stack: list[tuple[str, int, object]] = []
    for i, c in enumerate(code):
        if c == "{":
            head, begin = head_of(code, i)
            line = code.count("\n", 0, begin + len(head) - len(head.lstrip())) + 1
            outer = stack[-1][0] if stack else "namespace"
            head = re.sub(r"\btemplate\s*<[^{;]*?>\s*(?=\w)", "", head).strip()
            kind: tuple[str, int, object] = ("block", i, None)
            if re.search(r"\bnamespace\b", head):
                kind = ("namespace", i, None)
            elif outer in ("namespace", "class") and (found := _TYPE.search(re.sub(r"^\s*(public|private|protected)\s*:", "", head))):
                one = Class(found[2], file, line, plain=found[1] != "class")
                classes.append(one)
                kind = ("class", i, one)
            elif outer in ("namespace", "class") and (name := function_name(head)):
                named = begin + code[begin:i].index("(", code[begin:i].index(name.split()[0]))
                kind = ("function", i, (name, code.count("\n", 0, named) + 1))
            stack.append(kind)
        elif c == "}" and stack:
            kind, begin, what = stack.pop()
            if kind == "function":
                name, line = what  # type: ignore[misc]
                functions.append(Function(name, file, line, code.count("\n", 0, i) + 2 - line))
            elif kind == "class":
                count(code[begin + 1 : i], what)  # type: ignore[arg-type]
    return functions, classes


def is_comment(line: str) -> bool:
    """Whether a line holds a comment and nothing else."""
    return line.lstrip().startswith("//")


def comments_of(function: Function, lines: list[str]) -> int:
    """Lines of comment of a function: those directly above its head, which may begin above its name, and those in its body."""
    first = function.line - 1
    while first > 0 and lines[first - 1].strip() and not lines[first - 1].rstrip().endswith((";", "}", "{", ":")) and not is_comment(lines[first - 1]):
        first -= 1  # the type that is returned, or a template's head
    above = first
    while above > 0 and is_comment(lines[above - 1]):
        above -= 1
    return sum(map(is_comment, lines[above : function.line - 1 + function.lines]))


def count(body: str, one: Class) -> None:
    """Counts public methods and members of a class, by what is at its own depth."""
    flat, depth = [], 0
    for c in body:
        if c == "{":
            depth += 1
        if depth == 0:
            flat.append(c)
        if c == "}":
            depth -= 1
            if depth == 0:
                flat.append("{};")
    public = True  # of a struct; a class begins with its access
    for statement in "".join(flat).split(";"):
        while found := re.match(r"\s*(public|private|protected)\s*:", statement):
            public = found[1] == "public"
            statement = statement[found.end() :]
        statement = re.sub(r"\[\[[^\]]*\]\]", "", statement).strip()
        if not statement or statement == "{}" or re.match(r"(using|friend|typedef|static_assert|enum|class|struct|template\s*<.*>\s*(class|struct))\b", statement):
            continue
        before = re.split(r"=|\{", statement, maxsplit=1)[0]
        if "(" in re.sub(r"<[^<>]*(<[^<>]*>[^<>]*)*>", "", before):
            one.methods += public
        elif not re.match(r"static\b", statement) and len(before.split()) > 1:
            one.members += 1 + before.count(",") - sum(part.count(",") for part in re.findall(r"<[^<>]*>", before))


def house(root: Path) -> House:
    """Reads the sources below ``root / "src"``."""
    found = House()
    source = root / "src"
    files = sorted(path for path in source.rglob("*") if path.suffix in (".cpp", ".hpp"))
    includes: dict[str, set[str]] = {}
    for path in files:
        name = path.relative_to(source).as_posix()
        text = path.read_text()
        unit = name.rsplit(".", 1)[0]
        includes.setdefault(unit, set()).update(match.rsplit(".", 1)[0] for match in _INCLUDE.findall(text))
        functions, classes = scan(text, "src/" + name)
        lines = text.splitlines()
        for function in functions:
            function.comments = comments_of(function, lines)
        found.functions += functions
        found.classes += classes
        room = found.rooms.setdefault(name.rpartition("/")[0] or ".", Room())
        room.files += 1
        if path.suffix == ".cpp":
            room.lines += len(lines)
            room.comments += sum(map(is_comment, lines))
    for room_name, room in found.rooms.items():
        units = {unit for unit in includes if (unit.rpartition("/")[0] or ".") == room_name}
        room.units = len(units)
        room.floors = max((height(unit, units, includes, {}) for unit in units), default=0)
    return found


def height(unit: str, units: set[str], includes: dict[str, set[str]], known: dict[str, int]) -> int:
    """How many units are on the longest chain of includes from a unit down."""
    if unit not in known:
        known[unit] = 0  # a unit that includes itself by way of others adds nothing
        known[unit] = 1 + max((height(other, units, includes, known) for other in includes[unit] & units if other != unit), default=0)
    return known[unit]


def share_of_comments(found: House) -> float:
    """Lines that are comments over all lines of the sources (.cpp)."""
    return sum(room.comments for room in found.rooms.values()) / max(sum(room.lines for room in found.rooms.values()), 1)


def untold(found: House) -> list[Function]:
    """Functions of TOLD lines and more without a comment, the longest first."""
    return sorted((f for f in found.functions if f.lines >= TOLD and not f.comments), key=lambda f: -f.lines)


def text_of(found: House) -> str:
    """The figures as lines."""
    lines = [f"{'room':20} {'files':>6} {'units':>6} {'floors':>7} {'comments':>9}"]
    for name, room in sorted(found.rooms.items()):
        lines.append(f"{name:20} {room.files:6} {room.units:6} {room.floors:7} {100 * room.comments / max(room.lines, 1):7.1f} %")
    lines.append(f"\nComments are {100 * share_of_comments(found):.1f} % of {sum(room.lines for room in found.rooms.values())} lines of sources.")
    silent = untold(found)
    lines.append(f"{sum(f.lines >= TOLD for f in found.functions)} functions have {TOLD} lines or more, {len(silent)} of them no comment:")
    lines += [f"  {f.lines:4}  {f.name:32} {f.file}:{f.line}" for f in silent]
    long = sorted((f for f in found.functions if f.lines > LONG_FUNCTION), key=lambda f: -f.lines)
    why = reasons()
    large = sorted((c for c in found.classes if c.large and placed(c) not in why), key=lambda c: -(c.methods + c.members))
    lengths = sorted(f.lines for f in found.functions)
    lines.append(f"\n{len(lengths)} functions, the median has {lengths[len(lengths) // 2]} lines, nine tenths at most "
                 f"{lengths[9 * len(lengths) // 10]}; {len(long)} have more than {LONG_FUNCTION}:")
    lines += [f"  {f.lines:4}  {f.name:32} {f.file}:{f.line}" for f in long]
    lines.append(f"\n{len(found.classes)} classes, {len(large)} with more than {METHODS} public methods or {MEMBERS} members:")
    lines += [f"  {c.methods:3} {c.members:3}  {c.name:32} {c.file}:{c.line}" for c in large]
    kept = sorted((c for c in found.classes if c.large and placed(c) in why), key=lambda c: (why[placed(c)], c.name))
    lines.append(f"\n{len(kept)} more are as large for a reason ({LARGE_FOR_A_REASON.name}):")
    lines += [f"  {c.methods:3} {c.members:3}  {c.name:32} {why[placed(c)]}" for c in kept]
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="./dev house", description="Figures of the sources: rooms, comments, long functions, large classes.")
    parser.add_argument("root", nargs="?", type=Path, default=Path(__file__).resolve().parents[2], help="of the sources; without it these")
    print(text_of(house(parser.parse_args(arguments).root)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
