"""Risers and chills for a part, by runs of heat alone: python3 -m solidus_plots.design PART, as `solidus design` does.

The least metal of risers with which the part is sound on a coarse mesh is looked for (design_search.py), and the design is
checked on a mesh of half the size. docs/guide/design.md describes what comes out.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
import json
from pathlib import Path
import shutil
import subprocess
import sys
import threading
import time
import tomllib

from solidus_plots import design_plots, style
from solidus_plots.compare import as_text, write_csv
from solidus_plots.design_feeders import chosen_risers
from solidus_plots.design_judgement import Limits, judge_run
from solidus_plots.design_search import CLOSE, Search, Trial
from solidus_plots.design_surface import Surface
from solidus_plots.many_runs import INTERRUPTED, Runner, jobs_from, program
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError, read_collection, read_fields

MOST_RUNS = 25
INPUT_ERROR = 1  # of a run: what the case says is at fault
CHECKS = 4  # of the runs, that are kept for the finer mesh
COARSE = 0.5  # fineness of the search where none is asked for; the check has twice as much
LARGER = (1.04, 1.09, 1.18, 1.35)  # sizes that are tried on the finer mesh where the design is not sound there


RECORD = "new.json"  # in the folder of a case: what it was made with


class Interrupted(Exception):
    pass


class Workshop:
    """Makes a case of each design and runs it."""

    def __init__(self, part, words, folder, jobs, limits, restart):
        """part: the geometry; words: what `solidus new` is told of it."""
        self._part, self._words, self._folder, self._jobs = part, words, folder, jobs
        self._limits, self._restart = limits, restart
        self._runners, self._lock, self._stopped = set(), threading.Lock(), False
        self._bases, self._made = {}, set()  # (kinds of a design, fineness) -> number and lock of its case
        self.rows = []

    def new_case(self, folder, fineness, *more):
        """Makes a case with `solidus new`, or finds it made with the same words. Throws ResultError."""
        words = [program(), "new", str(self._part), *self._words, "--fineness", f"{fineness:g}", *more, "-o", str(folder)]
        record = folder / RECORD
        if self._restart and record.exists() and json.loads(record.read_text()) == words:
            return
        shutil.rmtree(folder, ignore_errors=True)
        made = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if made.returncode != 0:
            raise ResultError(made.stderr.strip().removeprefix("solidus: "))
        record.write_text(json.dumps(words) + "\n")

    def evaluate(self, trials, fineness):
        """Fills the judgements of trials, as many at a time as there are jobs. Throws Interrupted."""
        first = len(self.rows)
        for trial in trials:
            self.rows.append({"trial": trial, "folder": self._folder / f"{len(self.rows) + 1:02d}", "fineness": fineness})
        try:
            with ThreadPoolExecutor(self._jobs) as pool:
                try:
                    for row in pool.map(self._run, self.rows[first:]):
                        announce(row)
                except KeyboardInterrupt:
                    self.stop()
                    raise
        except KeyboardInterrupt:
            raise Interrupted from None
        if self._stopped:
            raise Interrupted

    def _base(self, design, fineness):
        """The case of the first design with the same risers and chills, whatever their sizes: other sizes need no new
        one."""
        key = (design.kinds(), fineness)
        with self._lock:
            number, lock = self._bases.setdefault(key, (len(self._bases), threading.Lock()))
        folder = self._folder / "cases" / f"{number:02d}"
        with lock:
            if key not in self._made:
                self.new_case(folder, fineness, *self._feeders(folder, design))
                self._made.add(key)
        return folder

    @staticmethod
    def _feeders(folder, design):
        """Writes the file of risers and chills next to a folder; the words for `solidus new`."""
        text, file = design.toml(), folder.with_suffix(".toml")
        if not text:
            return []
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return ["--riser", str(file)]

    def _run(self, row):
        trial, folder, start = row["trial"], row["folder"], time.monotonic()
        try:
            if self._stopped:
                return row
            sizes = [word for change in trial.design.settings() for word in ("--set", change)]
            record = self._run_case(self._base(trial.design, row["fineness"]), folder, sizes)
            if record is not None and record["code"] == INPUT_ERROR:
                # With other sizes other skins touch, a sleeve the wall of the part, and contacts change with them.
                own = self._folder / "cases" / f"of_{folder.name}"
                self.new_case(own, row["fineness"], *self._feeders(own, trial.design))
                record = self._run_case(own, folder, [])
            if record is None:
                self._stopped = True
            elif record["code"] != 0:
                trial.failure = record["reason"]
            else:
                trial.judgement = judge_run(folder, self._limits)
        except ResultError as error:
            trial.failure = str(error)
        row["seconds"] = time.monotonic() - start
        return row

    def _run_case(self, case, folder, words):
        """The record of the run (many_runs.py); nothing where it was stopped."""
        runner = Runner(case, self._restart)
        with self._lock:
            self._runners.add(runner)
        record = runner.run(folder, ["--heat-only", "--set", 'output.every="1e9 s"', *words])
        with self._lock:
            self._runners.discard(runner)
        return record

    def final_case(self, folder, design, fineness):
        """The case of a design on its own."""
        self.new_case(folder, fineness, *self._feeders(self._folder / "chosen", design))
        (folder / RECORD).unlink()

    def stop(self):
        with self._lock:
            self._stopped = True
            for runner in self._runners:
                runner.stop()

    def folder_of(self, trial):
        return next(row["folder"] for row in self.rows if row["trial"] is trial)

    def fineness_of(self, trial):
        return next(row["fineness"] for row in self.rows if row["trial"] is trial)


def announce(row):
    trial = row["trial"]
    if trial.judgement is None:
        verdict = trial.failure.splitlines()[0] if trial.failure else "interrupted"
    else:
        verdict = "sound" if trial.sound() else "; ".join(trial.judgement.reasons)
    print(f"  {row['folder'].name}  {trial.what}: {trial.design.text()}: {verdict}", flush=True)


def table(workshop):
    header = ["run", "what", "design", "fineness", "nodes of metal", "risers[cm3]", "poured[cm3]", "holes in the part[cm3]",
              "densest pores[%]", "left of the riser[%]", "verdict", "wall time[s]"]
    rows = []
    for row in workshop.rows:
        trial, judged = row["trial"], row["trial"].judgement
        verdict = trial.failure.splitlines()[0] if trial.failure else "" if judged is None else \
            "sound" if judged.sound else "; ".join(judged.reasons)
        numbers = [None] * 5 if judged is None else [1e6 * judged.metal, 1e6 * judged.holes, 100 * judged.pores,
                                                     100 * judged.left, judged.nodes]
        rows.append([row["folder"].name, trial.what, trial.design.text(), row["fineness"], numbers[4],
                     1e-3 * trial.design.metal(), *numbers[:4], verdict, row.get("seconds")])
    return header, rows


def checked(workshop, best, most, fineness, jobs):
    """The trial that is sound on the finer mesh with the least metal: the best one, or it with larger risers; nothing
    where none is. most: runs."""
    what = "on a mesh of half the size"
    tried = {1.0: Trial(f"the best {what}", best.design)}
    workshop.evaluate([tried[1.0]], fineness)
    factors = list(LARGER) if best.design.risers else []
    while not any(trial.sound() for trial in tried.values()) and factors and len(tried) < most:
        batch = {factor: Trial(f"risers x {factor:g} {what}", best.design.scaled(factor))
                 for factor in factors[:min(jobs, 2, most - len(tried))]}
        factors = factors[len(batch):]
        workshop.evaluate(list(batch.values()), fineness)
        tried.update(batch)
    # One more between the largest that is not sound and the smallest that is, where they are far apart.
    sound = min((factor for factor, trial in tried.items() if trial.sound()), default=None)
    below = max((factor for factor in tried if sound is not None and factor < sound), default=None)
    if below is not None and sound / below > CLOSE ** 2 and len(tried) < most:
        between = (sound * below) ** 0.5
        tried[between] = Trial(f"risers x {between:.3g} {what}", best.design.scaled(between))
        workshop.evaluate([tried[between]], fineness)
    return min((trial for trial in tried.values() if trial.sound()), key=lambda trial: trial.design.metal(), default=None)


def write_results(workshop, folder, options, chosen, best):
    header, rows = table(workshop)
    write_csv(folder / "design.csv", header, rows)
    document = {"part": str(options.part), "chosen": None if chosen is None else workshop.folder_of(chosen).name,
                "best_on_the_coarse_mesh": None if best is None else workshop.folder_of(best).name,
                "runs": [{**dict(zip(header, cells)), **asdict(row["trial"].design)}
                         for row, cells in zip(workshop.rows, rows)]}
    (folder / "design.json").write_text(json.dumps(document, indent=2) + "\n")
    style.setup()
    design_plots.draw(workshop.rows, chosen, folder / "design.png")
    return as_text([header[0], *header[5:11]], [[row[0], *row[5:11]] for row in rows])


def new_words(options):
    """What `solidus new` is told of the part; a case gives what it was made of. Throws ResultError."""
    part, alloy, process = Path(options.part), options.alloy, options.process
    words = []
    case = part / "case.toml" if part.is_dir() else part
    if case.suffix == ".toml":
        try:
            document = tomllib.loads(case.read_text(encoding="utf-8-sig"))
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise ResultError(f"{case}: not a case file ({error})") from None
        mesh, bodies = document.get("mesh", {}), document.get("body", [])
        if "file" not in mesh:
            raise ResultError(f"{case}: the mesh of the case is of no file; a case made of a STEP file is needed")
        part = case.parent / mesh["file"]
        cast = next((body for body in bodies if body.get("role") == "casting"), None)
        if cast is None:
            raise ResultError(f"{case}: no body has the role \"casting\"")
        alloy = alloy or cast["material"]
        if not process:
            process = document.get("title", "").rpartition(", ")[2]
            if process not in ("sand", "shell", "gravity_die", "high_pressure"):
                raise ResultError(f"{case}: its title does not say by which process it is cast; --process does")
        words += ["--unit", mesh["unit"]] if "unit" in mesh else []
        words += ["--symmetry", mesh["symmetry"]["axis"]] if "symmetry" in mesh else []
    process = process or "sand"
    if process == "high_pressure":
        raise ResultError("under high pressure a casting is fed by its gate, not by risers; sand, shell and gravity_die have "
                          "risers")
    if not alloy:
        raise ResultError("what is cast? --alloy NAME, of those that `solidus materials` lists")
    for name in ("unit", "symmetry"):
        words += [f"--{name}", getattr(options, name)] if getattr(options, name) else []
    for one in getattr(options, "as"):
        words += ["--as", one]
    return part, ["--alloy", alloy, "--process", process, *words]


def share(text, name, most):
    """A percentage as a share. Throws ResultError."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value <= most:
        raise ResultError(f"--{name} is a percentage above 0 and at most {most:g}, not '{text}'")
    return value / 100


def parser():
    made = argparse.ArgumentParser(prog="solidus design", description=__doc__.splitlines()[0])
    made.add_argument("part", metavar="PART")
    made.add_argument("--as", action="append", default=[])
    for name in ("alloy", "process", "symmetry", "unit", "output", "jobs", "runs", "pores", "holes", "fineness"):
        made.add_argument(f"--{name}", default="")
    made.add_argument("--results-root", type=Path, default=Path("."))
    for name in ("restart", "no-sleeves"):
        made.add_argument(f"--{name}", action="store_true")
    return made


def run(options):
    """The exit code."""
    jobs = jobs_from(options.jobs)
    if options.runs and not (options.runs.isdigit() and CHECKS + 2 <= int(options.runs) <= 200):
        raise ResultError(f"--runs is a whole number from {CHECKS + 2} to 200, not '{options.runs}'")
    most = int(options.runs or MOST_RUNS)
    limits = Limits(share(options.holes or "0.01", "holes", 10), share(options.pores or "1", "pores", 50), 0.1)
    try:
        fineness = float(options.fineness or COARSE)
    except ValueError:
        fineness = 0.0
    if not 0.3 <= fineness <= 2.5:
        raise ResultError(f"--fineness is a number from 0.3 to 2.5, not '{options.fineness}'")
    part, words = new_words(options)
    folder = Path(options.output) if options.output else options.results_root / "results" / part.stem / "design"
    if (folder / "case").exists() and not (folder / "first_guess" / RECORD).exists():
        raise ResultError(f"{folder} holds a case that is not of an earlier search; -o names another folder")
    workshop = Workshop(part, words, folder, jobs, limits, options.restart)
    start = time.monotonic()
    print(f"{part.name}: at most {most} runs, {jobs} at a time, in {folder}", flush=True)
    workshop.new_case(folder / "first_guess", fineness, "--riser", "auto")
    risers = chosen_risers(folder / "first_guess" / "case.toml")

    def surface():
        first = next(row for row in workshop.rows if row["trial"].judgement is not None)
        grid = read_fields(read_collection(first["folder"] / "fields.pvd")[1][-1])
        summary = json.loads((first["folder"] / "summary.json").read_text())
        answers, bodies = summary["answers"]["castings"], list(summary["mesh"]["bodies"])
        return Surface(grid, [bodies.index(name) for name, a in answers.items() if not a["riser"] and not a["gating"]])

    try:
        search = Search(lambda trials: workshop.evaluate(trials, fineness), lambda place: surface()(place), jobs, most - CHECKS,
                        lambda *where: surface().beside(*where))
        best = search.run(risers, not options.no_sleeves)
        chosen = None if best is None else checked(workshop, best, most - len(search.trials), 2 * fineness, jobs)
    except Interrupted:
        print("solidus design: stopped; what has ended is kept, --restart goes on", file=sys.stderr)
        return INTERRUPTED
    text = write_results(workshop, folder, options, chosen, best)
    print(f"\n{text}\n")
    return conclude(workshop, folder, part, chosen, best, time.monotonic() - start)


def conclude(workshop, folder, part, chosen, best, seconds):
    """Says what was found and leaves the case and the solids of the risers; the exit code."""
    tried = f"{len(workshop.rows)} runs in {seconds:.0f} s; table and picture in {folder}"
    if best is None:
        print(f"No design was sound: see the reasons in the table.\n{tried}")
        return 1
    if chosen is None:
        print(f"The best design on the coarse mesh, {best.design.text()}, is not sound on the finer one, and larger risers are "
              f"not either.\n{tried}")
        return 1
    if not chosen.design.risers and not chosen.design.chills:
        print(f"{part.name} is sound without any riser, on a mesh of half the size too.\n{tried}")
        return 0
    case = folder / "case"
    workshop.final_case(case, chosen.design, workshop.fineness_of(chosen))
    judged = chosen.judgement
    print(f"{chosen.design.text()}\n{1e-3 * chosen.design.metal():.4g} cm3 of risers on {1e6 * judged.part:.4g} cm3 of part: a "
          f"yield of {100 * judged.part / judged.metal:.0f} %; sound on a mesh of half the size too\n"
          f"{case} runs; its solids are in {case / 'risers.step'}\n{tried}")
    return 0


def main(given=None):
    options = parser().parse_args(given)
    try:
        return run(options)
    except (ResultError, OSError) as error:
        print(f"solidus design: {sentence(error)}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
