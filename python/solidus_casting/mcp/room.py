"""The folder that a server works in, and what keeps it there."""

from __future__ import annotations

import os
import sys
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .. import verbs
from ..errors import InputError
from . import landlock

# What a program needs of the system besides its libraries: those of loader, resolver, MPI, fonts and time, none of a user.
_SETTINGS = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "openmpi", "openmpi-mca-params.conf", "pmix-mca-params.conf", "passwd", "group",
             "nsswitch.conf", "hosts", "host.conf", "localtime", "fonts", "matplotlibrc")
_SYSTEM = ("/usr", "/lib", "/lib32", "/lib64", "/bin", "/sbin", "/opt", "/proc", "/sys", "/dev/urandom", "/dev/random", "/dev/zero")
_MOST_FILES = 200  # of a case, each including the next


class Room:
    """A folder: paths are seen from it, and those that lead out of it, by whatever way, are refused.

    Attributes
    ----------
    folder:
        Its full path, links followed.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder).resolve()
        if not self.folder.is_dir():
            raise InputError(f"'{folder}' is no folder", "the folder that holds parts, cases and results")

    # Names of files

    def inside(self, given: str, argument: str, seen_from: Path | None = None) -> Path:
        """The full path of what a text names, links followed. Raises :class:`InputError` where it lies outside."""
        try:
            path = ((seen_from or self.folder) / given).resolve()
        except (OSError, RuntimeError, ValueError) as error:  # a circle of links, a zero in the name
            raise InputError(f"{given!r} is no path: {error}", "a path below the folder of the server", key=argument) from error
        if not path.is_relative_to(self.folder):
            raise InputError(f"'{given}' lies outside of the folder of the server, {self.folder}",
                             "a path below that folder; copy what is needed into it", key=argument)
        return path

    def name(self, path: str | Path) -> str:
        """A path as seen from the folder."""
        return os.path.relpath(path, self.folder)

    def text(self, text: str) -> str:
        """A message with paths seen from the folder."""
        return text.replace(f"{self.folder}/", "")

    def results(self, given: str, argument: str) -> Path:
        """A folder of results, none of whose files is a link that leads out."""
        folder = self.inside(given, argument)
        if not os.path.isdir(folder):
            raise InputError(f"there is no folder '{given}'", "a folder of results, as `run` names it", key=argument)
        for path in _links(folder):
            self.inside(str(path), argument)
        if (folder / "case.toml").is_file():
            self._look_at(folder / "case.toml", argument)
        return folder

    def case(self, given: str, argument: str, changes: Mapping[str, Any]) -> str:
        """A case as the program is given it, ``FILE`` or ``FILE:VARIANT``, with nothing in it that names a file outside."""
        path, colon, variant = given, "", ""
        if not os.path.exists(self.folder / given):
            before, colon, after = given.rpartition(":")
            path, variant = (before, after) if colon else (given, "")
        file = self.inside(path, argument)
        if os.path.isdir(file):
            file = self.inside(str(file / "case.toml"), argument)
        if not os.path.isfile(file):
            raise InputError(f"there is no case '{given}'", "a case file, or a folder with a case.toml; `new` makes one", key=argument)
        self._look_at(file, argument)
        for key, value in changes.items():
            for text in _texts(value):
                self._look_at(self.inside(text, key, file.parent), key)
        return f"{file}{colon}{variant}"

    def _look_at(self, first: Path, argument: str) -> None:
        """Follows every text of a case that could be a path, and what those files name in turn."""
        waiting, seen = [first], set()
        while waiting and len(seen) < _MOST_FILES:
            file = waiting.pop()
            if file in seen or file.suffix != ".toml" or not os.path.isfile(file):
                continue
            seen.add(file)
            try:
                document = tomllib.loads(file.read_text(encoding="utf-8-sig"))
            except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
                continue  # the program says what is wrong with it
            for key, text in _keys_and_texts(document):
                try:
                    waiting.append(self.inside(text, argument, file.parent))
                except InputError as error:
                    raise InputError(f"{key}: {error.found}", error.allowed, file=Path(self.name(file))) from error

    # What the system refuses

    def confine(self, temporary: Path) -> bool:
        """Takes from this process and its children the right to other files than these: the folder, `temporary`, and to read
        those of the system and of Solidus. Returns whether connections are refused too. Raises ``OSError``."""
        allowed = [(Path(path), landlock.READ) for path in _SYSTEM]
        allowed += [(Path("/etc") / name, landlock.READ) for name in _SETTINGS]
        allowed += [(path, landlock.READ) for path in _own_files()]
        allowed += [(Path("/dev/null"), landlock.WORK), (temporary, landlock.TEMPORARY), (self.folder, landlock.WORK)]
        return landlock.restrict(allowed)


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for inner in value.values():
            yield from _texts(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _texts(inner)


def _keys_and_texts(document: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for key, value in document.items():
        if key != "title":
            yield from ((key, text) for text in _texts(value))


def _links(folder: Path) -> Iterator[Path]:
    for place, folders, files in os.walk(folder):
        yield from (path for name in folders + files if (path := Path(place, name)).is_symlink())


def _own_files() -> Iterator[Path]:
    """What Solidus brought, and the Python that runs this."""
    program = verbs.program().resolve()
    yield from (program, program.parent / "solidus-reader", program.parent / "python")
    for level in list(program.parents)[:4]:  # as far as the program of a build lies below the sources
        yield from (level / "share/solidus", level / "materials", level / "interfaces")
    yield from (program.parent.parent / "lib", program.parent.parent / "libexec")
    yield from map(Path, filter(None, os.environ.get("SOLIDUS_MATERIALS", "").split(":")))
    yield from (Path(path) for path in {sys.prefix, sys.base_prefix, *filter(None, sys.path)} if path != "/")
