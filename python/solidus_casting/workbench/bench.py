"""What the page shows and does: a part, the case that is made of it, one job at a time, and the runs."""

from __future__ import annotations

import shutil
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .. import verbs
from ..errors import InputError, SolidusError
from . import choices as chosen, findings, pictures, preview, runs, skin as skins, toml_edit
from .case_folder import CaseFolder, digest
from .children import Child
from .edit import Edit
from .job import Conflict, Job
from .work_folder import WorkFolder

Answer = dict[str, Any]

_MARKS = {"warning:": "warning", "solidus:": "error"}
_LINES = 60  # of a job that the page sees


class Bench:
    """The workbench of a folder; its methods may be called from several threads.

    Parameters
    ----------
    folder:
        Where parts lie and cases are made; results go to ``results/CASE/run_N`` in it.
    address:
        Of the server, left in a case folder so that a second one does not work there too.
    """

    def __init__(self, folder: Path, address: str) -> None:
        self.place, self._address = WorkFolder(folder), address
        self._changed = threading.Condition(threading.RLock())
        self._revision, self._edits = 1, 0
        self._case: CaseFolder | None = None
        self._skins: dict[str, tuple[str, bytes]] = {}
        self._job: Job | None = None
        self._jobs = 0  # that were begun
        self._last: Answer | None = None
        self._preview: Answer | None = None
        self._compared: Answer | None = None
        self._closed = False

    # What the page sees

    def state(self, known: int = 0, patience: float = 0.0) -> Answer:
        """Everything but pictures. With `known`, the revision that the page has, waits up to `patience` seconds for another one."""
        until = time.monotonic() + patience
        with self._changed:
            while True:
                self._look_at_files()
                left = until - time.monotonic()
                if self._revision != known or left <= 0 or self._closed:
                    return self._state()
                self._changed.wait(min(left, 0.5))

    def _look_at_files(self) -> None:
        """A change by an editor is a change as any other."""
        try:
            if self._case is not None and self._case.refresh():
                self._edits += 1
                self._tell()
        except (SolidusError, OSError):
            pass  # half written: the next look sees it whole

    def _state(self) -> Answer:
        case = self._case
        answer: Answer = {"revision": self._revision, "edits": self._edits, "folder": str(self.place.folder), "job": self._job_state(),
                          "last": self._last, "skins": {name: tag for name, (tag, _) in self._skins.items()}, "compared": self._compared,
                          "part": None, "case": None, "choices": None, "made": None, "runs": [], "thickest": [], "check": None, "undo": 0, "redo": 0, "preview": None}
        if case is None:
            return answer
        answer |= {"part": None if case.part is None else self.place.name(case.part), "choices": case.choices, "made": case.is_made_of_choices,
                   "runs": runs.all_runs(self._results), "thickest": findings.measured(case.said_of_part) if case.text is not None else [],
                   "undo": case.undoable, "redo": case.redoable, "case": self._case_state(case), "name": self.place.name(case.folder)}
        if self._preview is not None and self._preview["of"] == preview.of_choices(case.choices):
            answer["preview"] = self._preview
        check = case.kept_check()
        if check is not None:
            answer["check"] = {**check, "current": check["of"] == digest(case.text)}
        return answer

    def _case_state(self, case: CaseFolder) -> Answer | None:
        if case.text is None:
            return None
        document, error = None, None
        try:
            document = toml_edit.parsed(case.text)
        except InputError as problem:
            error = str(problem)
        return {"file": self.place.name(case.file), "text": case.text, "document": document, "error": error, "digest": digest(case.text)}

    def _job_state(self) -> Answer | None:
        job = self._job
        if job is None:
            return None
        found: Answer = {"what": job.what, "label": job.label, "seconds": round(time.time() - job.began, 1), "lines": job.lines[-_LINES:],
                         "stopping": job.stopping, "run": job.run, "watch": job.watch, "progress": {}}
        if job.run is not None and self._case is not None:
            document = (self._case_state(self._case) or {}).get("document") or {}
            until_solid = document.get("time", {}).get("until") == "solid"
            found["progress"] = runs.progress(self._results / job.run, runs.end_time(document), until_solid)
        return found

    def picture(self, name: str) -> bytes:
        """The skin of the part or of the case, packed. Raises :class:`InputError`."""
        with self._changed:
            if name not in self._skins:
                raise InputError(f"there is no picture of the {name} yet")
            return self._skins[name][1]

    def files(self) -> Answer:
        """Parts and cases that the folder holds."""
        return self.place.files()

    def report(self, run: str) -> Path:
        return runs.folder_of(self._results, run) / "report.html"

    def printed(self, run: str) -> Path:
        """The PDF of a run, or the page that a browser prints."""
        return runs.folder_of(self._results, run) / (runs.printed(runs.folder_of(self._results, run)) or "report.pdf")

    def comparison(self) -> Path:
        return self._open_case().own("compared") / "report.html"

    def curves(self, run: str) -> Answer:
        return runs.curves(runs.folder_of(self._results, run))

    # What it opens

    def open(self, given: str) -> None:
        """Opens a part or a case of the folder by its name, and reads its picture. Raises :class:`InputError`."""
        case = self.place.case_of(given)
        with self._changed:
            self.must_be_free()
            if self._case is not None:
                self._case.leave()  # which may be the same one
            other = case.hold(self._address) if case.folder.is_dir() else None
            if other is not None:
                if self._case is not None and self._case.folder.is_dir():
                    self._case.hold(self._address)
                raise Conflict(f"{self.place.name(case.folder)} is open already, at {other}")
            self._case, self._skins, self._last, self._compared, self._preview = case, {}, None, None, None
            self._edits += 1
            self._tell()
            self._start("picture", "reads the part" if case.text is None else "reads the case", self._read_pictures)

    # Changes, which the page asks for with the number of edits that it has seen

    def choose(self, seen: int, given: Any) -> None:
        wanted = chosen.checked(given)
        with self._edit(seen) as case:
            case.change(choices=wanted)

    def set_text(self, seen: int, text: Any) -> None:
        if not isinstance(text, str):
            raise InputError("this is no text")
        with self._edit(seen) as case:
            case.change(text=text.replace("\r\n", "\n"))

    def set_key(self, seen: int, path: Any, value: Any) -> None:
        with self._edit(seen) as case:
            case.change(text=toml_edit.with_value(self._text_of(case), toml_edit.path_of(path), value))

    def add_sections(self, seen: int, sections: Any) -> None:
        """Adds entries to lists of sections, as one step: each has a `path` and `values`."""
        if not isinstance(sections, list) or not all(isinstance(s, dict) and isinstance(s.get("values"), dict) for s in sections):
            raise InputError("these are no sections with values")
        with self._edit(seen) as case:
            text = self._text_of(case)
            for section in sections:
                text = toml_edit.with_section(text, toml_edit.path_of(section.get("path")), section["values"])
            case.change(text=text)

    def remove(self, seen: int, paths: Any) -> None:
        """Takes keys, sections and entries of lists away, in this order, as one step."""
        with self._edit(seen) as case:
            case.change(text=toml_edit.without_all(self._text_of(case), paths))

    def go(self, seen: int, by: int) -> None:
        with self._edit(seen) as case:
            case.go(by)
            if case.text is None:
                self._skins.pop("case", None)  # there are no bodies without a case

    def _edit(self, seen: int) -> Edit:
        return Edit(self, seen)

    def begin_edit(self, seen: int) -> CaseFolder:
        """Takes the lock, and looks that nothing has changed since the page has seen it. Raises :class:`Conflict`."""
        self._changed.acquire()
        try:
            case = self._open_case()
            self._look_at_files()
            self.must_be_free()
            if seen != self._edits:
                raise Conflict("another page, or an editor, has changed this meanwhile: it is shown as it is now")
            if case.folder.is_dir() is False:
                case.folder.mkdir()
                case.hold(self._address)
            return case
        except BaseException:
            self._changed.release()
            raise

    def end_edit(self) -> None:
        self._edits += 1
        self._tell()
        self._changed.release()

    def _text_of(self, case: CaseFolder) -> str:
        if case.text is None:
            raise InputError("there is no case file yet", "Make the case first")
        return case.text

    # Jobs

    def make(self, seen: int, only_show: bool = False) -> None:
        """A case of the part by ``solidus new``, then what ``check`` finds in it; or only what would be made."""
        with self._edit(seen) as case:
            if case.part is None:
                raise InputError("the part of which this case was made is not next to its folder", "a part that is opened")
            words = chosen.words(case.choices, case.part, case.own("made").parent, case.own("made"))
            for name, content in chosen.files(case.choices).items():
                case.own(name).write_text(content, encoding="utf-8")
        if only_show:
            self._begin("preview", "plans the mould", lambda job: self._look_ahead(job, words))
        else:
            self._begin("new", "makes the case", lambda job: self._make(job, words))

    def check(self) -> None:
        self._text_of(self._open_case())
        self._begin("check", "checks the case", self._check)

    def run(self, physics: Any, sure: Any) -> None:
        option = {"heat": ["--heat-only"], "coupled": ["--coupled"], None: []}.get(physics if isinstance(physics, str) else None)
        self._text_of(self._open_case())
        if option is None:
            raise InputError(f"'{physics}' is nothing that is computed", "heat, coupled")
        self._begin("run", "runs the case", lambda job: self._run(job, option + (["--sure"] if sure is True else [])))

    def compare(self, first: Any, second: Any) -> None:
        folders = [runs.folder_of(self._results, name) for name in (first, second)]
        if folders[0] == folders[1]:
            raise InputError("these are the same run", "two runs")
        self._begin("compare", f"compares {first} and {second}", lambda job: self._compare(job, folders))

    def print(self, name: Any) -> None:
        """The pages of a run for the customer: a PDF, or what a browser prints where no Chromium is there."""
        words = ["report", str(runs.folder_of(self._results, name)), "--pdf"]
        self._begin("print", f"prints {name}", lambda job: self._print(job, words))

    def _print(self, job: Job, words: list[str]) -> None:
        self._call(job, words, f"prints {Path(words[1]).name}")

    def stop(self) -> None:
        """Stops the job: the first time as Ctrl-C does, the second time at once."""
        with self._changed:
            job = self._job
            if job is None:
                return
            again, job.stopping = job.stopping, True
            if job.child is not None:
                job.child.kill() if again else job.child.ask_to_stop()
            self._tell()

    def close(self) -> None:
        """Ends the job; a run leaves its checkpoint."""
        with self._changed:
            self._closed = True
            child = self._job.child if self._job is not None else None
            self._changed.notify_all()
        if child is not None:
            child.end()
        if self._case is not None:
            self._case.leave()

    def _begin(self, what: str, label: str, work: Callable[[Job], None]) -> None:
        with self._changed:
            self.must_be_free()
            self._start(what, label, work)

    def _start(self, what: str, label: str, work: Callable[[Job], None]) -> None:
        self._jobs += 1
        job = Job(what, label, self._jobs)
        self._job, self._last = job, None
        self._tell()
        threading.Thread(target=self._work, args=(job, work), daemon=True).start()

    def _work(self, job: Job, work: Callable[[Job], None]) -> None:
        """Does a job and keeps how it ended."""
        last: Answer = {"what": job.what, "ok": True, "message": "", "findings": [], "number": job.number}
        try:
            work(job)
        except (SolidusError, KeyboardInterrupt, OSError) as error:
            case = self._case_state(self._case) if self._case is not None else None
            message = "stopped" if job.stopping else str(error)
            last |= {"ok": False, "message": message, "stopped": job.stopping,
                     "findings": [] if job.stopping else [findings.finding("error", str(error), case["text"] if case else "", (case or {}).get("document") or {})]}
        except Exception as error:  # a mistake of ours is told, and the page goes on
            last |= {"ok": False, "message": f"a mistake of the workbench: {error!r}"}
        with self._changed:
            # With its run: a page that has heard nothing while it went on hears now that it has ended.
            self._job, self._last = None, {**last, "run": job.run}
            self._tell()

    def _call(self, job: Job, words: list[str], label: str, heard: Callable[[str], None] | None = None) -> Child:
        """Runs a verb to its end. Raises what its exit code says."""
        def hear(line: str, of_errors: bool) -> None:
            with self._changed:
                if of_errors or words[0] == "run":
                    job.lines.append(line[:400])
                    del job.lines[:-10 * _LINES]
                if heard is not None and not of_errors:
                    heard(line)
                self._tell()

        with self._changed:
            if job.stopping:
                raise InputError("stopped")
            job.label = label
            job.child = Child(words, self.place.folder, hear)
        code = job.child.wait()
        if code != 0:
            verbs.raise_for(code, "\n".join(job.child.messages))
        return job.child

    # The work of jobs

    def _read_pictures(self, job: Job) -> None:
        case = self._open_case()
        if case.part is not None:
            self._read_part(job, case)
        if case.text is not None:
            self._read_case(job, case)

    def _read_part(self, job: Job, case: CaseFolder) -> None:
        self._keep("part", pictures.of_part(lambda words, label: self._call(job, words, label), case, self.place.folder))

    def _read_case(self, job: Job, case: CaseFolder) -> None:
        document = (self._case_state(case) or {}).get("document") or {}
        skin = pictures.of_case(lambda words, label: self._call(job, words, label), case, document)
        if skin is not None:
            self._keep("case", skin)

    def _keep(self, name: str, skin: skins.Skin) -> None:
        with self._changed:
            self._skins[name] = (f"{self._revision}", skin.packed())
            self._tell()

    def _look_ahead(self, job: Job, words: list[str]) -> None:
        choices = self._open_case().choices
        child = self._call(job, ["new", "--preview", *words], "plans the mould")
        with self._changed:
            self._preview = preview.read(child.output, choices)

    def _make(self, job: Job, words: list[str]) -> None:
        """Makes the case aside and puts it into its folder when all has gone well."""
        case = self._open_case()
        shutil.rmtree(made := case.own("made"), ignore_errors=True)
        child = self._call(job, ["new", *words], "makes the case")
        text = (made / "case.toml").read_text(encoding="utf-8")
        for probe in case.choices["probes"]:
            text = toml_edit.with_section(text, ["probe"], {"name": probe["name"], "kind": "point", "field": "temperature", "unit": "degC",
                                                            "point": chosen.place_text(probe["point"])})
        for path in made.iterdir():
            if path.name != "case.toml":
                shutil.move(path, case.folder / path.name)
        with self._changed:
            case.change(text=text)
            case.note_made("\n".join(child.output))
            self._edits += 1
        shutil.rmtree(made, ignore_errors=True)
        self._check(job)

    def _check(self, job: Job) -> None:
        """What `check` says, whether it refuses the case or not, and the picture of the bodies."""
        case = self._open_case()
        text, document = case.text or "", (self._case_state(case) or {}).get("document") or {}
        error, child = None, None
        try:
            child = self._call(job, ["check", str(case.folder)], "checks the case")
        except SolidusError as problem:
            error = problem
            child = job.child
        if job.stopping:
            raise InputError("stopped")
        assert child is not None
        found = [findings.finding(severity, message, text, document) for severity, message in findings.grouped(child.messages, _MARKS)]
        with self._changed:
            case.keep_check({"of": digest(text), "text": "\n".join(child.output), "findings": found, "error": None if error is None else str(error)})
            self._tell()
        if error is None:
            self._read_case(job, case)

    def _run(self, job: Job, options: list[str]) -> None:
        case = self._open_case()
        self._results.mkdir(parents=True, exist_ok=True)
        name = runs.next_name(self._results)
        job.run = name

        def heard(line: str) -> None:
            mark = "http://127.0.0.1:"
            if job.watch is None and line.startswith("Watch it") and mark in line:
                job.watch = line[line.index(mark):].strip()

        words = ["run", f"--output={self._results / name}", "--no-progress", "--watch", "--report", *options, str(case.folder)]
        self._call(job, words, f"computes {name}", heard)

    def _compare(self, job: Job, folders: list[Path]) -> None:
        case = self._open_case()
        place = case.own("compared")
        shutil.rmtree(place, ignore_errors=True)
        self._call(job, ["compare", *map(str, folders), "--no-plots", f"--output={place}"], "compares the runs")
        self._call(job, ["report", *map(str, folders), f"--output={place / 'report.html'}"], "writes the report of both")
        with self._changed:
            self._compared = {"first": folders[0].name, "second": folders[1].name, "answers": runs.differences(place / "answers.csv"),
                              "tag": str(self._revision)}

    # Parts of them

    @property
    def _results(self) -> Path:
        return self.place.folder / "results" / self._open_case().folder.name

    def _open_case(self) -> CaseFolder:
        if self._case is None:
            raise InputError("nothing is open", "a part or a case")
        return self._case

    def must_be_free(self) -> None:
        """Raises :class:`Conflict` while something is computed."""
        if self._job is not None:
            raise Conflict(f"Solidus {self._job.label}: wait for its end, or stop it")

    def _tell(self) -> None:
        self._revision += 1
        self._changed.notify_all()
