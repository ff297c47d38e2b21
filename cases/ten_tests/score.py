#!/usr/bin/env python3
"""Scores an answer to one of the ten tests. Needs Python 3 and nothing else.

usage: score.py TEST ANSWER.csv       errors of all numbers, the error of the test and its points
       score.py --template TEST       an answer file in which the values are left to fill in

An answer is a table with the columns name and value; names, units, places and times are those of TEST/right.csv. The error of
a number is the difference from the right one over its scale (also in right.csv: the range of what the test is about), the
error of the test the root mean square of all of them; a number that is missing, or is none, counts as one that is wrong by
its whole scale. Points: 10 up to an error of 0.1 %, 0 from 10 % on, evenly over the logarithm between: 5 at 1 %.
"""
import argparse
import csv
import math
from pathlib import Path
import sys

HERE = Path(__file__).resolve().parent
TESTS = ["stefan", "alloy", "corner", "clamped_cube", "weiner_boley", "closing_gap", "plastic_work", "ring_on_core", "pipe", "rubbing"]


def right(test):
    """The rows of right.csv of a test."""
    if test not in TESTS:
        raise ValueError(f"there is no test '{test}'; there are {', '.join(TESTS)}")
    with (HERE / test / "right.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def read_answer(path, names):
    """Values by name; refuses what no test asks for, so that a misspelt name does not pass as one that is missing."""
    with open(path, newline="") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        if not {"name", "value"} <= set(table.fieldnames or []):
            raise ValueError(f"{path}: the first line must name the columns name and value; found {table.fieldnames}")
        answer = {}
        for line, row in enumerate(table, 2):
            if row["name"] not in names:
                raise ValueError(f"{path}, row {line}: '{row['name']}' is not asked for; the test asks for {', '.join(names)}")
            if row["name"] in answer:
                raise ValueError(f"{path}, row {line}: '{row['name']}' is answered twice")
            try:
                answer[row["name"]] = float(row["value"] or "nan")
            except ValueError:
                raise ValueError(f"{path}, row {line}: '{row['value']}' is no number") from None
    return answer


def errors(test, answer):
    """Error of each number over its scale, by name."""
    result = {}
    for row in right(test):
        value = answer.get(row["name"], math.nan)
        off = (value - float(row["value"])) / float(row["scale"])
        result[row["name"]] = off if math.isfinite(off) else 1.0
    return result


def error_of(found):
    return math.sqrt(sum(e * e for e in found.values()) / len(found))


def points(error):
    return 10.0 if error <= 1e-3 else max(0.0, 5.0 * (-1.0 - math.log10(error)))


def report(test, answer):
    rows = {row["name"]: row for row in right(test)}
    found = errors(test, answer)
    lines = [f"{'number':20} {'right':>12} {'answer':>12} {'unit':5} {'error/scale':>11}"]
    for name, off in found.items():
        given = f"{answer[name]:12.6g}" if name in answer else f"{'missing':>12}"
        lines.append(f"{name:20} {float(rows[name]['value']):12.6g} {given} {rows[name]['unit']:5} {100 * off:9.3f} %")
    total = error_of(found)
    return "\n".join(lines + [f"{test}: error {100 * total:.3g} %, {points(total):.1f} of 10 points"])


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="score.py", description=__doc__.splitlines()[0])
    parser.add_argument("test", metavar="TEST")
    parser.add_argument("answer", nargs="?", metavar="ANSWER.csv")
    parser.add_argument("--template", action="store_true", help="print an answer file without values")
    options = parser.parse_args(arguments)
    try:
        if options.template:
            for row in right(options.test):
                place = f"x = {row['x']} m, y = {row['y']} m, z = {row['z']} m, t = {row['time']} s"
                print(f"# {row['name']}: {row['field']} [{row['unit']}] at {place}")
            print("name,value\n" + "\n".join(row["name"] + "," for row in right(options.test)))
            return 0
        if options.answer is None:
            raise ValueError("which answer? score.py TEST ANSWER.csv, or score.py --template TEST")
        names = [row["name"] for row in right(options.test)]
        print(report(options.test, read_answer(options.answer, names)))
    except (ValueError, OSError) as error:
        print(f"score.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
