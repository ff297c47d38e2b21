#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which coupling scheme is stable, and how accurate, at which coupling and step: the tables of docs/verification/thick_cylinder.md.

usage: schemes.py [--program FILE] [--folder DIR] stability    runs the elastic wall by every scheme, expansion and step: some minutes
       schemes.py [--folder DIR] inertia                       reads the history.csv of all variants with inertia (README.md runs them)

Stability: the largest differences in temperature and displacement, every 50 s, to the simultaneous scheme of the same form extrapolated to vanishing
steps, and the defect of the first law over the heat exchanged. Inertia: the differences to the simultaneous scheme with the same step at the end.
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
ENERGY = ['coupling.structural_heating="energy"', "coupling.as_printed=false"]
# row of the table: the variant it starts from, what is set besides, whether its limit is that of the energy form
SCHEMES = {
    "simultaneous": ("simultaneous", [], False),
    "simultaneous, energy form": ("simultaneous_energy", [], True),
    "block-iterative": ("block_iterative", [], False),
    "isentropic": ("isentropic", [], False),
    "isentropic, energy form": ("isentropic_energy", [], True),
    "isentropic double pass, energy form": ("isentropic_double_pass", [], True),
    "isothermal, literal": ("isothermal", [], False),
    "isothermal, collapsed": ("isothermal_collapsed", [], False),
    "isothermal, temperature form": ("isothermal_temperature", [], False),
    "isothermal, energy form": ("isothermal", ENERGY, True),
}


def columns(file):
    with open(file, newline="") as lines:
        rows = list(csv.DictReader(lines))
    return [{key: float(value) for key, value in row.items()} for row in rows]


def run(options, scheme, factor, step):
    """History of a run (as far as it came), and the reason why it stopped, or nothing."""
    variant, more, _ = SCHEMES[scheme]
    folder = options.folder / "stability" / f"x{factor}_{step:g}_{scheme.replace(', ', '_').replace(' ', '_')}"
    settings = [f'time.step="{step:g} s"', f'time.min_step="{step:g} s"', 'output.every="1000 s"',
                f'body.wall.material="{HERE}/materials/te_x{factor}.toml"'] + more
    command = [options.program, "run", f"{HERE}:te_x1_{variant}", "-o", folder]
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
        return f"stops in step {len(history)}"  # its first row is the initial state
    last = history[-1]
    defect = abs(last["energy_defect[J]"]) / last["heat_exchanged[J]"]
    return f"{largest(history, reference, T):.2g} K, {largest(history, reference, U):.1g} mm, {defect:.0e}"


def stability(options):
    for factor in FACTORS:
        limits = {energy: limit(options, "simultaneous, energy form" if energy else "simultaneous", factor) for energy in (False, True)}
        print(f"\n### alpha x {factor}\n\n| | {' | '.join(f'{step:g} s' for step in STEPS)} |\n|---|{'---|' * len(STEPS)}")
        for scheme, (_, _, energy) in SCHEMES.items():
            cells = [cell(*run(options, scheme, factor, step), limits[energy]) for step in STEPS]
            print(f"| {scheme} | {' | '.join(cells)} |", flush=True)


def against_simultaneous(options, problem, scheme):
    """A run with inertia compared with the simultaneous one at its end, and how much L rose in the worst step."""
    rows, whole = (columns(options.folder / f"dyn_{problem}_{name}" / "history.csv") for name in (scheme, "simultaneous"))
    rise = max(row["lyapunov_mechanical[J]"] + row["lyapunov_thermal[J]"] for row in rows[1:])
    end = f"stops in step {len(rows)}"
    if len(rows) == len(whole):
        u, t = (max(abs(rows[-1][key] - whole[-1][key]) for key in keys) for keys in (U, T))
        end = f"{u:.1g} mm, {t:.2g} K"
    return end + (f", L +{rise:.2g} J" if rise > 0 else "")


def inertia(options):
    runs = [(law, scheme) for law in ("te", "tp") for scheme in ("isentropic", "isothermal")]
    print(f"| | {' | '.join(f'{law}, {scheme}' for law, scheme in runs)} |\n|---|{'---|' * len(runs)}")
    for method in ("be", "newmark", "trapezoidal"):
        for factor in FACTORS:
            cells = [against_simultaneous(options, f"{law}_x{factor}_{method}", scheme) for law, scheme in runs]
            print(f"| {method}, alpha x {factor} | {' | '.join(cells)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=["stability", "inertia"])
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/solidus")
    parser.add_argument("--folder", type=Path, default=ROOT / "results/thick_cylinder")
    options = parser.parse_args()
    {"stability": stability, "inertia": inertia}[options.table](options)


if __name__ == "__main__":
    main()
