"""The failures of Solidus as exceptions.

The program distinguishes three: what the user wrote cannot be used (exit code 1), the physics of a run cannot go on (2),
and a mistake of the program itself (3). Each has an exception here, and each keeps the text that the program would print.
"""

from __future__ import annotations

import re
from pathlib import Path


class SolidusError(Exception):
    """Base class of all exceptions of this package."""


class InputError(SolidusError, ValueError):
    """The input cannot be used.

    Attributes
    ----------
    file, line, column:
        The place, as far as it is known, otherwise ``None``. For a key changed in Python there is no file.
    key:
        The path of a key changed in Python, for example ``"time.step"``, otherwise ``None``.
    found:
        The value found, in one sentence.
    allowed:
        The accepted values, with the most similar name where there is one; may be empty.
    """

    def __init__(self, found: str, allowed: str = "", *, file: Path | None = None, line: int | None = None,
                 column: int | None = None, key: str | None = None) -> None:
        self.found, self.allowed = found, allowed
        self.file, self.line, self.column, self.key = file, line, column, key
        place = ""
        if file is not None:
            place = ":".join(str(part) for part in (file, line, column) if part is not None) + ": "
        elif key is not None:
            place = f"{key}: "
        super().__init__(place + found + (f"\n  {allowed}" if allowed else ""))

    @classmethod
    def from_text(cls, text: str) -> "InputError":
        """Makes the exception from the message of the program: ``place: found``, then ``allowed`` on lines of their own."""
        first, _, allowed = text.strip().partition("\n")
        allowed = "\n".join(line.strip() for line in allowed.splitlines())
        changed = re.match(r"--set ([^=]+)=.*?: (?=\S)", first)
        if changed and (match := _behind_assignment(first)):
            return cls(match, allowed, key=changed[1].strip())
        place = re.match(r"(?P<file>[^:\n]+):(?P<line>\d+)(?::(?P<column>\d+))?: (?P<found>.*)", first)
        if place:
            column = place["column"]
            return cls(place["found"], allowed, file=Path(place["file"]), line=int(place["line"]),
                       column=None if column is None else int(column))
        file, separator, found = first.partition(": ")
        if separator and Path(file).suffix and not re.search(r"\s", file):
            return cls(found, allowed, file=Path(file))
        return cls(first, allowed)


def _behind_assignment(line: str) -> str | None:
    """The sentence after ``--set key=value: ``; values may hold colons and quotes themselves."""
    value = re.match(r"--set [^=]+=\s*(\"(?:[^\"\\]|\\.)*\"|\[.*?\](?=: )|\{.*?\}(?=: )|.*?): (?P<found>.*)", line)
    return value["found"] if value else None


class RunStopped(SolidusError, RuntimeError):
    """No further step of a run could be solved; the results until then are available.

    ``results`` are these results (:class:`Results`), ``reason`` is the message with place, checkpoint and advice.
    """

    def __init__(self, reason: str, results: object = None) -> None:
        super().__init__(reason)
        self.reason, self.results = reason, results


class RunInterrupted(KeyboardInterrupt):
    """A run was stopped by Ctrl-C after a whole step; ``results`` are those until then. Continue with
    ``restart=True``."""

    def __init__(self, reason: str = "", results: object = None) -> None:
        super().__init__(reason)
        self.reason, self.results = reason, results


class InternalError(SolidusError, RuntimeError):
    """An error in Solidus itself; please report it."""


class ProgramMissing(SolidusError, RuntimeError):
    """The program ``solidus`` or the compiled part of this package was not found."""
