"""How far the defaults are from converged answers: docs/verification/defaults.md.

The cases of `cases/` (cases.py) are run as they are, with tolerances so small that they do not matter, and with
steps (or their error limits) a quarter as large besides. What is compared is what the case itself samples: its
probes at the times of the run as it is, its last profile, or the curves of a test at a point. Where steps adapt,
smaller tolerances lead to other steps too.

    /usr/bin/python3 tests/defaults PROGRAM [-o docs/verification/defaults.md] [CASE ...]

With CASEs the rows of the others stay as the page has them, and so do its notes.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import samples
from cases import ROWS

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIGHT_HEAT = {"heat.tolerance": "1e-11"}
TIGHT = {
    "heat": TIGHT_HEAT,
    "coupled": TIGHT_HEAT | {"mechanics.tolerance": "1e-10", "mechanics.displacement_tolerance": "1e-7"},
}
LIMIT = 3600  # [s] of a run

HEAD = """\
# Accuracy of the default settings
How much do results change with much smaller tolerances, and with much shorter time steps? `./dev defaults` measures it
with the cases of `cases/` and writes this page. Each case is run three times:

1. as it is, with the default tolerances of the iterations;
2. with tolerances so small that they have no influence (1e-10 for the balance of forces, 1e-7 for the displacements,
   1e-11 for the balance of heat, each relative), column *tolerances*;
3. with these tolerances and with time steps a quarter as long, or error limits of adaptive steps a quarter as large.

The columns *tolerances* and *tolerances, and steps a quarter as long* have the largest difference of any probe of the
case between the first run and the other one, at any time, in per cent of the range of the probe, with its name. The
number after the comma is the difference of this probe at the last time that both runs reach. A case without probes is
compared by the temperature of its hottest node, solid fraction, heat and force of the contact, or by the values along a
line that it writes at the end. For a run that ends when all is solid, *solid after A for B s* has that time in the
first run, A, and in the other one, B. *Steps* is the number of time steps of the first run. Where steps are adaptive,
other tolerances lead to other steps, so that a probe that changes suddenly differs much for a moment. Tests at a
material point (`point/…`, without a mesh) have no tolerance to choose; their steps are those of all their curves
together. *Answers* are those of the first run, ± the error by step and mesh that it states
([how](../theory/step_and_mesh.md#the-error-of-an-answer)); in brackets the same with the shorter steps. The name after
a colon is a [variant](../guide/case_file.md#variants), which the page of the case in `cases/` explains.
"""

LAST = ("Next: [when a step has converged](../decisions/0017-when-a-step-has-converged.md) · "
        "[all of verification](README.md)")


def run(program, row, folder, keys):
    verb = "point" if row.kind == "point" else "run"
    command = [program, verb, str(ROOT / "cases" / row.case), "-o", str(folder)]
    for key, value in (row.shorter | keys).items():
        command += ["--set", f"{key}={json.dumps(value) if not value[0].isdigit() or ' ' in value else value}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
    return done.returncode == 0, done.stderr[-400:]


def percent(share):
    return f"{100 * share:.2g} %"


def cell(row, reference, default):
    """What a run with other settings differs by from that with the defaults."""
    largest, end, name = samples.worst(samples.of(reference, row.kind), samples.of(default, row.kind))
    text = f"{percent(largest)} (`{name.split('[')[0]}`)" if name else "nothing"
    if name and not samples.of_places(reference, row.kind):
        text += f", {percent(end)} at the end"
    solid, theirs = samples.frozen_at(default, row.kind), samples.frozen_at(reference, row.kind)
    if solid and theirs:
        text += f"; solid after {solid:.4g} for {theirs:.4g} s"
    return text


def answers(row, default, finer):
    """The answers with the errors that the run states, next to those with shorter steps."""
    others = samples.answers(finer, row.kind)
    return "; ".join(f"{name} {value:.4g} ± {error:.2g} {samples.UNITS[name]} ({others[name][0]:.4g})"
                     for name, (value, error, *_) in samples.answers(default, row.kind).items() if name in others)


def measure(program, row):
    tight = TIGHT.get(row.kind)
    runs = [("default", {})]
    runs += [("tight", tight)] if tight else []
    runs += [("finer", (tight or {}) | row.finer)]
    with tempfile.TemporaryDirectory() as scratch:
        found = {}
        for name, keys in runs:
            good, text = run(program, row, pathlib.Path(scratch) / name, keys)
            if not good:
                last = text.splitlines()[-1] if text else ""
                return f"| {title(row)} | the run with {name} settings ended: {last} | | | |"
            found[name] = pathlib.Path(scratch) / name
        cells = [cell(row, found[name], found["default"]) if name in found else "none to choose"
                 for name in ("tight", "finer")]
        told = answers(row, found["default"], found["finer"])
        return f"| {title(row)} | {samples.steps(found['default'], row.kind)} | {cells[0]} | {cells[1]} | {told} |"


def title(row):
    return f"`{row.case}`" + (f", {row.says}" if row.says else "")


def case_of(line):
    """The case that a row of the table is of; None for other lines."""
    return line.split("`")[1] if line.startswith("| `") else None


def kept(page):
    """Rows of the page as it is, by case, and its notes, between its table and its last line."""
    if page is None or not page.exists():
        return {}, []
    lines = page.read_text(encoding="utf-8").splitlines()
    rows = {case_of(line): line for line in lines if case_of(line)}
    last = max((i for i, line in enumerate(lines) if case_of(line)), default=len(lines))
    return rows, [line for line in lines[last + 1:] if not line.startswith("Next:")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("cases", nargs="*")
    asked = parser.parse_intermixed_args()
    lines = [*HEAD.splitlines(), "", "| case | steps | tolerances | tolerances, and steps a quarter as long | answers |",
             "|---|---|---|---|---|"]
    rows, notes = kept(asked.output)
    for row in ROWS:
        if asked.cases and not any(row.case.startswith(c) for c in asked.cases):
            lines += [rows[row.case]] if row.case in rows else []
            continue
        lines.append(measure(asked.program, row))
        print(lines[-1], flush=True)
    if asked.output:
        notes = notes if asked.cases else []
        while notes and not notes[-1]:
            notes.pop()
        asked.output.write_text("\n".join([*lines, *notes, "", LAST]) + "\n", encoding="utf-8")


main()
