#!/usr/bin/env python3
"""Runs the ten tests with the codes that are installed, and writes their answers to answers/CODE/TEST.csv.

usage: run.py [--code CODE ...] [-o FOLDER] [--keep FOLDER] [TEST ...]

Codes are the modules of codes/. Decks are in the folders of the tests: solidus.toml, calculix.inp, freefem.edp, fenicsx.py. `./dev validate`
makes the page docs/validation/ten_tests.md of all answers that lie there, of whichever machine they are.
"""
import argparse
import csv
import importlib
from pathlib import Path
import sys
import tempfile
import time

import score

CODES = ["solidus", "calculix", "freefem", "dolfinx"]


def write(path, version, seconds, answer):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        file.write(f"# {version}\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["name", "value"])
        rows.writerows([name, f"{value:.7g}"] for name, value in answer.items())


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.splitlines()[0])
    parser.add_argument("tests", nargs="*", metavar="TEST", help=", ".join(score.TESTS))
    parser.add_argument("--code", action="append", choices=CODES)
    parser.add_argument("-o", dest="answers", type=Path, default=score.HERE / "answers", metavar="FOLDER")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="for what the codes leave; else it is thrown away")
    options = parser.parse_args(arguments)
    wrong = [test for test in options.tests if test not in score.TESTS]
    if wrong:
        parser.error(f"there is no test '{wrong[0]}'; there are {', '.join(score.TESTS)}")
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        for code in options.code or CODES:
            module = importlib.import_module(f"codes.{code}")
            version = module.version()
            if version is None:
                print(f"{code}: not installed, left out", file=sys.stderr)
                continue
            for test in [t for t in options.tests or score.TESTS if t in module.TESTS]:
                folder = (options.keep or Path(scratch)).resolve() / code / test
                folder.mkdir(parents=True, exist_ok=True)
                start = time.monotonic()
                try:
                    answer = module.answer(test, folder)
                except Exception as error:  # of a code that we do not know: the others go on
                    print(f"{code:10} {test:14} failed: {error}", file=sys.stderr)
                    failed += 1
                    continue
                write(options.answers / code / f"{test}.csv", version, time.monotonic() - start, answer)
                error = score.error_of(score.errors(test, answer))
                print(f"{code:10} {test:14} error {100 * error:8.3g} %  {score.points(error):4.1f} points")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
