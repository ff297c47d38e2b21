#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which coupling scheme is stable, and how accurate, at which coupling and step: the tables of docs/verification/thick_cylinder.md.

usage: schemes.py [--program FILE] [--folder DIR] stability    runs the elastic wall by every scheme, expansion and step: some minutes
       schemes.py [--folder DIR] outcomes                      of the variants that have been run (README.md), from their history.csv

The error of a run is its largest difference, at the times of the longest step, to the simultaneous scheme of the same form, extrapolated to
vanishing steps.
"""
import argparse
import csv
import os
from pathlib import Path
import re
import subprocess

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
U, T = ("u_inner[mm]", "u_outer[mm]"), ("T_inner[K]", "T_outer[K]")
END, COMMON = 1000.0, 50.0  # [s]; all steps but the longest meet the multiples of COMMON
FACTORS, STEPS = (1, 3, 6), (1.0, 10.0, 50.0, 1000.0)
SCHEMES = {"simultaneous": "simultaneous", "simultaneous_energy": "simultaneous, energy form", "isentropic": "isentropic",
           "isentropic_energy": "isentropic, energy form", "isentropic_double_pass": "isentropic double pass",
           "block_iterative": "block-iterative", "isothermal": "isothermal, literal", "isothermal_collapsed": "isothermal, collapsed",
           "isothermal_temperature": "isothermal, temperature form"}


def columns(file):
    with open(file, newline="") as lines:
        rows = list(csv.DictReader(lines))
    return [{key: float(value) for key, value in row.items()} for row in rows]


def run(options, scheme, factor, step):
    """History of a run (as far as it came), and the reason why it stopped, or nothing."""
    folder = options.folder / "stability" / f"x{factor}_{scheme}_{step:g}"
    settings = [f'time.step="{step:g} s"', f'time.min_step="{step:g} s"', 'output.every="1000 s"',
                f'body.wall.material="{HERE}/materials/te_x{factor}.toml"']
    command = [options.program, "run", HERE / f"te_x1_{scheme}.toml", "-o", folder]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode not in (0, 2):
        raise SystemExit(done.stderr)
    reason = re.search("reason: (.*)", done.stderr)
    return columns(folder / "history.csv"), reason.group(1) if done.returncode else ""


def limit(options, scheme, factor):
    """Rows at the common times for vanishing steps: the error of these schemes is of first order."""
    fine, finer = ({row["time[s]"]: row for row in run(options, scheme, factor, step)[0]} for step in (1.0, 0.5))
    times = [COMMON * (i + 1) for i in range(round(END / COMMON))]
    return {time: {key: 2 * finer[time][key] - fine[time][key] for key in U + T} for time in times}


def largest(rows, reference, keys):
    return max(abs(row[key] - reference[row["time[s]"]][key]) for row in rows if row["time[s]"] in reference for key in keys)


def cell(history, reason, reference):
    if reason:
        return f"stops in step {len(history) + 1}"
    last = history[-1]
    defect = abs(last["energy_defect[J]"]) / last["heat_exchanged[J]"]
    return f"{largest(history, reference, T):.2g} K, {largest(history, reference, U):.1g} mm, {defect:.0e}"


def stability(options):
    for factor in FACTORS:
        limits = {form: limit(options, "simultaneous" + form, factor) for form in ("", "_energy")}
        print(f"\n### alpha x {factor}\n\n| | {' | '.join(f'{step:g} s' for step in STEPS)} |\n|---|{'---|' * len(STEPS)}")
        for scheme, title in SCHEMES.items():
            reference = limits["_energy" if scheme.endswith("_energy") else ""]
            cells = [cell(*run(options, scheme, factor, step), reference) for step in STEPS]
            print(f"| {title} | {' | '.join(cells)} |", flush=True)


def outcomes(options):
    """Every variant beside the simultaneous one: how far it came, how far away it is at its end."""
    print("| variant | steps | largest T | | difference at the end: u | T | L rises at most |\n|---|---|---|---|---|---|---|")
    for folder in sorted(path.parent for path in options.folder.glob("*/history.csv")):
        rows = columns(folder / "history.csv")
        rises = max((row["lyapunov_mechanical[J]"] + row["lyapunov_thermal[J]"] for row in rows), default=0)
        temperatures = [row[key] for row in rows for key in T]
        stem = re.match(r"(t[ep]_x\d|dyn_t[ep]_x\d_[a-z]+)_", folder.name)
        reference = columns(options.folder / f"{stem.group(1)}_simultaneous" / "history.csv") if stem else rows
        there = {row["time[s]"]: row for row in reference}.get(rows[-1]["time[s]"], rows[-1])
        u, t = (max(abs(rows[-1][key] - there[key]) for key in keys) for keys in (U, T))
        print(f"| {folder.name} | {len(rows)} | {min(temperatures):.0f} to {max(temperatures):.0f} K | {u:.2g} mm | {t:.2g} K | {rises:.2g} J |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=["stability", "outcomes"])
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/solidus")
    parser.add_argument("--folder", type=Path, default=ROOT / "results/thick_cylinder")
    options = parser.parse_args()
    {"stability": stability, "outcomes": outcomes}[options.table](options)


if __name__ == "__main__":
    main()
