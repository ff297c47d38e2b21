"""Messages of the program as findings: what is wrong, in which line, and where in the picture."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from ..errors import InputError
from .toml_edit import Path, dotted, section_at

_NUMBER = r"[-+]?[\d.]+(?:e[-+]?\d+)?"
_PLACE = re.compile(rf"\(({_NUMBER}), ({_NUMBER}), ({_NUMBER})\) (mm|m|cm)\b")
_METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
_LONGEST = 4000  # of a message, in characters


def grouped(lines: Iterable[str], marks: Mapping[str, str]) -> list[tuple[str, str]]:
    """Messages with their severity: each begins with a mark, and lines that are indented go on with it."""
    found: list[tuple[str, str]] = []
    is_open = False
    for line in lines:
        mark = next((mark for mark in marks if line.startswith(mark)), None)
        if mark is not None:
            found.append((marks[mark], line.removeprefix(mark).strip()))
            is_open = True
        elif is_open and line.startswith("  "):
            severity, text = found[-1]
            found[-1] = (severity, f"{text}\n{line.strip()}"[:_LONGEST])
        else:
            is_open = False
    return found


def finding(severity: str, message: str, text: str, document: Mapping[str, Any]) -> dict[str, Any]:
    """A message with the line of the case file, the section there, and the places and bodies that it names.

    Parameters
    ----------
    text, document:
        The case file and what it says, for lines and names of bodies.
    """
    error = InputError.from_text(message)
    has_line = error.file is not None and error.line is not None
    shown = f"{error.found}\n{error.allowed}".strip() if has_line else message
    found: dict[str, Any] = {"severity": severity, "message": shown, "places": places(message)}
    section: Path = ()
    if has_line and error.file.name == "case.toml":
        found["line"] = error.line
        section = _section(text, error.line)
        found["section"] = dotted(section)
    found["bodies"] = bodies(message, section, document)
    return found


def measured(said: str) -> list[dict[str, Any]]:
    """The thickest places of a part, as ``solidus new`` has told them when it made the case."""
    return [finding("note", line.split(maxsplit=2)[2], "", {}) for line in said.splitlines() if line.split()[:2] == ["hot", "spot"]]


def _section(text: str, line: int) -> Path:
    try:
        return section_at(text, line)
    except (InputError, ValueError):  # a file that does not parse has no sections
        return ()


def places(message: str) -> list[list[float]]:
    """The places that a message names [m]."""
    return [[float(match[axis]) * _METRES[match[4]] for axis in (1, 2, 3)] for match in _PLACE.finditer(message)]


def bodies(message: str, section: Path, document: Mapping[str, Any]) -> list[str]:
    """The bodies that a message is about: those that it names, and that of the section it points to."""
    known = [body for body in document.get("body", []) if isinstance(body, Mapping) and isinstance(body.get("name"), str)]
    words = set(re.findall(r"[\w.-]+", message))
    found = [body["name"] for body in known if body["name"] in words or body.get("group", body["name"]) in words]
    if section[:1] == ("body",) and len(section) > 1 and section[1] < len(document.get("body", [])):
        name = document["body"][section[1]].get("name")
        if isinstance(name, str) and name not in found:
            found.append(name)
    return found
