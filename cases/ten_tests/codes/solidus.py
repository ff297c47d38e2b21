"""Solidus: TEST/solidus.toml with the program's defaults; SOLIDUS_PROGRAM, or the one of build/release."""
import csv
import os
from pathlib import Path
import subprocess

import score

TESTS = score.TESTS
WITHOUT = {}
ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("SOLIDUS_PROGRAM", str(ROOT / "build/release/solidus"))


def version():
    try:
        said = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
    except OSError:
        return None
    return "Solidus " + said.split()[1].split("+")[0]


def read(path):
    """Columns of a table by their header."""
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def at(times, values, time):
    """The value at a time, between two rows by a straight line; a steady run has one row only."""
    for (a, x), (b, y) in zip(zip(times, values), zip(times[1:], values[1:])):
        if a <= time <= b * (1 + 1e-12):
            return x + (y - x) * (time - a) / (b - a)
    return values[-1]


def pipe(folder, rows):
    """Heights of the metal over the bottom: what is not emptied, summed up along each line of nodes; and the volume of the pipe."""
    table = read(folder / "emptied.csv")
    answer = {}
    for row in rows:
        if row["field"] == "pipe_volume":
            answer[row["name"]] = read(folder / "feeding.csv")["pipe[m3]"][-1] * 1e6
            continue
        line = sorted((y, 1 - e) for x, y, e in zip(table["x[mm]"], table["y[mm]"], table["emptied[1]"])
                      if abs(x - 1000 * float(row["x"])) < 1e-6)
        answer[row["name"]] = sum(0.5 * (b[0] - a[0]) * (a[1] + b[1]) for a, b in zip(line, line[1:]))
    return answer


def answer(test, folder):
    subprocess.run([PROGRAM, "run", str(score.HERE / test / "solidus.toml"), "-o", str(folder)], check=True,
                   stdout=subprocess.DEVNULL, env={**os.environ, "SOLIDUS_PROCESSES": "1"})
    rows = score.right(test)
    if test == "pipe":
        return pipe(folder, rows)
    history, found = read(folder / "history.csv"), {}
    for row in rows:
        columns = [f"{name}[{row['unit']}]" for name in (row["name"], row["name"].rsplit("_", 1)[0])]
        column = next(c for c in columns if c in history)
        found[row["name"]] = at(history["time[s]"], history[column], float(row["time"]))
    return found
