"""How far the answers of a case may be off because its data are: python3 -m solidus_plots.uncertain CASE, as `solidus
uncertain` does.

One run of the case as it is, one for each parameter that is uncertain, moved to the end of its range, and the other end of
those that make most of the spread: never more than --runs. With --samples a Latin hypercube instead.
docs/guide/uncertain.md describes what comes out, docs/theory/uncertainty.md the equations.
"""

import argparse
from dataclasses import asdict
import json
from pathlib import Path
import subprocess
import sys
import time

from solidus_plots import style, uncertain_plots, uncertain_samples
from solidus_plots.compare import write_csv
from solidus_plots.many_runs import INTERRUPTED, Runner, how_it_ended, jobs_from, program
from solidus_plots.uncertain_parameters import merged, parameter_of
from solidus_plots.uncertain_result import answers_of_run, bands_of_run, evaluate, line, rounded, worth_the_other_side
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError

MOST_RUNS = 20


def listed(case, words):
    """The parameters of a case, what it cannot vary, and its title. The case is checked. Throws ResultError."""
    asked = subprocess.run([program(), "uncertain", case, *words, "--parameters", "--log", "warn"], capture_output=True,
                           text=True, stdin=subprocess.DEVNULL)
    if asked.returncode != 0:
        raise ResultError(asked.stderr.strip().removeprefix("solidus: "))
    if asked.stderr.strip():
        print(asked.stderr.strip(), file=sys.stderr)
    answer = json.loads(asked.stdout)
    return [parameter_of(entry) for entry in answer["parameters"]], answer["not_varied"], answer["title"]


def set_words(changes):
    return [word for change in changes for word in ("--set", change)]


def table_of(parameters):
    """What is varied, for people."""
    origin = {"stated": "in print", "estimate": "estimate", "usual": "usual, none is stated"}
    rows = [("", "what is uncertain", "±, 95 %", "spread")]
    for number, parameter in enumerate(parameters):
        rows.append((str(number + 1), parameter.label, parameter.spread, "" if parameter.members else origin[parameter.origin]))
        rows += [("", f"  {member.label}", member.spread, origin[member.origin]) for member in parameter.members]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    return "\n".join(f"{row[0]:>{widths[0]}}  {row[1]:{widths[1]}}  {row[2]:{widths[2]}}  {row[3]}".rstrip() for row in rows)


def remarks(parameters, left_out, not_varied):
    """What the reader must know of the parameters."""
    flat = [member for parameter in parameters for member in (parameter.members or [parameter])]
    usual = [member for member in flat if member.origin == "usual"]
    lines = [f"no spread is stated for the {member.label}: {member.spread} taken" for member in usual]
    lines += [f"moved together, to keep to the number of runs: {', '.join(member.label for member in parameter.members)}"
              for parameter in parameters if parameter.members]
    if left_out:
        lines.append(f"left out, to keep to the number of runs: {', '.join(parameter.label for parameter in left_out)}")
    if not_varied:
        lines += [f"not varied: {what}" for what in not_varied]
    return lines


class Sweep:
    """The runs of one case, each with some parameter moved."""

    def __init__(self, options, words, folder, jobs):
        self._runner = Runner(options.case, options.restart)
        self._words, self._folder, self._jobs = words, folder, jobs
        self.failed, self.runs = [], 0

    def run(self, wanted, count):
        """[answers of a run, or nothing where it failed]; nothing at all after Ctrl-C.

        wanted: [(name of the folder, what is moved in words, changes)]; count: of all runs, for the lines.
        """
        jobs = [(self._folder / name, [*self._words, *set_words(changes)]) for name, _, changes in wanted]
        first = self.runs

        def announce(number, record):
            print(f"  {first + number + 1}/{count}  {wanted[number][1]}: {how_it_ended(record)}", flush=True)

        records = self._runner.run_all(jobs, self._jobs, announce)
        if records is None:
            return None
        self.runs += len(wanted)
        self.failed += [f"{what}: {record['reason']}" for (_, what, _), record in zip(wanted, records) if record["code"]]
        return [answers_of_run(folder) if record["code"] == 0 else None for (folder, _), record in zip(jobs, records)]


def moved(number, parameter, up):
    end = "up" if up else "down"
    return (f"{number + 1:02d}_{parameter.slug()}_{end}", f"{parameter.label}, {end}", parameter.changes(1 if up else -1))


def first_order(sweep, parameters, most, one_sided, folder):
    """The answers with their spreads; nothing after Ctrl-C."""
    count = 1 + len(parameters)
    done = sweep.run([("best", "as it is", []),
                      *(moved(number, parameter, True) for number, parameter in enumerate(parameters))], count)
    if done is None:
        return None
    best, ups = done[0], done[1:]
    if best is None:
        raise ResultError(f"the case itself does not run: {sweep.failed[0]}")
    downs, band = [None] * len(parameters), bands_of_run(folder / "best")
    found = evaluate(best, band, parameters, ups, downs)
    chosen = [] if one_sided else worth_the_other_side(found, parameters, most - count)
    if chosen:
        others = sweep.run([moved(number, parameters[number], False) for number in chosen], count + len(chosen))
        if others is None:
            return None
        for number, other in zip(chosen, others):
            downs[number] = other if other is not None else {}
        found = evaluate(best, band, parameters, ups, downs)
    return found


def write_results(folder, title, parameters, found, said):
    header = ["answer", "unit", "value", "plus minus", "parameter", "part", "at the upper end", "at the lower end", "bend"]
    rows = [[answer.name, answer.unit, answer.best, answer.spread(), part.label, part.spread(), part.up, part.down,
             part.bend if part.down is not None else None] for answer in found for part in answer.parts]
    write_csv(folder / "uncertain.csv", header, rows)
    document = {"title": title, "coverage": 0.95, "remarks": said,
                "parameters": [asdict(parameter) for parameter in parameters],
                "answers": [{"name": answer.name, "unit": answer.unit, "value": answer.best,
                             "plus_minus": answer.spread(), "step_and_mesh": answer.band,
                             "jumps": answer.jumps(), "incomplete": answer.incomplete,
                             "parts": [{**asdict(part), "plus_minus": part.spread()} for part in answer.parts]}
                            for answer in found]}
    (folder / "uncertain.json").write_text(json.dumps(document, indent=2) + "\n")


def answer_lines(found):
    """One line an answer, and what has to be said of them."""
    width = max(len(answer.name) for answer in found)
    lines = [f"  {answer.name:{width}}  {line(answer)}" for answer in found]
    jumping = [answer.name for answer in found if answer.jumps()]
    if jumping:
        lines.append(f"about as much by whatever is moved, so by steps and mesh more than by data: {', '.join(jumping)}")
    for answer in found:
        if answer.jumps():
            continue
        ends = [f"{part.label} ({rounded(part.down, answer.spread())} at its lower end, {rounded(part.up, answer.spread())} at "
                "its upper)" for part in answer.bent_parts()]
        if ends:
            lines.append(f"{answer.name}: not in proportion to {', '.join(ends)}")
    for answer in found:
        if answer.incomplete:
            lines.append(f"{answer.name}: without {', '.join(answer.incomplete)}, whose run failed or has no such answer")
    if all(answer.band is None for answer in found):
        lines.append("step and mesh are not in these numbers: the run states no error of its own")
    return lines


def report(options, folder, title, parameters, found, said, sweep, start):
    write_results(folder, title, parameters, found, said)
    if not found:
        print("No answer changes with any of the parameters.")
        return
    print(f"\n{title}: answers, ± what holds 95 % (two standard deviations), in brackets the part of each\n")
    print("\n".join(answer_lines(found)))
    style.setup()
    files = uncertain_plots.draw(title, found, folder)
    failed = f", {len(sweep.failed)} failed" if sweep.failed else ""
    print(f"\n{sweep.runs} runs{failed}, in {time.monotonic() - start:.0f} s; uncertain.csv, uncertain.json and "
          f"{len(files)} picture{'s' if len(files) > 1 else ''} in {folder}")


def whole(text, name, least):
    if not (text.isdigit() and int(text) >= least):
        raise ResultError(f"--{name} is a whole number, {least} at least, not '{text}'")
    return int(text)


def usual_folder(case):
    """results/CASE/uncertain, with the name of a variant or of a file that is not case.toml behind it."""
    path, _, variant = case.rpartition(":") if not Path(case).exists() else (case, "", "")
    place = Path(path).resolve()
    folder, stem = (place, "case") if place.is_dir() else (place.parent, place.stem)
    of = [name for name in (stem if stem != "case" else "", variant) if name]
    return Path("results") / folder.name / "_".join(["uncertain", *of])


def case_words(options):
    """What goes to every run as it was given."""
    return [*set_words(options.set), *(["--heat-only"] if options.heat_only else []),
            *(["--trust-geo"] if options.trust_geo else [])]


def parser():
    made = argparse.ArgumentParser(prog="solidus uncertain", description=__doc__.splitlines()[0])
    made.add_argument("case", metavar="CASE")
    made.add_argument("--set", action="append", default=[])
    for name in ("output", "jobs", "runs", "samples", "seed"):
        made.add_argument(f"--{name}", default="")
    made.add_argument("--results-root", type=Path, default=Path("."))
    for name in ("heat-only", "trust-geo", "restart", "dry-run", "one-sided"):
        made.add_argument(f"--{name}", action="store_true")
    return made


def run(options):
    """The exit code."""
    jobs = jobs_from(options.jobs)
    most = whole(options.runs or str(MOST_RUNS), "runs", 2)
    samples = whole(options.samples, "samples", 3) if options.samples else 0
    if samples and (options.runs or options.one_sided):
        raise ResultError("--runs and --one-sided belong to the first order; with --samples that is the number of runs")
    if options.seed and not samples:
        raise ResultError("--seed belongs to --samples")
    seed = whole(options.seed or "1", "seed", 0)
    words = case_words(options)
    parameters, not_varied, title = listed(options.case, words)
    left_out = []
    if not samples:
        parameters, left_out = merged(parameters, most - 1)
    if not parameters:
        raise ResultError(f"{options.case}: every spread is zero, so nothing is uncertain")
    said = remarks(parameters, left_out, not_varied)
    print(table_of(parameters))
    print("".join(f"{one}\n" for one in said), end="")
    if options.dry_run:
        return 0
    folder = Path(options.output) if options.output else options.results_root / usual_folder(options.case)
    start, sweep = time.monotonic(), Sweep(options, words, folder, jobs)
    count = f"{samples} runs" if samples else f"at most {most} runs" if not options.one_sided else \
        f"{1 + len(parameters)} runs"
    print(f"\n{title}: {count}, {jobs} at a time, in {folder}")
    if samples:
        done = uncertain_samples.run(sweep, title, parameters, samples, seed, folder, said)
        if done is not None:
            print(f"\n{samples} runs, {len(sweep.failed)} failed, in {time.monotonic() - start:.0f} s; {done} in {folder}")
    else:
        done = first_order(sweep, parameters, most, options.one_sided, folder)
        if done is not None:
            report(options, folder, title, parameters, done, said, sweep, start)
    if done is None:
        print("solidus uncertain: stopped; what has ended is kept, --restart goes on", file=sys.stderr)
        return INTERRUPTED
    return 0


def main(given=None):
    options = parser().parse_args(given)
    try:
        return run(options)
    except (ResultError, OSError) as error:
        print(f"solidus uncertain: {sentence(error)}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
