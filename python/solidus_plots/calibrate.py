"""Finds what of a case is unknown from measurements: python3 -m solidus_plots.calibrate CASE MEASURED.csv, as `solidus
calibrate` does.

calibrate.toml next to the case says what is unknown. docs/guide/calibrate.md describes the file and what comes out,
docs/theory/calibration.md the equations.
"""

import argparse
import json
import os
from pathlib import Path
import subprocess
import sys
import time

import numpy as np

from solidus_plots import calibrate_plots, calibrate_result, style
from solidus_plots.calibrate_file import read_calibration
from solidus_plots.calibrate_fit import Search, fit
from solidus_plots.calibrate_model import Model, deforms, probes_of, resolved_case, why_differences
from solidus_plots.calibrate_readings import read_readings
from solidus_plots.calibrate_statistics import evaluate
from solidus_plots.history import Table
from solidus_plots.logger_table import SECONDS
from solidus_plots.many_runs import INTERRUPTED, jobs_from, program
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError

SAME_WEIGHTS = 0.1  # change of the residuals' spread, over itself, with which priors keep their weight
RUNS, FURTHER_RUNS = 15, 4  # at most; and for each unknown where derivatives are differences
REWEIGHTED = 3  # times at most


def resolve(case, words):
    """The case with its defaults. Throws ResultError as the program does."""
    asked = subprocess.run([program(), "resolve", case, *words, "--log", "warn"], capture_output=True, text=True,
                           stdin=subprocess.DEVNULL)
    if asked.returncode != 0:
        raise ResultError(asked.stderr.strip().removeprefix("solidus: "))
    return asked.stdout


def words_of(options, calibration):
    words = [word for assignment in [*options.set, *calibration.set] for word in ("--set", assignment)]
    return words + ["--heat-only"] * options.heat_only


def end_of(case):
    """Of the run [s]."""
    number, _, unit = str(case["time"].get("end", "")).partition(" ")
    if unit.strip() not in SECONDS:
        raise ResultError(f"the case ends at '{case['time'].get('end')}': say time.end in one of {', '.join(SECONDS)}")
    return float(number) * SECONDS[unit.strip()]


def find_materials(calibration, case):
    """Tells unknown properties of cards which material the case has there."""
    bodies = {body["name"]: body for body in case.get("body", [])}
    for unknown in calibration.unknowns:
        if unknown.kind != "card":
            continue
        name = unknown.key.removeprefix("body.").removesuffix(".material")
        if unknown.key != f"body.{name}.material" or name not in bodies:
            raise ResultError(f"{calibration.path}: [[unknown]] '{unknown.name}': 'key' is body.NAME.material with one of the "
                              f"bodies {', '.join(bodies)}, not '{unknown.key}'")
        unknown.material = bodies[name]["material"]


def place_probes(calibration, case):
    """Tells unknown places of probes where the case has them."""
    probes = {probe["name"]: probe for probe in case.get("probe", [])}
    for unknown in calibration.unknowns:
        if unknown.kind != "place":
            continue
        if "point" not in probes.get(unknown.probe, {}):
            raise ResultError(f"{calibration.path}: [[unknown]] '{unknown.name}': the case has no probe '{unknown.probe}' at a "
                              f"point; it has {', '.join(probes)}")
        unknown.place = probes[unknown.probe]["point"]
        if len(unknown.direction) != len(unknown.place):
            raise ResultError(f"{calibration.path}: [[unknown]] '{unknown.name}': 'direction' has {len(unknown.place)} numbers")


def check_names(calibration, readings):
    names = {r.name for r in readings}
    for unknown in calibration.unknowns:
        for name in unknown.observations:
            if name not in names:
                raise ResultError(f"{calibration.path}: [[unknown]] '{unknown.name}': there is no observation '{name}'; there "
                                  f"are {', '.join(sorted(names))}")


def check_amount(calibration, readings):
    """Throws ResultError for too few readings, and for units that cannot be weighed against each other."""
    parameters = calibration.parameters()
    count = sum(len(r.values) for r in readings)
    known = sum(p.prior is not None for p in parameters)
    if count + known <= len(parameters):
        raise ResultError(f"{calibration.path}: {count} readings and {known} priors do not tell {len(parameters)} unknowns: "
                          "more readings than unknowns are needed")
    units = {Table.unit(r.header) for r in readings}
    if len(units) > 1 and any(r.noise is None for r in readings):
        raise ResultError(f"{calibration.path}: observations in {', '.join(sorted(units))} are weighed by their noise: every "
                          "[[observation]] needs 'noise'")


def rough_start(model, measured, sigma, calibration, say):
    """Where the search ends with runs that cost little: a start that lies near."""
    say("the search begins with coarse runs: " + ", ".join(calibration.coarse))
    search = Search(model, measured, sigma, calibration.runs, say)
    found = fit(search, calibration.loss, calibration.loss_scale, rough=True)
    say("the case itself follows, from " + ", ".join(f"{p.name} {value:.4g}" for p, value in zip(model.parameters, found.theta)))
    return search.scaled(found.theta)


def processor_seconds():
    """Of all runs that have ended."""
    times = os.times()
    return times.children_user + times.children_system


def check_coarse(case_name, words, calibration, case, readings, forward):
    """The words of coarse runs. Throws ResultError where such a run has not what the fit needs of it."""
    coarser = words + [word for assignment in calibration.coarse for word in ("--set", assignment)]
    coarse = resolved_case(resolve(case_name, coarser))
    place = f"{calibration.path}: 'coarse'"
    if end_of(coarse) != end_of(case) or set(probes_of(coarse)) != set(probes_of(case)):
        raise ResultError(f"{place}: coarse runs have the time.end and the probes of the case")
    reason = why_differences(coarse, readings) if forward else ""
    if reason:
        raise ResultError(f"{place}: coarse runs have no derivatives: {reason}")
    return coarser


def search_and_fit(model, readings, calibration, say, coarse=None):
    """The fit; where noise is not stated and there are priors, with the noise that the residuals have.

    coarse: a model whose runs cost little, with which the search begins.
    """
    measured = np.concatenate([r.values for r in readings])
    stated = all(r.noise is not None for r in readings)
    sigma = np.concatenate([np.full(len(r.values), r.noise or 1.0) for r in readings])
    start = None if coarse is None else rough_start(coarse, measured, sigma, calibration, say)
    search = Search(model, measured, sigma, calibration.runs, say)
    found = fit(search, calibration.loss, calibration.loss_scale, start=start)
    priors = any(p.prior is not None for p in calibration.parameters())
    for _ in range(REWEIGHTED if priors and not stated else 0):
        scale = evaluate(found, calibration.parameters(), readings, calibration.confidence).scale
        if abs(scale - 1) <= SAME_WEIGHTS or scale == 0:
            break
        search.sigma = search.sigma * scale
        found = fit(search, calibration.loss, calibration.loss_scale, start=search.scaled(found.theta))
    return found


def calibrate(options, say):
    """Throws ResultError."""
    file = options.unknowns or (Path(options.case) if Path(options.case).is_dir() else Path(options.case.partition(":")[0]).parent
                                ) / "calibrate.toml"
    calibration = read_calibration(file)
    words, jobs = words_of(options, calibration), jobs_from(options.jobs)
    case = resolved_case(resolve(options.case, words))
    headers = probes_of(case)
    readings = read_readings(calibration, options.measured, headers, end_of(case), say)
    place_probes(calibration, case)
    find_materials(calibration, case)
    check_names(calibration, readings)
    check_amount(calibration, readings)
    reason = why_differences(case, readings)
    if reason and calibration.derivatives == "forward":
        raise ResultError(f"{calibration.path}: derivatives = \"forward\": {reason}")
    forward = not reason and calibration.derivatives != "differences"
    count = sum(len(r.values) for r in readings)
    say(f"{len(calibration.parameters())} unknowns, {count} readings of {len(readings)} observations; derivatives by "
        + ("forward differentiation" if forward else f"differences of runs, {jobs} at a time" + (f": {reason}" if reason else "")))
    if case.get("time", {}).get("adaptive"):
        say("steps that follow their errors make runs jump against each other where the unknowns move: --set "
            "time.adaptive=false, with a time.step that is short enough")
    if calibration.runs is None:
        calibration.runs = RUNS if forward else RUNS + FURTHER_RUNS * len(calibration.parameters())
    name = Path(case_folder(options.case)).name
    folder = options.output or options.results_root / "results" / name / "calibrate"
    folder.mkdir(parents=True, exist_ok=True)
    dear = forward and deforms(case)
    model = Model(options.case, words, calibration, readings, folder / "runs", jobs, forward, dear)
    coarse = None
    if calibration.coarse:
        coarser = check_coarse(options.case, words, calibration, case, readings, forward)
        coarse = Model(options.case, coarser, calibration, readings, folder / "coarse_runs", jobs, forward, dear)
    start, before = time.monotonic(), processor_seconds()
    found = search_and_fit(model, readings, calibration, say, coarse)
    statistics = evaluate(found, calibration.parameters(), readings, calibration.confidence)
    cost = {"runs": model.runs, "with_derivatives": model.with_derivatives,
            "coarse_runs": coarse.runs if coarse else 0, "seconds": round(time.monotonic() - start, 3),
            "processor_seconds": round(processor_seconds() - before, 3),
            "derivatives": "forward" if forward else "differences"}
    write(calibration, options, model, readings, found, statistics, cost, folder)
    say("")
    say(calibrate_result.text(statistics, found, calibration.confidence))
    outside = outside_text(model, readings, found.theta, end_of(case))
    if outside:
        say(outside)
    if not found.converged or found.message:
        say(f"  {'the search has not ended' if not found.converged else 'the search has ended'}: {found.message}")
    say(f"{model.runs} runs{f', {model.with_derivatives} of them with derivatives' if model.dear else ''}"
        f"{f', after {coarse.runs} coarse ones' if coarse else ''}, {cost['seconds']:.0f} s; results in {folder}")
    say(f"Next: solidus run {folder}/fitted.toml -o {folder}/fitted --report, whose report has the measured curves")


def outside_text(model, readings, theta, end):
    """How many readings the clock that was found puts before or behind the run; empty: none."""
    count = 0
    for series in readings:
        times = model.times(series, theta)
        count += int(np.count_nonzero((times < 0) | (times > end)))
    if count == 0:
        return ""
    return (f"  readings before or behind the run with the clock that was found: {count}; they are compared with its first or last "
            "values: leave them out ('until' of [logger]), or let the run last longer (time.end)")


def case_folder(case):
    path = Path(case.partition(":")[0]).resolve()
    return path if path.is_dir() else path.parent


def write(calibration, options, model, readings, found, statistics, cost, folder):
    document = calibrate_result.document(calibration, options.measured, readings, statistics, found, cost)
    (folder / "calibrate.json").write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n")
    calibrate_result.write_residuals(folder / "residuals.csv", readings, found)
    fitted = resolve(options.case, model.words_of(found.theta))
    (folder / "fitted.toml").write_text(fitted)
    card = calibrate_result.interface_card(resolved_case(fitted), calibration, options.measured, statistics)
    if card is not None:
        (folder / "interface.toml").write_text(card)
    style.setup()
    calibrate_plots.draw_residuals(readings, found, folder)
    calibrate_plots.draw_tables(calibration, statistics, folder)


def main(given=None):
    parser = argparse.ArgumentParser(prog="solidus calibrate", description=__doc__.splitlines()[0])
    parser.add_argument("case", metavar="CASE")
    parser.add_argument("measured", type=Path, metavar="MEASURED")
    parser.add_argument("--unknowns", type=Path)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--heat-only", action="store_true")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--results-root", type=Path, default=Path("."))
    parser.add_argument("--jobs", default="")
    options = parser.parse_args(given)
    try:
        calibrate(options, lambda text: print(text, flush=True))
    except (ResultError, OSError) as error:
        print(f"solidus calibrate: {sentence(error)}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("solidus calibrate: stopped", file=sys.stderr)
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main())
