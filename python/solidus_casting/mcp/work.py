"""What the tools do, by the verbs of the program and the rest of the package."""

from __future__ import annotations

import csv
import json
import os
import re
import signal
import subprocess
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

from .. import verbs
from ..case import Case
from ..child import run
from ..errors import InputError, RunInterrupted
from ..progress import Progress
from ..results import Results
from .protocol import Cancelled, Job
from .room import Room

Answer = dict[str, Any]
_PATIENCE = 10.0  # seconds for a child that was asked to end


class Workshop:
    """The tools of a folder. What meshes or computes is done one after the other, what asks at once.

    Parameters
    ----------
    room:
        The folder, which paths are seen from and none may leave.
    """

    def __init__(self, room: Room) -> None:
        self._room = room
        self._busy = threading.Lock()

    # Tools

    def new(self, given: Mapping[str, Any], job: Job) -> Answer:
        """A case from the geometry of a casting, and what `check` finds in it."""
        part = self._room.inside(given["part"], "part")
        folder = self._room.inside(given.get("folder", part.stem), "folder")
        # With the sign between them: a value may begin with a dash.
        words: list[Any] = ["new", part, f"--output={folder}", f"--alloy={self._material(given['alloy'], 'alloy')}"]
        words += [f"--{name}={given[name]}" for name in ("process", "symmetry", "unit", "fineness", "shots") if name in given]
        words += ["--riser=auto"] if given.get("riser", False) else []
        words += [f"--as={body}={role}" for body, role in given.get("roles", {}).items()]
        with self._turn(job):
            text, _ = self._call(words, job, "makes the case")
            case = self._room.name(folder)
            checked = self._check(self._room.case(case, "folder", {}), {}, None, job)
        text = self._room.text(text)
        notes = [line.partition("note")[2].strip() for line in text.splitlines() if line.startswith("  note ")]
        return {"case": case, "text": text, "notes": notes, "check": checked}

    def check(self, given: Mapping[str, Any], job: Job) -> Answer:
        """What the program understands a case to be, and what looks wrong in it."""
        changes = given.get("set", {})
        case = self._room.case(given["case"], "case", changes)
        with self._turn(job):
            return self._check(case, changes, given.get("physics"), job)

    def run(self, given: Mapping[str, Any], job: Job) -> Answer:
        """Runs a case to its end; a case that `check` refuses is not run."""
        changes = given.get("set", {})
        case = self._room.case(given["case"], "case", changes)
        folder = self._output(given, case)
        with self._turn(job):
            loaded = _loaded(case, changes)
            try:
                # One process: mpirun starts several over connections, which the room refuses.
                results = run(loaded, folder, processes=1, restart=given.get("restart", False), physics=given.get("physics"),
                              sure=given.get("sure", False), stop=job.stop, progress=lambda step: _tell(job, step))
            except RunInterrupted as stopped:
                raise Cancelled from stopped
        return self._answers(results)

    def report(self, given: Mapping[str, Any], job: Job) -> Answer:
        """One page for the browser, and the answers of the runs on it."""
        folders = [self._room.results(name, "results") for name in given["results"]]
        page = self._room.inside(given.get("output", str(folders[0] / "report.html")), "output")
        if page.suffix != ".html":
            raise InputError(f"'{self._room.name(page)}' is no page", "a name that ends in .html", key="output")
        with self._turn(job):
            _, messages = self._call(["report", *folders, "-o", page], job, "writes the report")
        notes = [self._room.text(line.removeprefix("solidus:").strip()) for line in messages if line.startswith("solidus:")]
        return {"page": self._room.name(page), "bytes": page.stat().st_size, "notes": notes,
                "runs": [self._answers(Results(folder)) for folder in folders]}

    def compare(self, given: Mapping[str, Any], job: Job) -> Answer:
        """Two runs: answers with their errors, curves and fields."""
        first, second = (self._room.results(given[name], name) for name in ("results", "other"))
        name = re.sub(r"[^A-Za-z0-9_-]", "_", self._room.name(second))
        folder = self._room.inside(given.get("output", str(first / f"compare_{name}")), "output")
        with self._turn(job):
            self._call(["compare", first, second, "--no-plots", "-o", folder], job, "compares the runs")
        return {"folder": self._room.name(folder), "answers": _differences(first, second, folder / "answers.csv"),
                "curves": [_curve(row) for row in _rows(folder / "history.csv")],
                "fields": [_field(row) for row in _rows(folder / "fields.csv")],
                "findings": [finding for run in (first, second) for finding in self._findings(Results(run).warnings)]}

    def materials(self, given: Mapping[str, Any], job: Job) -> Answer:
        """The library, or one card with the sources of its values and how far they may be off."""
        del job
        if "name" not in given:
            listed = (line.split(None, 1) for line in verbs.call("materials").splitlines() if line.strip())
            return {"materials": [{"name": name, "title": title} for name, title in listed]}
        text = self._room.text(verbs.call("materials", self._material(given["name"], "name")))
        spread = (re.split(r"\s{2,}", line.strip(), maxsplit=2) for line in text.partition("\nSpread")[2].splitlines()[1:]
                  if line.startswith("  "))
        return {"text": text, "spread": [{"property": row[0], "half_width": row[1], "source": row[2]} for row in spread if len(row) == 3]}

    def explain(self, given: Mapping[str, Any], job: Job) -> Answer:
        """What a key of a case, material or point file means."""
        del job
        file = given.get("file", "case")
        words = [given["key"]] if "key" in given else []
        return {"file": file, "text": verbs.call("explain", *([] if file == "case" else [f"--{file}"]), *words)}

    # Parts of them

    def _check(self, case: str, changes: Mapping[str, Any], physics: str | None, job: Job) -> Answer:
        options = {None: [], "heat": ["--heat-only"], "thermomechanical": ["--coupled"]}[physics]
        with _loaded(case, changes).as_arguments() as words:
            text, messages = self._call(["check", *words, *options], job, "checks the case")
        return {"text": self._room.text(text), "findings": self._findings(_after("warning:", messages)),
                "notes": [self._room.text(line) for line in _after("info:", messages)]}

    def _material(self, given: str, argument: str) -> str:
        """A name of the library as it is, a file with its path."""
        is_file = given.endswith(".toml") or "/" in given
        return str(self._room.inside(given, argument)) if is_file else given

    def _output(self, given: Mapping[str, Any], case: str) -> Path:
        """The folder of the results of a run: a new one, an empty one, or one that a run has written."""
        file, _, variant = case.partition(".toml:")
        file = Path(file if variant else case)
        stem = file.parent.name if file.stem == "case" else file.stem
        folder = self._room.inside(given.get("output", f"results/{stem}{'_' + variant if variant else ''}"), "output")
        if os.path.exists(folder) and (not folder.is_dir() or any(folder.iterdir()) and not (folder / "steps.csv").exists()):
            raise InputError(f"'{self._room.name(folder)}' holds something else than results of a run",
                             "a new folder, or one of results", key="output")
        return folder

    def _answers(self, results: Results) -> Answer:
        try:
            found = self._of_summary(results)
            json.dumps(found, allow_nan=False)
        except (ValueError, TypeError, AttributeError, KeyError) as error:
            raise InputError(f"this is no summary of Solidus: {error!r}", "the summary.json that a run has written",
                             file=Path(self._room.name(results.folder / "summary.json"))) from error
        return found

    def _of_summary(self, results: Results) -> Answer:
        from solidus_plots.answers import answers, bands

        summary = results.summary
        errors = bands(summary)
        return {"results": self._room.name(results.folder), "outcome": summary.get("outcome", "not ended"),
                "end_time_s": summary.get("end_time[s]"), "steps": summary.get("steps"),
                "answers": [{**_named(name), "value": value, "error": errors.get(name)} for name, value in answers(summary).items()],
                "places_si": summary.get("answers", {}), "energy_defect": summary.get("relative_energy_defect"),
                "findings": self._findings(summary.get("warnings", []))}

    def _findings(self, warnings: list[str]) -> list[Answer]:
        found = []
        for warning in warnings:
            error = InputError.from_text(self._room.text(warning))
            place = {"file": str(error.file), "line": error.line} if error.file is not None and error.line else {}
            found.append({"severity": "warning", "message": error.found if place else self._room.text(warning), **place})
        return found

    # Children

    def _turn(self, job: Job) -> "_Turn":
        return _Turn(self._busy, job)

    def _call(self, words: list[Any], job: Job, doing: str) -> tuple[str, list[str]]:
        """Runs a verb to its end. Returns what it printed and the lines of its messages; raises :class:`InputError` and its like,
        and :class:`Cancelled`, with the child ended."""
        child = subprocess.Popen([verbs.program(), *map(str, words)], cwd=self._room.folder, env=verbs.environment(), text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        printed: list[str] = []
        messages: list[str] = []

        def heard(line: str) -> None:
            messages.append(line)
            job.progress(len(messages), None, f"{doing}: {self._room.text(line)}")

        readers = [_reader(child.stdout, printed.append), _reader(child.stderr, heard)]
        job.progress(0, None, doing)
        while True:
            try:
                code = child.wait(timeout=0.1)
                break
            except subprocess.TimeoutExpired:
                if job.stop.is_set():
                    _end(child)
        for reader in readers:
            reader.join()
        job.raise_if_stopped()
        if code != 0:
            verbs.raise_for(code, "\n".join(messages))
        return "\n".join(printed), messages


def _loaded(case: str, changes: Mapping[str, Any]) -> Case:
    try:
        return Case.load(case).copy(changes)
    except TypeError as error:  # a value that TOML does not have
        raise InputError(str(error), "texts, numbers, true, false, lists of these", key="set") from error


class _Turn:
    """Waits until no other request computes, or the request is given up."""

    def __init__(self, busy: threading.Lock, job: Job) -> None:
        self._busy, self._job = busy, job

    def __enter__(self) -> None:
        while not self._busy.acquire(timeout=0.1):
            self._job.raise_if_stopped()

    def __exit__(self, *_: object) -> None:
        self._busy.release()


def _reader(stream: IO[str] | None, heard: Callable[[str], None]) -> threading.Thread:
    def read() -> None:
        assert stream is not None
        with stream:
            for line in stream:
                heard(line.rstrip("\n"))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    return thread


def _end(child: subprocess.Popen[str]) -> None:
    """Ends a child and what it started."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(child.pid, number)
            child.wait(timeout=_PATIENCE)
            return
        except (ProcessLookupError, subprocess.TimeoutExpired):
            continue


def _tell(job: Job, step: Progress) -> None:
    solid = step.row.get("solid_fraction[1]", "")
    frozen = f", {float(solid):.0%} solid" if solid else ""
    until = f" of at most {step.end:g} s" if step.end else ""
    job.progress(step.time, step.end, f"step {step.number}, {step.time:g} s{until}{frozen}")


def _after(mark: str, messages: list[str]) -> list[str]:
    """Messages behind a mark; lines that go on with one are indented."""
    found: list[str] = []
    open_message = False
    for line in messages:
        if line.startswith(mark):
            found.append(line.removeprefix(mark).strip())
            open_message = True
        elif open_message and line.startswith("  "):
            found[-1] += " " + line.strip()
        else:
            open_message = False
    return found


def _named(header: str) -> dict[str, str]:
    """Name and unit of a header such as ``time[s]``."""
    name, bracket, unit = header.partition("[")
    return {"name": name.strip(), "unit": unit.rstrip("]") if bracket else "1"}


def _number(text: str) -> float | None:
    return float(text) if text else None


def _rows(file: Path) -> list[list[str]]:
    """The rows of a table of a comparison, without its header; none where it was not written."""
    if not file.exists():
        return []
    with file.open(newline="", encoding="utf-8") as table:
        return list(csv.reader(table))[1:]


def _curve(row: list[str]) -> Answer:
    names = ("first", "second", "largest_difference", "at_s", "rms")
    return {**_named(row[0]), **dict(zip(names, map(_number, row[1:])))}


def _field(row: list[str]) -> Answer:
    names = ("largest_difference", "x_mm", "y_mm", "z_mm", "rms")
    return {"name": row[0], "unit": row[1], **dict(zip(names, map(_number, row[2:])))}


def _differences(first: Path, second: Path, file: Path) -> list[Answer]:
    """Answers of two runs; where both have errors, whether the difference is larger than these together."""
    from solidus_plots.answers import bands

    errors = [bands(Results(folder).summary) for folder in (first, second)]
    found = []
    for row in _rows(file):
        header, (one, other, difference) = row[0], map(_number, row[1:4])
        of_one, of_other = (band.get(header) for band in errors)
        clear = None if None in (of_one, of_other, difference) else abs(difference) > of_one + of_other
        found.append({**_named(header), "first": one, "second": other, "difference": difference, "error_of_first": of_one,
                      "error_of_second": of_other, "clear": clear})
    return found
