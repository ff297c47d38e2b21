"""Cases that were handed to the program in a file of their own, for messages that name its lines.

A simulation gives such messages when the file has gone.
"""

from __future__ import annotations

import itertools
import re
from pathlib import Path

_written: dict[str, str] = {}
_MOST_WRITTEN = 16


def remember(file: Path, text: str) -> None:
    """Keeps the text of a case file; of many the oldest is forgotten."""
    _written[str(file)] = text
    while len(_written) > _MOST_WRITTEN:
        _written.pop(next(iter(_written)))


def with_keys(message: str) -> str:
    """A message that names keys of the case, where the program named lines of a file that the user never saw."""
    def key(match: re.Match[str]) -> str:
        text = _written.get(match[1])
        return (key_at(text, int(match[2])) or "the case") if text else match[0]

    return re.sub(r"(/\S*?/solidus_case_\w+/case\.toml):(\d+)(?::\d+)?", key, message)


def key_at(text: str, line: int) -> str | None:
    """The path of the key that is on a line of a written case."""
    lines = text.splitlines()
    section: list[str] = []
    counts: dict[str, int] = {}
    key = ""
    for number, content in enumerate(lines, 1):
        if content.startswith("["):
            header, key = content.strip("[]"), ""
            section = [header]
            if content.startswith("[["):
                counts[header] = counts.get(header, 0) + 1
                own = itertools.takewhile(lambda below: not below.startswith("["), lines[number:])
                names = [below.partition(" = ")[2].strip('"') for below in own if below.startswith("name = ")]
                section.append(names[0] if names else str(counts[header]))
        else:
            key = content.partition(" = ")[0]
        if number == line:
            return ".".join([*section, key] if key else section) or None
    return None
