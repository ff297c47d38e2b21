"""Runs a case with the program as a child process."""

from __future__ import annotations

import csv
import logging
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

from . import verbs
from .case import Case, physics_option, run_by
from .errors import RunInterrupted
from .progress import Progress
from .results import Results
from .simulation import Simulation
from .written import with_keys

logger = logging.getLogger("solidus_casting")

_POLL = 0.1  # seconds between looks at the tables of a run


def run(case: Case | str | Path, output: str | Path | None = None, *, restart: bool = False, processes: int | None = None,
        physics: str | None = None, progress: Callable[[Progress], Any] | None = None, sure: bool = False,
        stop: threading.Event | None = None, options: tuple[str, ...] | list[str] = (), in_process: bool = False) -> Any:
    """Runs a case and returns its :class:`Results`: with the program ``solidus`` as a child process, or in this one.

    Parameters
    ----------
    case:
        A :class:`Case`, a case file or a folder with a ``case.toml``, or a variant of either, ``"CASE:VARIANT"``.
    output:
        Folder of the results; for a case file by default ``results/CASE/VARIANT``, as in the program. For a case made
        in Python it must be given.
    restart:
        Continue from the checkpoint in that folder.
    processes:
        ``None``: chosen from the size of the case and the free cores, as in ``solidus run``.
    physics:
        ``"heat"`` or ``"thermomechanical"``, instead of the key of the case.
    progress:
        Called with a :class:`Progress` after every step. An exception from it stops the run and is passed on.
    sure:
        Run twice more, with longer steps and with larger elements, for the error estimates of the results.
    stop:
        An event that another thread sets to stop the run after a whole step, as Ctrl-C does.
    options:
        Options of PETSc.
    in_process:
        Run in this process, by :class:`Simulation`; `output` is needed then, `options` go to :func:`initialize`, and several
        processes are started by ``mpirun``.

    Raises
    ------
    InputError
        The case has an error.
    RunStopped
        No further step could be solved; ``error.results`` has the results so far.
    ProgramMissing
        The program, or ``mpirun`` for several processes, was not found.
    RunInterrupted
        A ``KeyboardInterrupt``: Ctrl-C, or `stop`, after a whole step. A second Ctrl-C ends the run at once.
    """
    if not isinstance(case, Case):
        case = Case.load(case)
    if in_process:
        if output is None or processes not in (None, 1) or options or sure or stop is not None:
            raise ValueError("a run in this process needs a folder for its results, has the processes and options of "
                             "solidus_casting.initialize(), and knows neither sure nor stop")
        with Simulation(case, output, restart=restart, physics=physics) as simulation:
            return simulation.run(progress=progress)
    if output is None and case.file is None:
        raise ValueError("where to? a case that is in no file needs a folder for its results: run(case, 'results/trial')")
    if case.given().get("output", {}).get("folder") is None and output is None and case._assignments() is None:
        raise ValueError("a case with sections added or removed needs a folder for its results: run(case, 'results/trial')")
    with case.as_arguments() as arguments, tempfile.NamedTemporaryFile("r", prefix="solidus_note_") as note:
        command = [str(verbs.program()), "run", *arguments, "--no-progress", *physics_option(physics)]
        command += ["-o", str(Path(output).absolute())] if output is not None else []
        command += ["--restart"] if restart else []
        command += ["--sure"] if sure else []
        if processes is not None:
            if processes > 1:
                verbs.launcher()  # or says that there is none
            command += ["--processes", str(processes)]
        command += ["--", *options] if options else []
        return _Child(command, case, None if output is None else Path(output).absolute(), note, progress, stop).wait()


class _Child:
    def __init__(self, command: list[str], case: Case, folder: Path | None, note: IO[str],
                 progress: Callable[[Progress], Any] | None, stop: threading.Event | None) -> None:
        self._folder, self._note, self._progress = folder, note, progress
        self._stop, self._asked = stop, False
        self._messages: list[str] = []
        self._end = _end_time(case) if progress else None
        self._rows = _Rows(folder / "steps.csv") if progress and folder else None
        if progress and folder is None:
            raise ValueError("progress needs the folder of the results: run(case, 'results/trial', progress=...)")
        self._process = subprocess.Popen(
            command, env=verbs.environment({"SOLIDUS_RESULTS_NOTE": note.name}), stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self._readers = [threading.Thread(target=self._read, args=(stream, messages), daemon=True)
                         for stream, messages in ((self._process.stdout, False), (self._process.stderr, True))]
        for reader in self._readers:
            reader.start()

    def _read(self, stream: IO[str], messages: bool) -> None:
        with stream:
            for line in stream:
                line = line.rstrip("\n")
                if messages:
                    self._messages.append(line)
                if line.startswith("warning:"):
                    logger.warning(with_keys(line.removeprefix("warning:").strip()))
                elif line.strip() and not line.startswith("solidus:"):
                    logger.info(with_keys(line))

    def wait(self) -> Any:
        try:
            while True:
                try:
                    self._watch()
                    break
                except KeyboardInterrupt:
                    if self._asked:
                        self._process.kill()
                        break
                    self._ask_to_stop()
        except BaseException:  # of the caller's own function
            self._ask_to_stop()
            self._process.wait()
            raise
        code = self._process.wait()
        for reader in self._readers:
            reader.join(timeout=5)
        folder = self._folder or Path(self._note.read().strip() or ".")
        results = Results(folder) if (folder / "steps.csv").exists() else None
        errors = "\n".join(self._messages)
        if self._asked or code == 130:
            raise RunInterrupted(verbs.error_text(errors), results)
        if code != 0:
            verbs.raise_for(code, errors, results)
        return results if results is not None else Results(folder)

    def _watch(self) -> None:
        """Returns when the process has ended and its last rows were told of."""
        while self._process.poll() is None:
            if self._stop is not None and self._stop.is_set() and not self._asked:
                self._ask_to_stop()
            self._tell()
            time.sleep(_POLL)
        self._tell()

    def _tell(self) -> None:
        for row in self._rows.new() if self._rows else ():
            self._progress(Progress(float(row["time[s]"]), float(row["dt[s]"]), int(float(row["step[1]"])), self._end, row))

    def _ask_to_stop(self) -> None:
        self._asked = True
        self._process.send_signal(signal.SIGINT)


class _Rows:
    """Rows that a table grows by; of a table that begins again, those of the new one."""

    def __init__(self, file: Path) -> None:
        self._file, self._known = file, self._identity(file)
        self._position = file.stat().st_size if file.exists() else 0
        self._header: list[str] | None = None

    @staticmethod
    def _identity(file: Path) -> Any:
        return file.stat().st_ino if file.exists() else None

    def new(self) -> list[dict[str, str]]:
        if not self._file.exists():
            return []
        size = self._file.stat().st_size
        if self._identity(self._file) != self._known or size < self._position:
            self._known, self._position, self._header = self._identity(self._file), 0, None
        if size == self._position:
            return []
        with self._file.open(newline="") as table:
            if self._header is None:
                header = table.readline()
                if not header.endswith("\n"):
                    return []
                self._header = next(csv.reader([header]))
                self._position = max(self._position, len(header.encode()))
            table.seek(self._position)
            text = table.read()
        whole = text[:text.rfind("\n") + 1]
        self._position += len(whole.encode())
        return [dict(zip(self._header, row)) for row in csv.reader(whole.splitlines())]


def _end_time(case: Case) -> float | None:
    """The end of the run [s]; nothing where its unit is not a plain one."""
    end = case.given().get("time", {}).get("end") or case.resolved().get("time", {}).get("end")
    if not isinstance(end, str):
        return None
    number, _, unit = end.partition(" ")
    factor = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "hour": 3600.0, "hours": 3600.0}.get(unit.strip())
    return None if factor is None else float(number) * factor


run_by(run)
