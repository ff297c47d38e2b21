"""Many runs of a case with other values: python3 -m solidus_plots.study FILE, as `solidus study` does.

Runs go at the same time, one a core, each into a folder of its own. A run that fails is a row of the table as any other,
with its reason. docs/guide/study.md describes the file and what comes out.
"""

import argparse
from pathlib import Path
import subprocess
import sys
import time

from solidus_plots import study_plots, style
from solidus_plots.answers import answers, read_summary
from solidus_plots.compare import as_text, write_csv
from solidus_plots.many_runs import INTERRUPTED, Runner, how_it_ended, jobs_from, program
from solidus_plots.study_file import read_study
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError


def assignment(key, value):
    return f"{key}={str(value).lower() if isinstance(value, bool) else value}"


def arguments(study, values):
    """What follows `run CASE`."""
    changes = [*study.set, *(assignment(parameter.key, value) for parameter, value in zip(study.parameters, values))]
    return [word for change in changes for word in ("--set", change)]


def folder_of(study, folder, number):
    return folder / f"run_{number + 1:0{len(str(len(study.runs)))}d}"


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
    folders = [folder_of(study, folder, number) for number in range(len(study.runs))]
    words = [arguments(study, values) for values in study.runs]
    start = time.monotonic()

    def announce(number, record):
        print(f"  {number + 1}/{len(study.runs)}  {' '.join(words[number][1::2])}: {how_it_ended(record)}", flush=True)

    records = Runner(study.case, restart, study.limit).run_all(list(zip(folders, words)), jobs, announce)
    if records is None:
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


def _refuse_unless_right(study, verb):
    """Throws ResultError with what `check`, or `resolve`, says of the first run."""
    checked = subprocess.run([program(), verb, str(study.case), *arguments(study, study.runs[0])],
                             capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if checked.returncode != 0:
        raise ResultError(f"{study.path}: the first run is not in order:\n{checked.stderr.strip()}")


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
        jobs = jobs_from(options.jobs)
        if options.dry_run:  # keys and values alone: no mesh is made
            _refuse_unless_right(study, "resolve")
            header = ["run", *(parameter.key for parameter in study.parameters)]
            print(as_text(header, [[str(number + 1), *map(str, run)] for number, run in enumerate(study.runs)]))
            return 0
        case = study.case.resolve()
        name = case.name if case.is_dir() else case.parent.name
        folder = options.output or options.results_root / "results" / name / study.path.stem
        # The first run's case is checked before hundreds of folders are made.
        _refuse_unless_right(study, "check")
        print(f"{study.title}: {len(study.runs)} runs, {jobs} at a time, in {folder}")
        failed = run_study(study, folder, jobs, options.restart)
    except (ResultError, OSError) as error:
        print(f"solidus study: {sentence(error)}", file=sys.stderr)
        return 1
    if failed is None:
        print("solidus study: stopped; what has ended is kept, --restart goes on", file=sys.stderr)
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main())
