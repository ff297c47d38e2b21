"""How far the defaults are from converged answers: docs/verification/defaults.md.

Every case of `cases/` is run as it stands, with tolerances so small that they do not matter, and with steps (or
their error limits) a quarter as large besides. What is compared is what the case itself samples: its probes, at
the times of the run as it stands. Where steps adapt, smaller tolerances lead to other steps too.

    /usr/bin/python3 tests/defaults PROGRAM [-o docs/verification/defaults.md] [CASE ...]

With CASEs the rows of the others stay as the page has them, and so do its notes.
"""
import argparse
import bisect
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIGHT = {
    "mechanics": {"mechanics.tolerance": "1e-10", "mechanics.displacement_tolerance": "1e-7"},
    "heat": {"heat.tolerance": "1e-11"},
}
# What is run: physics, the keys that make its steps a quarter as long, and the variants that stand for the folder.
CASES = [
    ("two_blocks/case.toml", "both", {"time.step": "0.5 s"}),
    ("aluminium_cylinder/case.toml", "both", {"time.step": "0.25 s"}),
    ("aluminium_cylinder/plastic.toml", "both", {"time.step": "0.25 s"}),
    ("thick_cylinder/te_x1_isentropic_energy.toml", "both", {"time.step": "2.5 s", "time.min_step": "2.5 s"}),
    ("thick_cylinder/tp_x1_isentropic_energy.toml", "both", {"time.step": "2.5 s", "time.min_step": "2.5 s"}),
    ("hot_spots/case.toml", "heat", {"time.step": "0.5 s"}),
    ("billet_aa6060/case.toml", "heat", {"time.step": "0.25 s"}),
    ("billet_al6cu/case.toml", "heat", {"time.step": "0.5 s"}),
    ("sheet_sliding/ga_980.toml", "both", {"time.step": "0.25 s"}),
    ("bracket/case.toml", "both", {"time.temperature_error": "0.25 K"}),
    ("crankshaft/case.toml", "both", {"time.temperature_error": "2.5 K"}),
]
LIMIT = 1800  # [s] of a run


def run(program, case, folder, keys):
    command = [program, "run", str(ROOT / "cases" / case), "-o", str(folder)]
    for key, value in keys.items():
        command += ["--set", f"{key}={json.dumps(value) if not value[0].isdigit() or ' ' in value else value}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
    return done.returncode == 0, done.stderr[-400:]


def history(folder):
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(x) if x else math.nan for x in row] for row in rows[1:]]


def probes(folder):
    """Columns that the case asked for: those before the program's own; without any, some of those."""
    names, _ = history(folder)
    own = next((i for i, n in enumerate(names) if n.startswith(("T_min", "solid_fraction", "stored_heat", "work"))),
               len(names))
    asked = [n for n in names[1:own] if not n.startswith(("stage", "cycle"))]
    return asked or [n for n in names if n.startswith(("T_max", "solid_fraction", "contact_heat", "contact_force"))]


def deviations(reference, folder, columns):
    """The largest difference of each column and its value at the end, as parts of its range in the reference."""
    names, rows = history(folder)
    their_names, theirs = history(reference)
    times = [row[0] for row in theirs]
    worst = (0.0, 0.0, "")
    for column in columns:
        i, j = names.index(column), their_names.index(column)
        values = [row[j] for row in theirs if not math.isnan(row[j])]
        width = max(values) - min(values) if values else 0.0
        if width <= 1e-9 * max(map(abs, values), default=1.0):
            continue
        largest = 0.0
        for row in rows:
            k = bisect.bisect_left(times, row[0] - 1e-9)
            if k >= len(times):
                continue
            if abs(times[k] - row[0]) < 1e-9 or k == 0:
                value = theirs[k][j]
            else:
                share = (row[0] - times[k - 1]) / (times[k] - times[k - 1])
                value = theirs[k - 1][j] + share * (theirs[k][j] - theirs[k - 1][j])
            if not math.isnan(row[i]) and not math.isnan(value):
                largest = max(largest, abs(row[i] - value) / width)
        end = abs(rows[-1][i] - theirs[-1][j]) / width
        worst = max(worst, (largest, end, column))
    return worst


def measure(program, case, physics, finer):
    tight = dict(TIGHT["heat"])
    if physics == "both":
        tight |= TIGHT["mechanics"]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        found = {}
        for name, keys in (("default", {}), ("tight", tight), ("finer", tight | finer)):
            if name == "finer" and not finer:
                continue
            good, text = run(program, case, folder / name, keys)
            if not good:
                return f"| `{case}` | the run with {name} settings ended: {text.splitlines()[-1] if text else ''} | | |"
            found[name] = folder / name
        columns = probes(found["default"])
        cells = []
        for name in ("tight", "finer"):
            if name not in found:
                cells.append("")
                continue
            largest, end, column = deviations(found[name], found["default"], columns)
            cells.append(f"{100 * largest:.2g} % (`{column.split('[')[0]}`), {100 * end:.2g} % at the end")
        steps = len(history(found["default"])[1]) - 1
        return f"| `{case}` | {steps} | {cells[0]} | {cells[1]} |"


def row_of(line):
    """The case that a row of the table is of; None for other lines."""
    return line.split("`")[1] if line.startswith("| `") else None


def kept_rows(page):
    """Rows of the page as it stands, by case: those that are not measured now stay."""
    if page is None or not page.exists():
        return {}
    return {row_of(line): line for line in page.read_text(encoding="utf-8").splitlines() if row_of(line)}


def kept_notes(page):
    """What the page says between its table and its last line."""
    if page is None or not page.exists():
        return []
    lines = page.read_text(encoding="utf-8").splitlines()
    last = max((i for i, line in enumerate(lines) if row_of(line)), default=len(lines))
    return [line for line in lines[last + 1:] if not line.startswith("Next:")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("cases", nargs="*")
    asked = parser.parse_intermixed_args()
    lines = [
        "# What the defaults are worth",
        "Made by `./dev defaults`. Each case as it stands against itself with tolerances that do not matter "
        "(1e-10 of the forces, 1e-7 of the motion, 1e-11 of the heat), and with steps, or their error limits, a "
        "quarter as large besides. The largest difference of any probe of the case at any time of the run, as a "
        "part of the range of that probe, and the probe's at the end. Where steps adapt, other tolerances lead to "
        "other steps, and a probe that jumps shows it.",
        "",
        "| case | steps | tolerances | and steps a quarter as long |",
        "|---|---|---|---|",
    ]
    kept, notes = kept_rows(asked.output), kept_notes(asked.output) if asked.cases else []
    for case, physics, finer in CASES:
        if asked.cases and not any(case.startswith(c) for c in asked.cases):
            lines += [kept[case]] if case in kept else []
            continue
        lines.append(measure(asked.program, case, physics, finer))
        print(lines[-1], flush=True)
    if asked.output:
        while notes and not notes[-1]:
            notes.pop()
        lines += [*notes, "", "Next: [when a step has converged](../decisions/0017-when-a-step-has-converged.md) · "
                      "[all of verification](README.md)"]
        asked.output.write_text("\n".join(lines) + "\n", encoding="utf-8")


main()
