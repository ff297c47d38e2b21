"""The tables of right answers: one row a number that is asked for, written by the right.py of each test."""
import csv
from pathlib import Path
import sys

HEADER = ["name", "field", "x", "y", "z", "time", "value", "unit", "scale"]


def row(name, field, place, time, value, unit, scale):
    """A number: its name, the field and place [m] and time [s] that it is of, and the size by which errors are divided."""
    x, y, z = (list(place) + [0.0, 0.0])[:3]
    return [name, field, f"{x:.6g}", f"{y:.6g}", f"{z:.6g}", f"{time:.6g}", f"{value:.7g}", unit, f"{scale:.6g}"]


def write(script, rows):
    """Writes right.csv next to the script, or with --print to the terminal."""
    if "--print" in sys.argv:
        csv.writer(sys.stdout, lineterminator="\n").writerows([HEADER, *rows])
        return
    with (Path(script).resolve().parent / "right.csv").open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *rows])


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def root(function, low, high):
    """The root of a function that changes its sign once between both arguments, by bisection to rounding."""
    sign = function(low) > 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
