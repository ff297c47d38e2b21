"""The wall of experiments: docs/validation/wall.md, one row an experiment, measured and computed with their errors.

    python3 -m solidus_docs.wall [EXPERIMENT ...]   runs them (all), keeps what they give in docs/validation/wall.json, writes the page
    python3 -m solidus_docs.wall --page             writes the page of what is kept
    python3 -m solidus_docs.wall --check            says whether the page is that of what is kept

An experiment is a folder in cases/ with experiment.toml and measured.csv (docs/validation/add_an_experiment.md). SOLIDUS_PROGRAM
names the program. Each run is made twice, as the case says and with the coarser mesh and steps of `coarse`: the difference is the
error of what is computed.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import tomllib

from solidus_docs import wrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "validation"
KEYS = {"title": str, "order": int, "kind": str, "source": str, "licence": str, "read": str, "assumed": str, "fitted": str, "said": str,
        "case": str, "coarse": list, "columns": dict, "factor": (int, float), "picture": str}
KINDS = ("values", "order", "curves", "liquidus", "card")


def experiments():
    """Folders by name, in the order of the wall."""
    found = {file.parent.name: read_experiment(file) for file in (ROOT / "cases").rglob("experiment.toml")}
    return dict(sorted(found.items(), key=lambda item: item[1]["order"]))


def read_experiment(file):
    """The keys of experiment.toml; what is missing or unknown is reported with the file."""
    spec = tomllib.loads(file.read_text())
    for key, value in spec.items():
        if key not in KEYS or not isinstance(value, KEYS[key]):
            raise ValueError(f"{file}: '{key}' is no key of an experiment, or of another type; keys are {', '.join(KEYS)}")
    for key in ("title", "order", "kind", "source", "licence", "read", "assumed", "fitted", "said"):
        if key not in spec:
            raise ValueError(f"{file}: the key '{key}' is missing")
    if spec["kind"] not in KINDS:
        raise ValueError(f"{file}: kind is '{spec['kind']}'; it may be {', '.join(KINDS)}")
    if (spec["kind"] == "order") != ("columns" in spec):
        raise ValueError(f"{file}: 'columns' belongs to kind = \"order\"")
    spec["folder"] = file.parent
    return spec


def read_measured(file):
    """Rows of measured.csv: name, measured, error, unit, and for kind = values what is set and which column of history.csv answers."""
    with file.open(newline="") as text:
        rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    for number, row in enumerate(rows, 1):
        for key in ("measured", "error"):
            try:
                row[key] = float(row[key])
            except (KeyError, TypeError, ValueError):
                raise ValueError(f"{file}, row {number}: '{key}' must be a number; found '{row.get(key)}'") from None
    return rows


class Program:
    """Runs the program and adds up the seconds of the processor that it takes."""

    def __init__(self, path):
        self.path, self.seconds = path, 0.0

    def __call__(self, *arguments):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT,
                              env={**os.environ, "SOLIDUS_PROCESSES": "1"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds += after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        if done.returncode:
            raise RuntimeError(f"solidus {' '.join(map(str, arguments))}: {done.stderr[-500:]}")
        return done.stdout

    def history(self, case, sets, folder):
        """Columns of history.csv of a run."""
        self("run", case, "-o", folder, *[f"--set={assignment}" for assignment in sets])
        with (folder / "history.csv").open(newline="") as text:
            rows = list(csv.reader(text))
        return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def history_column(history, name):
    if name not in history:
        raise ValueError(f"there is no column '{name}' in history.csv; there are {', '.join(history)}")
    return history[name]


def width(history, temperature):
    """Twice the distance from the middle at which the highest temperature of probes T_..um is this one."""
    reached = sorted((float(name[2:].split("um")[0]), max(values)) for name, values in history.items() if re.match(r"T_[\d.]+um\[", name))
    for (y, hot), (further, cold) in zip(reached, reached[1:]):
        if hot >= temperature > cold:
            return 2 * (y + (further - y) * (hot - temperature) / (hot - cold))
    return math.nan


def fall_between(history, column, of, start, end):
    """What `column` loses while `of` cools from `start` to `end`, by straight lines between the rows of the history."""
    lost, cooling = history_column(history, column), history_column(history, of)
    found = []
    for value in (start, end):
        rows = [i for i in range(1, len(cooling)) if cooling[i - 1] > value >= cooling[i]]
        if not rows:
            raise ValueError(f"'{of}' does not cool past {value:g} in the run")
        last, now = cooling[rows[0] - 1], cooling[rows[0]]
        share = (last - value) / (last - now)
        found.append(lost[rows[0] - 1] * (1 - share) + lost[rows[0]] * share)
    return found[0] - found[1]


def answer(row, history, factor):
    if row["column"].startswith("width at "):
        return width(history, float(row["column"].split()[2])) * factor
    between = re.fullmatch(r"fall of (.+) from ([-\d.]+) to ([-\d.]+) of (.+)", row["column"])
    if between:
        return fall_between(history, between[1], between[4], float(between[2]), float(between[3])) * factor
    what, column = re.match(r"(largest of |fall of |)(.*)", row["column"]).groups()
    values = history_column(history, column)
    return {"": values[-1], "largest of ": max(values), "fall of ": max(values) - values[-1]}[what] * factor


def compute_values(spec, program, scratch):
    """For each row of measured.csv a run with what the row sets, and one that is coarser."""
    found, case, factor = [], spec["folder"] / spec.get("case", "case.toml"), spec.get("factor", 1)
    for row in read_measured(spec["folder"] / "measured.csv"):
        sets = [part for part in row["set"].split(";") if part]
        fine = answer(row, program.history(case, sets, scratch / "fine"), factor)
        rough = answer(row, program.history(case, sets + spec["coarse"], scratch / "coarse"), factor) if "coarse" in spec else fine
        found.append({"name": row["name"], "measured": row["measured"], "error": row["error"], "unit": row["unit"],
                      "computed": fine, "computed_error": abs(fine - rough)})
    return found


def compute_curves(spec, program, scratch):
    """Root mean square of computed minus measured along each curve of [[measured]] in plots.toml."""
    from solidus_plots.measured import Comparison
    from solidus_plots.plots_file import read_spec
    plots = spec["folder"] / "plots.toml"
    measured = read_spec(plots)[0]["measured"][0]
    runs = []
    for name, sets in (("fine", []), ("coarse", spec["coarse"])):
        program.history(spec["folder"] / spec.get("case", "case.toml"), sets, scratch / name)
        runs.append(Comparison(measured, scratch / name, plots))
    shift, found = measured.get("shift", 0.0), []
    for fine, rough in zip(runs[0].lines, runs[1].lines):
        off = runs[0].deviation(fine, shift)
        found.append({"name": fine[0], "points": len(fine[1][0]), "unit": "K", "deviation": off,
                      "computed_error": abs(off - runs[1].deviation(rough, shift))})
    return found


def compute_liquidus(spec, program, _):
    """The liquidus that `solidus materials scheil` gives for the composition in the column `name`."""
    found = []
    for row in read_measured(spec["folder"] / "measured.csv"):
        value = float(re.search(r"liquidus ([\d.]+) degC", program("materials", "scheil", row["composition"]))[1])
        found.append({"name": row["name"], "measured": row["measured"], "error": row["error"], "unit": row["unit"],
                      "computed": value, "computed_error": 0.0})
    return found


def property_of(text, name, at):
    """A constant, or a table at a temperature [degC], of what `solidus materials CARD` prints."""
    found = re.search(rf"^  {re.escape(name)} +(?:([-\d.e+]+)|of temperature.*\n((?: +[-\d.]+ degC +[-\d.e+]+\n)+))", text, re.MULTILINE)
    if found is None:
        raise ValueError(f"the card has no number or table '{name}'")
    if found[1]:
        return float(found[1])
    points = [tuple(map(float, line.split(" degC "))) for line in found[2].splitlines()]
    for (cold, low), (hot, high) in zip(points, points[1:]):
        if cold <= at <= hot:
            return low + (high - low) * (at - cold) / (hot - cold)
    raise ValueError(f"'{name}' of the card has no value at {at:g} degC")


def compute_card(spec, program, _):
    """The property of a material card that the columns `card`, `property` and `at` (a temperature in degC, or empty) name."""
    found = []
    for row in read_measured(spec["folder"] / "measured.csv"):
        value = property_of(program("materials", row["card"]), row["property"], float(row["at"] or "nan")) * spec.get("factor", 1)
        found.append({"name": row["name"], "measured": row["measured"], "error": row["error"], "unit": row["unit"],
                      "computed": value, "computed_error": 0.0})
    return found


def distinguished(rows):
    """Pairs (less, greater) of rows whose measured values differ by more than both errors."""
    return [(low, high) for low in rows for high in rows if low["measured"] + low["error"] < high["measured"] - high["error"]]


def compute_order(spec, program, scratch):
    """For each criterion in `columns`, the number of pairs that it ranks as measured: high where the measured value is low."""
    rows = read_measured(spec["folder"] / "measured.csv")
    for row in rows:
        sets = [part for part in row["set"].split(";") if part]
        row["history"] = program.history(spec["folder"] / spec.get("case", "case.toml"), sets, scratch / "fine")
    pairs = distinguished(rows)
    found = []
    for name, column in spec["columns"].items():
        last = [history_column(row["history"], column)[-1] for row in rows]
        value = {row["name"]: number for row, number in zip(rows, last)}
        right = sum(value[low["name"]] > value[high["name"]] for low, high in pairs)
        found.append({"name": name, "measured": float(len(pairs)), "error": 0.0, "unit": "pairs", "computed": float(right),
                      "computed_error": 0.0})
    return found


COMPUTE = {"values": compute_values, "curves": compute_curves, "liquidus": compute_liquidus, "card": compute_card,
           "order": compute_order}


def run(names):
    """Runs experiments and keeps what they give."""
    path = os.environ.get("SOLIDUS_PROGRAM", str(ROOT / "build/release/solidus"))
    kept_file = FOLDER / "wall.json"
    there = experiments()
    for name in names:
        if name not in there:
            raise ValueError(f"there is no experiment '{name}'; there are {', '.join(there)}")
    for name in names or there:
        program = Program(path)
        version = program("--version").split()[1]
        with tempfile.TemporaryDirectory() as scratch:
            values = COMPUTE[there[name]["kind"]](there[name], program, pathlib.Path(scratch))
        found = {"version": version, "seconds": float(f"{program.seconds:.2g}"), "values": rounded(values)}
        print(name, summary(found["values"]), file=sys.stderr)
        # Each row is kept as soon as it is there: what fails later, or is interrupted, does not take it away.
        kept = {**(json.loads(kept_file.read_text()) if kept_file.exists() else {}), name: found}
        kept_file.write_text(json.dumps({name: kept[name] for name in there if name in kept}, indent=1, ensure_ascii=False) + "\n")


def rounded(values):
    return [{key: float(f"{value:.5g}") if isinstance(value, float) else value for key, value in row.items()} for row in values]


def summary(values):
    """Computed against measured in a sentence of figures."""
    if "deviation" in values[0]:
        return ", ".join(f"{row['name']}: {row['deviation']:.2g} K" for row in values) + " (root mean square)"
    inside = sum(abs(row["computed"] - row["measured"]) <= row["error"] + row["computed_error"] for row in values)
    units = dict.fromkeys(row["unit"] for row in values)
    parts = [spread([row for row in values if row["unit"] == unit], unit) for unit in units]
    return f"{', '.join(parts)}; {inside} of {len(values)} within both errors"


def spread(values, unit):
    """How far numbers of one unit are off."""
    off = [row["computed"] - row["measured"] for row in values]
    rms, mean = math.sqrt(sum(d * d for d in off) / len(off)), sum(off) / len(off)
    size = sum(abs(row["measured"]) for row in values) / len(values)
    unit = "K" if unit == "degC" else unit
    return f"{rms:.2g} {unit} root mean square ({100 * rms / size:.2g} % of the mean), {mean:+.2g} on average"


def table(values):
    if "deviation" in values[0]:
        lines = ["| curve | points | root mean square of computed less measured | error of the computed |", "|---|---|---|---|"]
        return lines + [f"| {r['name']} | {r['points']} | {r['deviation']:.3g} {r['unit']} | {r['computed_error']:.2g} {r['unit']} |"
                        for r in values]
    lines = ["| | measured | its error | computed | its error | difference |", "|---|---|---|---|---|---|"]
    return lines + [f"| {r['name']} | {r['measured']:.5g} {r['unit']} | {r['error']:.2g} | {r['computed']:.5g} | {r['computed_error']:.2g} "
                    f"| {r['computed'] - r['measured']:+.3g} |" for r in values]


HEAD = """# The wall of experiments

Computed against measured values, one row per experiment, whether they agree or not, with the assumptions made.
`./dev validate` runs the cases and writes this page; it is not edited by hand. [How to add one](add_an_experiment.md).

The error of a measurement is stated by its source, or below the table; the error of a computed value is the difference to a run
with a coarser mesh and longer steps (none where the value comes from a material card or a formula).

![Computed over measured; the bars are both errors together](images/wall.png)
"""


def page():
    """The page of what is kept."""
    kept = json.loads((FOLDER / "wall.json").read_text())
    there = {name: spec for name, spec in experiments().items() if name in kept}
    lines = [HEAD, "| experiment | computed against measured | fitted | seconds of a core | program |", "|---|---|---|---|---|"]
    for name, spec in there.items():
        row = kept[name]
        lines.append(f"| [{spec['title']}](#{heading(spec['title'])}) | {summary(row['values'])} | {spec['fitted']} | {row['seconds']:g} "
                     f"| {row['version']} |")
    for name, spec in there.items():
        place = spec["folder"].relative_to(ROOT)
        page_of = place if (spec["folder"] / "README.md").exists() else place.parent
        lines += ["", f"## {spec['title']}", "", f"[`{place}`](../../{page_of}/README.md). {spec['said']}", "", *table(kept[name]["values"]), "",
                  f"- Source: {spec['source']}", f"- Licence: {spec['licence']}", f"- Read: {spec['read']}",
                  f"- Assumed: {spec['assumed']}"]
    return wrap.wrapped("\n".join(lines + ["", "Next: [add an experiment](add_an_experiment.md) · [ten tests for any code](ten_tests.md) "
                                           "· [the billets](dc_billets.md)", ""]))


def heading(title):
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def draw():
    """All numbers that were computed over those that were measured, an experiment a colour: docs/validation/images/wall.png."""
    from solidus_plots import style
    figure, axes = style.plt.subplots(figsize=(7.0, 4.2))
    kept, there, place = json.loads((FOLDER / "wall.json").read_text()), experiments(), 0
    for name, spec in there.items():
        values = [row for row in kept.get(name, {"values": []})["values"] if "computed" in row]
        if not values:
            continue
        at = range(place, place + len(values))
        axes.errorbar(at, [row["computed"] / row["measured"] for row in values],
                      [(row["error"] + row["computed_error"]) * row["computed"] / row["measured"]**2 for row in values],
                      linestyle="", marker="o", markersize=3, capsize=2, label=spec["title"])
        place += len(values) + 2
    axes.axhline(1, color="0.5", linewidth=0.8)
    axes.set(ylabel="computed / measured", xticks=[])
    axes.set_title("The wall of experiments: every number", loc="left")
    axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.02), ncol=2, frameon=False)
    figure.tight_layout()
    figure.savefig(FOLDER / "images" / "wall.png", dpi=110, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiments", nargs="*", metavar="EXPERIMENT")
    parser.add_argument("--page", action="store_true", help="write the page of what is kept, run nothing")
    parser.add_argument("--check", action="store_true", help="say whether the page is that of what is kept")
    options = parser.parse_args()
    try:
        if options.check:
            return 0 if (FOLDER / "wall.md").read_text() == page() else "docs/validation/wall.md is not that of what is kept: ./dev validate"
        if not options.page:
            run(options.experiments)
        (FOLDER / "wall.md").write_text(page())
        draw()
    except (ValueError, RuntimeError, OSError) as error:
        return f"solidus_docs.wall: {error}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
