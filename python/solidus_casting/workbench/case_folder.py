"""A case folder as the workbench keeps it: ``case.toml``, what the page chose, and the history of both.

Beside ``case.toml``, which an editor changes as well, the folder has a folder ``open`` with what belongs to the page alone:
``choices.json``, ``check.json``, and ``history``, a numbered copy of the case for each change.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import shutil
from pathlib import Path
from typing import Any

from ..errors import InputError
from . import choices as chosen

_MOST_STEPS = 200  # of the history
_MOST_BYTES = 4_000_000  # of a case file


def digest(text: str | None) -> str:
    """A short name of a text; that of no text is empty."""
    return "" if text is None else hashlib.sha256(text.encode()).hexdigest()[:16]


def write(file: Path, text: str) -> None:
    """Writes a file whole or not at all: aside, then in the place of the old one."""
    file.parent.mkdir(parents=True, exist_ok=True)
    aside = file.with_name(f".{file.name}.new")
    aside.write_text(text, encoding="utf-8")
    os.replace(aside, file)


class CaseFolder:
    """One folder. `part` is the geometry of which its case is made, where the page knows one.

    Attributes
    ----------
    choices:
        What the page has chosen for ``solidus new``.
    """

    def __init__(self, folder: Path, part: Path | None) -> None:
        self.folder, self.part = folder, part
        self.choices = self._kept_choices()
        self._text = self._read()
        self._steps = sorted(self._own("history").glob("[0-9]*"))
        self._at = len(self._steps) - 1
        self._lock: int | None = None

    def _own(self, name: str) -> Path:
        return self.folder / "open" / name

    @property
    def file(self) -> Path:
        return self.folder / "case.toml"

    @property
    def text(self) -> str | None:
        """The case file as it was last seen; ``None`` where there is none."""
        return self._text

    def own(self, name: str) -> Path:
        """A file of the page in this folder."""
        self._own("").mkdir(parents=True, exist_ok=True)
        return self._own(name)

    # Files

    def _read(self) -> str | None:
        try:
            if self.file.stat().st_size > _MOST_BYTES:
                raise InputError("this case file is too large for the page", f"{_MOST_BYTES} bytes at most", file=self.file)
            return self.file.read_text(encoding="utf-8-sig").replace("\r\n", "\n")
        except FileNotFoundError:
            return None
        except UnicodeDecodeError as error:
            raise InputError(f"this is no text: {error}", "a case file in UTF-8", file=self.file) from error

    def _kept_choices(self) -> chosen.Choices:
        try:
            kept = json.loads(self._own("choices.json").read_text(encoding="utf-8"))
            return chosen.checked(kept["choices"] if "choices" in kept else kept)
        except (OSError, ValueError, TypeError):  # none, or one that somebody has damaged
            return chosen.defaults()

    def refresh(self) -> bool:
        """Looks whether an editor has changed the case file; a change becomes a step of the history."""
        text = self._read()
        if text == self._text:
            return False
        if self._at < 0:
            self._remember()  # what was there before
        self._text = text
        self._remember()
        return True

    def change(self, text: str | None = None, choices: chosen.Choices | None = None) -> None:
        """Changes the case file, what the page has chosen, or both, as one step of the history."""
        if self._at < 0:
            self._remember()  # what was there before
        if choices is not None:
            self.choices = choices
        if text is not None and text != self._text:
            write(self.file, text)
            self._text = text
        self._keep_choices()
        self._remember()

    def _keep_choices(self) -> None:
        write(self.own("choices.json"), json.dumps(self.choices, indent=1) + "\n")

    # History

    def _remember(self) -> None:
        """A copy of the present state behind the present step; what was undone before is forgotten."""
        for step in self._steps[self._at + 1:]:
            shutil.rmtree(step, ignore_errors=True)
        del self._steps[self._at + 1:]
        number = int(self._steps[-1].name) + 1 if self._steps else 1
        step = self._own("history") / f"{number:04d}"
        step.mkdir(parents=True, exist_ok=True)
        write(step / "choices.json", json.dumps(self.choices, indent=1) + "\n")
        if self._text is not None:
            write(step / "case.toml", self._text)
        self._steps.append(step)
        for old in self._steps[:-_MOST_STEPS]:
            shutil.rmtree(old, ignore_errors=True)
        del self._steps[:-_MOST_STEPS]
        self._at = len(self._steps) - 1

    @property
    def undoable(self) -> int:
        return max(0, self._at)

    @property
    def redoable(self) -> int:
        return len(self._steps) - 1 - self._at

    def go(self, by: int) -> None:
        """One step back (-1) or forth (1) in the history. Raises :class:`InputError` at its ends."""
        to = self._at + by
        if not 0 <= to < len(self._steps):
            raise InputError("there is nothing more to undo" if by < 0 else "there is nothing more to do again")
        step = self._steps[to]
        self.choices = chosen.checked(json.loads((step / "choices.json").read_text(encoding="utf-8")))
        if (step / "case.toml").exists():
            self._text = (step / "case.toml").read_text(encoding="utf-8-sig")
            write(self.file, self._text)
        elif self.file.exists():
            self.file.unlink()
            self._text = None
        self._at = to
        self._keep_choices()

    def note_made(self, said: str) -> None:
        """Remembers of which choices the case file was made, and what the program said of the part."""
        write(self.own("made_of.json"), json.dumps(self.choices, indent=1) + "\n")
        write(self.own("new.txt"), said + "\n")

    @property
    def said_of_part(self) -> str:
        """What the program said when it made the case; empty where the page did not make it."""
        try:
            return self._own("new.txt").read_text(encoding="utf-8")
        except (OSError, ValueError):
            return ""

    @property
    def is_made_of_choices(self) -> bool | None:
        """Whether the case file was made of what is chosen now; ``None`` where the page did not make it."""
        try:
            return bool(json.loads(self._own("made_of.json").read_text(encoding="utf-8")) == self.choices)
        except (OSError, ValueError):
            return None

    # What check found

    def keep_check(self, found: dict[str, Any]) -> None:
        write(self.own("check.json"), json.dumps(found, indent=1) + "\n")

    def kept_check(self) -> dict[str, Any] | None:
        try:
            kept = json.loads(self._own("check.json").read_text(encoding="utf-8"))
            return kept if isinstance(kept, dict) and {"of", "text", "findings", "error"} <= set(kept) else None
        except (OSError, ValueError):
            return None

    # One server at a time

    def hold(self, address: str) -> str | None:
        """Takes the folder for this server. Returns the address of another one that has it already."""
        self._lock = os.open(self.own("address"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            other = os.read(self._lock, 400).decode(errors="replace").strip()
            self._close()
            return other or "an address that it has not told yet"
        os.ftruncate(self._lock, 0)
        os.pwrite(self._lock, address.encode(), 0)
        return None

    def leave(self) -> None:
        """Gives the folder back, and takes away what only told the address; a case that was looked at alone is left as it was."""
        if self._lock is None:
            return
        try:
            # Where the folder was taken away and made again meanwhile the file is that of another server.
            if self._own("address").stat().st_ino == os.fstat(self._lock).st_ino:
                self._own("address").unlink()
                self._own("").rmdir()
        except OSError:
            pass  # it holds choices or a history, or is gone
        self._close()

    def _close(self) -> None:
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None
