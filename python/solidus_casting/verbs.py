"""Finds the program ``solidus`` and calls its verbs as child processes."""

from __future__ import annotations

import functools
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any, Iterator, Mapping, NoReturn, Sequence

from .errors import InputError, InternalError, ProgramMissing, RunStopped

_HERE = Path(__file__).resolve()


def _candidates() -> Iterator[Path]:
    named = os.environ.get("SOLIDUS_PROGRAM")
    if named:
        yield Path(named)
        return
    root = _HERE.parents[2]  # the repository, or share/solidus of an installed prefix
    yield _HERE.parent / "installed" / "bin" / "solidus"
    if root.parts[-2:] == ("share", "solidus"):
        yield root.parents[1] / "bin" / "solidus"
    for preset in ("release", "portable"):
        yield root / "build" / preset / "solidus"
    found = shutil.which("solidus")
    # A script of this package called so would start itself.
    if found:
        with open(found, "rb") as file:
            if file.read(4) == b"\x7fELF":
                yield Path(found)


def program() -> Path:
    """Returns the program: what ``SOLIDUS_PROGRAM`` names, else the one that came with this package, that of the prefix
    or the sources which this package lies in, or the one on the ``PATH``. Raises :class:`ProgramMissing`."""
    tried = list(_candidates())
    for candidate in tried:
        if candidate.is_file() and os.access(candidate, os.X_OK):
            return candidate
    raise ProgramMissing("the program 'solidus' was not found; install it, put it on the PATH, or let SOLIDUS_PROGRAM "
                         "name it. Looked for: " + ", ".join(str(path) for path in tried))


def launcher() -> str:
    """Returns the ``mpirun`` by which the program starts several processes: the one next to it, which an archive brings, else
    that of the ``PATH``. Raises :class:`ProgramMissing`."""
    beside = program().resolve().with_name("mpirun")
    if beside.is_file():
        return str(beside)
    if shutil.which("mpirun") is None:
        raise ProgramMissing("several processes need mpirun, which is not on the PATH (Debian's openmpi-bin)")
    return "mpirun"


def environment(extra: Mapping[str, str] | None = None) -> dict[str, str]:
    """The environment of a child: one thread a process unless the caller says otherwise."""
    settings = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NO_COLOR": "1"}
    inherited = dict(os.environ)
    if "OMPI_COMM_WORLD_SIZE" in inherited:  # under mpirun: a child of one of its processes is no part of the job
        inherited = {name: value for name, value in inherited.items()
                     if not name.startswith(("OMPI_", "PMIX_", "PMI_", "PRTE_"))}
    if os.geteuid() == 0:
        settings |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**settings, **inherited, "NO_COLOR": "1", **(extra or {})}


def error_text(stderr: str) -> str:
    """What follows the last ``solidus:`` at the start of a line: the message with which the program ended."""
    lines = stderr.splitlines()
    for index in range(len(lines) - 1, -1, -1):
        if lines[index].startswith("solidus:"):
            return "\n".join([lines[index][len("solidus:"):].strip(), *lines[index + 1:]])
    return stderr.strip()


def raise_for(code: int, stderr: str, results: object = None) -> NoReturn:
    """Raises the exception of an exit code."""
    text = error_text(stderr)
    if code == 1:
        raise InputError.from_text(text)
    if code == 2:
        raise RunStopped(text, results)
    if code < 0:
        raise InternalError(f"the program was ended by signal {-code}\n{text}".rstrip())
    raise InternalError(text or f"the program ended with exit code {code}")


def call(*arguments: Any, cwd: Path | None = None) -> str:
    """Runs a verb to its end and returns what it prints. Raises :class:`InputError` and its like."""
    done = subprocess.run([program(), *map(str, arguments)], cwd=cwd, env=environment(), text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        raise_for(done.returncode, done.stderr)
    return done.stdout


@functools.lru_cache(maxsize=8)
def _cached(path: str, changed: float, arguments: Sequence[str]) -> str:
    del path, changed  # of the program: another one may say something else
    return call(*arguments)


def cached(*arguments: str) -> str:
    """As :func:`call`, once for each program: of verbs that always print the same."""
    path = program()
    return _cached(str(path), path.stat().st_mtime, arguments)


def version() -> str:
    """The version of the program that is used, for example ``"0.1.0"``."""
    return cached("version").split()[1]
