"""Runs whole cases with the program and reads their tables, for tests that take minutes (ctest -C nightly -L nightly)."""

import csv
import os
from pathlib import Path
import subprocess

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests/verification/reference"


def run(case, name=None, settings=()):
    """Runs a case file below cases/, or a variant of a case, FOLDER:VARIANT, with settings as --set takes them.

    name: of the folder of its results, where it is not that of the case

    @returns its exit code, what it said, and the folder of its results
    """
    folder = Path(os.environ["SOLIDUS_FOLDER"]) / (name or Path(case.replace(":", "/")).with_suffix(""))
    done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], "run", str(ROOT / "cases" / case), "-o", str(folder),
                           *(part for setting in settings for part in ("--set", setting))],
                          capture_output=True, text=True, timeout=3600, check=False)
    return done.returncode, done.stdout + done.stderr, folder


def numbers(path):
    """The columns of a table of numbers by header; texts read as NaN."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))

    def number(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return float("nan")

    return {key: [number(row[key]) for row in rows] for key in rows[0]}


def reference(table, keys):
    """The rows of a table of the reference programs whose first columns are `keys`, as dictionaries of texts."""
    with (REFERENCE / table).open(newline="") as file:
        rows = list(csv.DictReader(file))
    names = list(rows[0])[: len(keys)]
    return [row for row in rows if [row[name] for name in names] == [str(key) for key in keys]]
