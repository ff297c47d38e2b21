"""Many runs of a case with other values: python3 -m solidus_plots.study FILE, as `solidus study` does.

Runs go beside each other, one a core, each into a folder of its own. A run that fails is a row of the table as any other,
with its reason. docs/guide/study.md describes the file and what comes out.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import threading
import time

from solidus_plots import study_plots, style
from solidus_plots.answers import answers, read_summary
from solidus_plots.compare import as_text, write_csv
from solidus_plots.study_file import read_study
from solidus_plots.vtu import ResultError

RECORD = "run.json"  # in the folder of a run: its values and how it ended
INTERRUPTED = 130


def program():
    """The program that runs the cases: the one that was called."""
    return os.environ.get("SOLIDUS_PROGRAM", "solidus")


def assignment(key, value):
    return f"{key}={str(value).lower() if isinstance(value, bool) else value}"


def arguments(study, values):
    """What stands behind `run CASE`."""
    changes = [*study.set, *(assignment(parameter.key, value) for parameter, value in zip(study.parameters, values))]
    return [word for change in changes for word in ("--set", change)]


def _reason(log, code):
    """Why a run failed: the last thing it said on its own."""
    lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
    begins = [i for i, line in enumerate(lines) if line.startswith("solidus: ")]
    if begins:
        return lines[begins[-1]].removeprefix("solidus: ").strip()
    return f"exit code {code}" + (f": {lines[-1].strip()}" if lines else "")


class Runner:
    """Runs what is to be run and keeps a record of each."""

    def __init__(self, study, folder, restart):
        self._study, self._folder, self._restart = study, folder, restart
        self._processes, self._lock, self._stopped = set(), threading.Lock(), False

    def folder_of(self, number):
        return self._folder / f"run_{number + 1:0{len(str(len(self._study.runs)))}d}"

    def run(self, number):
        """The record of a run: {values, code, reason, seconds}; nothing where the study was interrupted."""
        folder, words = self.folder_of(number), arguments(self._study, self._study.runs[number])
        record_file = folder / RECORD
        if self._restart and record_file.exists():
            record = json.loads(record_file.read_text())
            if record.get("arguments") == words:
                return record
        folder.mkdir(parents=True, exist_ok=True)
        record_file.unlink(missing_ok=True)
        start, log = time.monotonic(), folder / "log.txt"
        with log.open("w") as out:
            with self._lock:
                if self._stopped:
                    return None
                process = subprocess.Popen([program(), "run", str(self._study.case), "-o", str(folder), "--no-progress",
                                            *words], stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                           start_new_session=True,  # Ctrl-C is handed on by stop(), once
                                           env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
                self._processes.add(process)
            reason = None
            try:
                code = process.wait(self._study.limit)
            except subprocess.TimeoutExpired:
                process.kill()
                code, reason = process.wait(), f"stopped after the limit of {self._study.limit:g} s"
            with self._lock:
                self._processes.discard(process)
        if self._stopped:
            return None
        record = {"arguments": words, "code": code, "seconds": round(time.monotonic() - start, 3),
                  "reason": reason or ("" if code == 0 else _reason(log, code))}
        record_file.write_text(json.dumps(record, indent=2) + "\n")
        return record

    def stop(self):
        """No further run begins; those that are under way leave a checkpoint."""
        with self._lock:
            self._stopped = True
            for process in self._processes:
                process.send_signal(signal.SIGINT)


def results_of(study, folders, records):
    """[run] name -> number, of runs that ended well; and the names, in their order."""
    found = []
    for folder, record in zip(folders, records):
        summary = read_summary(folder) if record["code"] == 0 else None
        found.append({**answers(summary), **summary.get("final", {})} if summary else None)
    ended = [values for values in found if values is not None]
    usual = list(dict.fromkeys(name for folder, record in zip(folders, records) if record["code"] == 0
                               for name in answers(read_summary(folder))))
    known = list(dict.fromkeys(name for values in ended for name in values))
    unknown = [name for name in study.results if ended and name not in known]
    if unknown:
        raise ResultError(f"{study.path}: no run has the result '{unknown[0]}'; there are {', '.join(known)}")
    return found, list(dict.fromkeys([*usual, *study.results]))


def numbers(parameter, values):
    """Values of a parameter for a table: numbers of a range without their unit."""
    if parameter.low is None:
        return list(values)
    return [float(str(value).split(" ")[0]) for value in values]


def table(study, folders, records):
    """Header and rows of study.csv."""
    found, names = results_of(study, folders, records)
    columns = [numbers(parameter, [run[i] for run in study.runs]) for i, parameter in enumerate(study.parameters)]
    header = ["run", *(parameter.header() for parameter in study.parameters), "outcome", "wall time[s]", *names]
    rows = []
    for number, record in enumerate(records):
        values = found[number] or {}
        rows.append([folders[number].name, *(column[number] for column in columns),
                     "finished" if record["code"] == 0 else record["reason"], record["seconds"],
                     *(values.get(name) for name in names)])
    return header, rows


def run_study(study, folder, jobs, restart):
    """Runs everything, writes table and pictures; the number of failed runs, nothing where it was interrupted."""
    runner = Runner(study, folder, restart)
    folders = [runner.folder_of(number) for number in range(len(study.runs))]
    records = [None] * len(study.runs)
    start = time.monotonic()
    try:
        with ThreadPoolExecutor(jobs) as pool:
            try:
                for number, record in enumerate(pool.map(runner.run, range(len(study.runs)))):
                    records[number] = record
                    how = "interrupted" if record is None else "finished" if record["code"] == 0 else record["reason"]
                    print(f"  {number + 1}/{len(study.runs)}  {' '.join(arguments(study, study.runs[number])[1::2])}: {how}",
                          flush=True)
            except KeyboardInterrupt:
                runner.stop()
                raise
    except KeyboardInterrupt:
        return None
    header, rows = table(study, folders, records)
    write_csv(folder / "study.csv", header, rows)
    print(f"\n{as_text(header, [[*row[:1], *(cut(cell) for cell in row[1:])] for row in rows])}\n")
    style.setup()
    files = study_plots.draw(study, header, rows, folder)
    failed = sum(record["code"] != 0 for record in records)
    print(f"{len(rows)} runs, {failed} failed, in {time.monotonic() - start:.0f} s; table and {len(files)} pictures in "
          f"{folder}")
    return failed


def cut(cell, most=40):
    return cell if not isinstance(cell, str) or len(cell) <= most else cell[:most - 1] + "…"


def main(given=None):
    parser = argparse.ArgumentParser(prog="solidus study", description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path, metavar="FILE")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--results-root", type=Path, default=Path("."))
    parser.add_argument("--jobs", default="")
    parser.add_argument("--restart", action="store_true")
    parser.add_argument("--dry-run", action="store_true")
    options = parser.parse_args(given)
    try:
        study = read_study(options.file)
        if options.jobs and not (options.jobs.isdigit() and int(options.jobs) > 0):
            raise ResultError(f"--jobs is a whole number of runs at a time, not '{options.jobs}'")
        jobs = int(options.jobs) if options.jobs else len(os.sched_getaffinity(0))
        if options.dry_run:
            header = ["run", *(parameter.key for parameter in study.parameters)]
            print(as_text(header, [[str(number + 1), *map(str, run)] for number, run in enumerate(study.runs)]))
            return 0
        case = study.case.resolve()
        name = case.name if case.is_dir() else case.parent.name
        folder = options.output or options.results_root / "results" / name / study.path.stem
        # The first run's case is checked before hundreds of folders are made.
        checked = subprocess.run([program(), "check", str(study.case), *arguments(study, study.runs[0])],
                                 capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if checked.returncode != 0:
            raise ResultError(f"{study.path}: the first run is not in order:\n{checked.stderr.strip()}")
        print(f"{study.title}: {len(study.runs)} runs, {jobs} at a time, in {folder}")
        failed = run_study(study, folder, jobs, options.restart)
    except (ResultError, OSError) as error:
        print(f"solidus study: {error}", file=sys.stderr)
        return 1
    if failed is None:
        print("solidus study: stopped; what has ended is kept, --restart goes on", file=sys.stderr)
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main())
