"""What a run samples, and how far two runs are apart in it."""
import bisect
import csv
import json
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "program"))
import castings_with_errors  # noqa: E402

# Columns of the program's own in history.csv; the probes of a case come before them.
OWN = ("T_min", "solid_fraction", "stored_heat", "work", "contact_heat", "contact_force")
# What is compared where a case has neither probe nor profile.
INSTEAD = ("T_max", "solid_fraction", "contact_heat", "contact_force")
# What is compared at a point of a material.
AT_A_POINT = r"temperature|(strain|stress)_(xx|xy)|von_mises|equivalent_plastic_strain"


def table(path):
    """Names and rows of numbers of a CSV file."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = list(csv.reader(file))
    return names, [[float(x) if x else math.nan for x in row] for row in rows]


def columns(names, rows, wanted, prefix=""):
    times = [row[0] for row in rows]
    return {prefix + name: (times, [row[i] for row in rows]) for i, name in enumerate(names) if name in wanted}


def probes(names):
    """The columns of history.csv that the case asked for."""
    own = next((i for i, n in enumerate(names) if n.startswith(OWN)), len(names))
    return [n for n in names[1:own] if not n.startswith(("stage", "cycle"))]


def of_history(folder):
    """The probes of the case by name, each as times and values; without any, some of the program's own columns."""
    names, rows = table(folder / "history.csv")
    return columns(names, rows, probes(names) or [n for n in names if n.startswith(INSTEAD)])


def of_profiles(folder):
    """The last profiles of the case, each as places and values."""
    found = {}
    for profile in tables_of_profiles(folder):
        names, rows = table(folder / f"{profile}.csv")
        found |= columns(names, rows, [n for n in names if not re.match(r"[xyz]\[", n)])
    return found


def tables_of_profiles(folder):
    others = {"history", "steps"}
    return [path.stem for path in sorted(folder.glob("*.csv")) if path.stem not in others
            and table(path)[0][:2] == ["x[mm]", "y[mm]"]]


def of_point(folder):
    """Each curve of a test at a point."""
    found = {}
    for path in sorted(folder.glob("*.csv")):
        names, rows = table(path)
        wanted = [n for n in names if re.match(f"({AT_A_POINT})\\[", n)]
        found |= columns(names, rows, wanted, f"{path.stem}: ")
    return found


def of_places(folder, kind):
    """Whether what is sampled are values along a line at the end, not over time: those of a case without probes."""
    return kind != "point" and not probes(table(folder / "history.csv")[0]) and bool(tables_of_profiles(folder))


def of(folder, kind):
    if kind == "point":
        return of_point(folder)
    if of_places(folder, kind):
        return of_profiles(folder)
    return of_history(folder)


def frozen_at(folder, kind):
    """The end of a run that goes on until all is solid [s]; None for others."""
    if kind == "point":
        return None
    ends = re.search(r'^until = "(\w+)"', (folder / "case.toml").read_text(encoding="utf-8"), re.MULTILINE)
    return table(folder / "history.csv")[1][-1][0] if ends and ends[1] == "solid" else None


UNITS = {"solid after": "s", "largest gap": "µm", "largest distortion": "µm", "largest von Mises": "MPa", "pores": "%"}


def answers(folder, kind):
    """The answers of a run by name with the errors that it states, in UNITS; none of a run that has no castings."""
    if kind == "point":
        return {}
    given = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return castings_with_errors.answers(given) if given.get("answers", {}).get("castings") else {}


def steps(folder, kind):
    if kind == "point":
        text = (folder / "summary.json").read_text(encoding="utf-8")
        return sum(curve["steps"] for curve in json.loads(text)["curves"])
    return len(table(folder / "history.csv")[1]) - 1


def interpolated(times, values, t):
    """The value at t between two samples; NaN behind the last one."""
    k = bisect.bisect_left(times, t - 1e-9)
    if k >= len(times):
        return math.nan
    if k == 0 or abs(times[k] - t) < 1e-9:
        return values[k]
    share = (t - times[k - 1]) / (times[k] - times[k - 1])
    return values[k - 1] + share * (values[k] - values[k - 1])


def deviation(reference, samples):
    """The largest difference and that at the last common time, as parts of the range in the reference."""
    times, values = reference
    finite = [v for v in values if not math.isnan(v)]
    width = max(finite) - min(finite) if finite else 0.0
    if width <= 1e-9 * max(map(abs, finite), default=1.0):
        return 0.0, 0.0
    apart = [abs(v - interpolated(times, values, t)) / width for t, v in zip(*samples)]
    apart = [d for d in apart if not math.isnan(d)]
    return max(apart, default=0.0), apart[-1] if apart else 0.0


def worst(reference, samples):
    """Of all that two runs sample: largest difference, that at the end, name."""
    return max(((*deviation(reference[name], samples[name]), name) for name in samples), default=(0.0, 0.0, ""))
