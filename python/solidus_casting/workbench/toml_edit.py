"""Changes single keys and sections of a TOML text and keeps the rest, comments included, as it is.

Each change is verified: the new text has to parse to the old document with that one change, else nothing is changed.
"""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import InputError
from ..toml_text import key_text, value_text

Path = tuple[Any, ...]  # keys, and numbers of the entries of lists of sections

_MOST_LINES = 2000  # of one value


@dataclass(frozen=True)
class Statement:
    """A header or an assignment: the lines ``first`` to ``last`` (from zero, ``last`` excluded) and the path that it is about."""

    path: Path
    first: int
    last: int
    is_header: bool


def parsed(text: str) -> dict[str, Any]:
    """The document of a text. Raises :class:`InputError` with the line."""
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(f"this is no TOML: {error}", "a case file: key = value, [section], [[list of sections]]") from error


def statements(text: str) -> list[Statement]:
    """Headers and assignments in the order of the text, which has to parse."""
    lines = text.split("\n")
    found: list[Statement] = []
    table: Path = ()
    counts: dict[Path, int] = {}
    number = 0
    while number < len(lines):
        line = lines[number].strip()
        if not line or line.startswith("#"):
            number += 1
        elif line.startswith("["):
            table = _header_path(line, counts)
            found.append(Statement(table, number, number + 1, True))
            number += 1
        else:
            last = _end_of_value(lines, number)
            found.append(Statement(table + _key_path(lines[number]), number, last, False))
            number = last
    return found


def _header_path(line: str, counts: dict[Path, int]) -> Path:
    """The path of a header; an entry of a list of sections has its number in it."""
    is_list = line.startswith("[[")
    names = _chain(tomllib.loads(line))
    path: Path = ()
    for position, name in enumerate(names):
        path += (name,)
        if position == len(names) - 1:
            if is_list:
                counts[path] = counts.get(path, -1) + 1
                path += (counts[path],)
        elif path in counts:
            path += (counts[path],)
    return path


def _chain(document: Any) -> list[str]:
    """The keys on the way to the innermost section of a document that has one key at each level."""
    names = []
    while document:
        document = document[0] if isinstance(document, list) else document
        if not isinstance(document, dict) or not document:
            break
        name, document = next(iter(document.items()))
        names.append(name)
    return names


def _key_path(line: str) -> Path:
    """The keys before the equals sign, which are several where they are dotted."""
    for end in _places_of(line, "="):
        try:
            return tuple(_chain(tomllib.loads(line[:end] + "= 0")))
        except tomllib.TOMLDecodeError:
            continue
    raise InputError(f"no key in '{line.strip()}'")


def _places_of(line: str, sign: str) -> Iterator[int]:
    place = line.find(sign)
    while place >= 0:
        yield place
        place = line.find(sign, place + 1)


def _end_of_value(lines: list[str], first: int) -> int:
    """The line behind a value, which may take several lines: as soon as what was read parses, it is complete."""
    for last in range(first + 1, min(len(lines), first + _MOST_LINES) + 1):
        try:
            tomllib.loads("\n".join(lines[first:last]))
            return last
        except tomllib.TOMLDecodeError:
            continue
    raise InputError(f"the value in line {first + 1} does not end")


def section_at(text: str, line: int) -> Path:
    """The path of the statement in a line (from one), or of the section in which the line is."""
    path: Path = ()
    for statement in statements(text):
        if statement.first >= line:
            break
        path = statement.path
    return path


def with_value(text: str, path: Sequence[Any], value: Any) -> str:
    """The text with a key set: replaced where it is, else added to its section. Raises :class:`InputError`."""
    wanted = tuple(path)
    expected = parsed(text)
    _assign(expected, wanted, value)
    lines = text.split("\n")
    all_statements = statements(text)
    for statement in all_statements:
        if not statement.is_header and wanted[:len(statement.path)] == statement.path:
            inner = _value_at(expected, statement.path)  # of an inline table the whole
            lines[statement.first:statement.last] = [_assignment(lines, statement, inner)]
            return _verified("\n".join(lines), expected)
    line = f"{key_text(str(wanted[-1]))} = {value_text(value)}"
    return _verified("\n".join(_with_line(lines, all_statements, wanted[:-1], line)), expected)


def _assignment(lines: list[str], statement: Statement, value: Any) -> str:
    """The line of an assignment with another value; a comment behind a value of one line stays."""
    line = lines[statement.first]
    end = next(place for place in _places_of(line, "=") if _is_key(line[:place]))
    comment = ""
    if statement.last == statement.first + 1:
        for place in _places_of(line, "#"):
            try:
                tomllib.loads(line[:place])
            except tomllib.TOMLDecodeError:
                continue
            comment = line[len(line[:place].rstrip()):]
            break
    return f"{line[:end].rstrip()} = {value_text(value)}{comment}"


def _is_key(text: str) -> bool:
    try:
        tomllib.loads(text + "= 0")
        return True
    except tomllib.TOMLDecodeError:
        return False


def _with_line(lines: list[str], all_statements: list[Statement], section: Path, line: str) -> list[str]:
    """The lines with one more at the end of a section, which is added where there is none."""
    if not section:
        first = next((s.first for s in all_statements if s.is_header), len(lines))
        own = [s.last for s in all_statements if not s.is_header and s.last <= first]
        place = own[-1] if own else 0
        return lines[:place] + [line] + lines[place:]
    place = None
    for number, statement in enumerate(all_statements):
        if statement.is_header and statement.path == section:
            place = statement.last
            for later in all_statements[number + 1:]:
                if later.is_header:
                    break
                place = later.last
            break
    if place is None:
        if any(isinstance(name, int) for name in section[-1:]):
            raise InputError(f"there is no section {dotted(section)}", "one that is in the file")
        header = ".".join(key_text(name) for name in section if not isinstance(name, int))
        return _trimmed(lines) + ["", f"[{header}]", line, ""]
    return lines[:place] + [line] + lines[place:]


def with_section(text: str, path: Sequence[str], values: Mapping[str, Any], comment: str = "") -> str:
    """The text with one more entry of a list of sections, behind its last entry or at the end."""
    wanted = tuple(path)
    expected = parsed(text)
    place: Any = expected
    for name in wanted[:-1]:
        place = place.setdefault(name, {})
        place = place[-1] if isinstance(place, list) else place
    entries = place.setdefault(wanted[-1], [])
    if not isinstance(entries, list):
        raise InputError(f"{dotted(wanted)} is no list of sections")
    entries.append(dict(values))
    lines = text.split("\n")
    header = "[[" + ".".join(map(key_text, wanted)) + "]]"
    added = [header + (f"   # {comment}" if comment else "")] + [f"{key_text(k)} = {value_text(v)}" for k, v in values.items()]
    names = [tuple(n for n in s.path if not isinstance(n, int)) for s in statements(text)]
    behind = [s.last for s, name in zip(statements(text), names) if name[:len(wanted)] == wanted]
    if behind:
        lines[behind[-1]:behind[-1]] = ["", *added]
    else:
        lines = _trimmed(lines) + ["", *added, ""]
    return _verified("\n".join(lines), expected)


def without(text: str, path: Sequence[Any]) -> str:
    """The text without a key, a section with all below it, or an entry of a list of sections."""
    wanted = tuple(path)
    expected = parsed(text)
    _remove(expected, wanted)
    lines = text.split("\n")
    gone: set[int] = set()
    all_statements = statements(text)
    for number, statement in enumerate(all_statements):
        if statement.path[:len(wanted)] != wanted:
            continue
        gone.update(range(statement.first, statement.last))
        if statement.is_header:
            gone.update(_comments_above(lines, statement.first))
            end = all_statements[number + 1].first if number + 1 < len(all_statements) else len(lines)
            gone.update(n for n in range(statement.last, end) if not lines[n].strip() and n + 1 < end and not lines[n + 1].strip())
    return _verified("\n".join(line for number, line in enumerate(lines) if number not in gone), expected)


def without_all(text: str, paths: Any) -> str:
    """The text without several of these, one after the other. Raises :class:`InputError`, also where `paths` is no list of paths."""
    if not isinstance(paths, list) or not paths:
        raise InputError(f"{paths!r} is no list of paths", "what is to be taken away")
    for path in paths:
        text = without(text, path_of(path))
    return text


def _comments_above(lines: list[str], header: int) -> Iterator[int]:
    """Comments that are directly above a header belong to it, with an empty line above them."""
    number = header - 1
    while number >= 0 and lines[number].lstrip().startswith("#"):
        yield number
        number -= 1
    if number >= 0 and not lines[number].strip():
        yield number


def _trimmed(lines: list[str]) -> list[str]:
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    return lines


def path_of(given: Any) -> list[Any]:
    """A path of keys and numbers as a request gives it. Raises :class:`InputError`."""
    if not isinstance(given, list) or not given or not all(isinstance(name, (str, int)) and not isinstance(name, bool) for name in given):
        raise InputError(f"{given!r} is no path of keys")
    return given


def dotted(path: Sequence[Any]) -> str:
    """A path as one reads it: ``mesh.riser.2.diameter``, entries counted from one."""
    return ".".join(str(name + 1) if isinstance(name, int) else str(name) for name in path)


def _value_at(document: Any, path: Path) -> Any:
    for name in path:
        document = document[name]
    return document


def _assign(document: Any, path: Path, value: Any) -> None:
    try:
        for name, following in zip(path[:-1], path[1:]):
            if isinstance(document, dict) and name not in document and isinstance(following, str):
                document[name] = {}
            document = document[name]
        if not isinstance(document, dict) or not isinstance(path[-1], str):
            raise KeyError(path[-1])
        document[path[-1]] = copy.deepcopy(value)
    except (KeyError, IndexError, TypeError) as error:
        raise InputError(f"there is no place for {dotted(path)} in the file", "a key of a section that is there") from error


def _remove(document: Any, path: Path) -> None:
    try:
        parents = []
        for name in path[:-1]:
            parents.append((document, name))
            document = document[name]
        del document[path[-1]]
        # A list of sections without entries is not there, and neither is a section that headers below it alone had made.
        if isinstance(document, list) and not document:
            parent, name = parents[-1]
            del parent[name]
    except (KeyError, IndexError, TypeError) as error:
        raise InputError(f"there is no {dotted(path)} in the file", "one that is there") from error


def _verified(text: str, expected: dict[str, Any]) -> str:
    """The text, if it parses to the document that was wanted; headers that are gone may have made empty sections."""
    if _without_empty(parsed(text)) != _without_empty(expected):
        raise InputError("this cannot be changed here without a change of other keys", "the text of the case file, in which it can")
    return text


def _without_empty(document: Any) -> Any:
    if isinstance(document, dict):
        inner = {name: _without_empty(value) for name, value in document.items()}
        return {name: value for name, value in inner.items() if value != {}}
    if isinstance(document, list):
        return [_without_empty(value) for value in document]
    return document
