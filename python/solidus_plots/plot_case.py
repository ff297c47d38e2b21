"""Draws the results of a run: python3 -m solidus_plots RESULTS_DIR.

Every case gets curves of history.csv by unit, one picture of its steps and an overview of each field that matters
(automatic.py). What else is drawn is listed in the `plots.toml` next to the case file; docs/guide/plots.md describes it. Pictures go to RESULTS_DIR/plots.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
import json
import os
from pathlib import Path
import sys

from solidus_plots import automatic, curves, fields, graphs, maps, measured, overview, point, sections, style, surfaces, xray
from solidus_plots.history import read_table
from solidus_plots.moments import Moments
from solidus_plots.plots_file import Mistake, find_spec, read_spec, star
from solidus_plots.probes import read_points
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError, read_collection

# Pictures of fields and what draws them.
FIELD_PICTURES = {"maps": maps.field_maps, "deformed": maps.deformed_mesh, "sections": sections.draw,
                  "surfaces": surfaces.draw}
# Those that every run gets.
OVERVIEWS = {"overview": overview.draw, "xray": xray.draw}


def histories(compare, part, results):
    """The histories to lay over those of `results`, where they are there, by their labels."""
    found = {}
    for entry in compare:
        entry = entry if isinstance(entry, dict) else {"variant": entry}
        variant = entry["variant"].replace("*", part)
        file = results.resolve().parent / variant / "history.csv"
        if variant != results.resolve().name and file.exists():
            found[entry.get("label", variant)] = read_table(file)
    return found


def draw(results, spec_file=None):
    """Draws everything; returns the files written and what could not be drawn."""
    style.setup()
    summary_file = results / "summary.json"
    summary = json.loads(summary_file.read_text()) if summary_file.exists() else {}
    if summary.get("kind") == "point":
        return point.draw(results, summary)
    spec_file = spec_file or find_spec(results, summary)
    spec, problems = read_spec(spec_file) if spec_file else ({}, [])
    wishes = spec.pop("automatic", {})
    variant = summary.get("variant") or results.resolve().name
    spec = {section: [picture for picture in pictures
                      if star(picture.get("only", [variant]), variant) is not None]
            for section, pictures in spec.items()}
    folder = results / "plots"
    folder.mkdir(exist_ok=True)
    history = read_table(results / "history.csv")
    files = curves.unit_groups(history, folder)
    if (results / "steps.csv").exists():
        files += curves.steps(read_table(results / "steps.csv"), folder)

    def attempt(work, *arguments):
        # One picture that cannot be drawn (a run that stopped early) must not cost the others.
        try:
            files.extend(work(*arguments, folder))
        except (ResultError, ValueError) as error:
            problems.append(str(error))

    for picture in spec.get("curves", []):
        part = star(picture.get("only", [variant]), variant)
        attempt(curves.chosen, picture, history, histories(picture.get("compare", []), part, results))
    for picture in spec.get("graphs", []):
        attempt(graphs.draw, picture, results)
    for picture in spec.get("measured", []):
        attempt(measured.draw, picture, results, spec_file)
    if (results / "fields.pvd").exists() or any(spec.get(kind) for kind in FIELD_PICTURES):
        attempt(lambda _: draw_fields(spec, wishes, results, summary, history, folder, problems))
    return files, problems


def draw_fields(spec, wishes, results, summary, history, folder, problems):
    """The pictures of fields, those that plots.toml asks for and those that every run gets; files written."""
    tasks = [(kind, picture) for kind in FIELD_PICTURES for picture in spec.get(kind, [])]
    times, written = read_collection(results / "fields.pvd")
    fields.declare(summary)
    run = Moments(times, written, list(summary.get("mesh", {}).get("bodies", {})),
                  read_points(results / "case.toml"),
                  {stage["name"]: stage["end[s]"] for stage in summary.get("answers", {}).get("stages", [])})
    case, sheets = None, []
    if wishes.get("draw", True) and len(times):
        case, sheets = automatic.plan(run, times, summary, history, results, wishes)
        tasks += [(sheet.get("kind", "overview"), sheet) for sheet in sheets]
    files = []
    if not tasks:
        return files
    for drawn, missing in _draw_all(tasks, run, case, folder):
        files += drawn
        problems += [problem for problem in missing if problem not in problems]
    return files


def _draw_all(tasks, *what):
    """The result of each task: on all cores, or one after the other where the system has no semaphores, as in a
    container without /dev/shm."""
    try:
        pool = ProcessPoolExecutor(min(len(tasks), len(os.sched_getaffinity(0))), initializer=_begin, initargs=what)
    except OSError:
        _begin(*what)
        return [_draw_field(task) for task in tasks]
    with pool:
        return list(pool.map(_draw_field, tasks))


def _begin(run, case, folder):
    """A process that draws pictures of fields keeps the moments that it has read."""
    global _run, _case, _folder
    _run, _case, _folder = run, case, folder
    style.setup()


def _draw_field(task):
    """The files of one picture, and why it is not drawn or lacks moments."""
    kind, picture = task
    _run.missing.clear()
    try:
        if kind in OVERVIEWS:
            return OVERVIEWS[kind](picture, _run, _case, _folder), list(_run.missing)
        return FIELD_PICTURES[kind](picture, _run, _folder), list(_run.missing)
    except (ResultError, ValueError) as error:
        return [], [*_run.missing, str(error)]


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus_plots", description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR")
    parser.add_argument("--plots", type=Path, metavar="FILE", help="a plots.toml other than the case's own")
    options = parser.parse_args(arguments)
    if not any((options.results / name).is_file() for name in ("history.csv", "summary.json")):
        missing = "the folder has no results" if options.results.is_dir() else "there is no such folder"
        print(f"solidus_plots: {options.results}: {missing}; the folder that `solidus run` names at its end, for example"
              " results/CASE/default", file=sys.stderr)
        return 1
    try:
        files, problems = draw(options.results, options.plots)
    except (ResultError, OSError) as error:
        print(f"solidus_plots: {sentence(error)}", file=sys.stderr)
        return 1
    for file in files:
        print(file)
    for problem in problems:
        print(f"solidus_plots: not drawn: {problem}", file=sys.stderr)
    return 1 if any(isinstance(problem, Mistake) for problem in problems) else 0
