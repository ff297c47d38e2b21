"""Runs tests as `python3 -m unittest` does, with the same arguments, and says at its end why some were skipped, a line a reason.

Exit code 77 where every test was skipped, as the programs of GoogleTest have it (main.cpp), and 1 where there was none.
"""

import os
import sys
import unittest

ALL_SKIPPED = 77  # SKIP_RETURN_CODE of tests/CMakeLists.txt


class Result(unittest.TextTestResult):
    """Counts what ran to its end: a class that is skipped has tests for one Python and none for another."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.passed = 0

    def addSuccess(self, test):
        super().addSuccess(test)
        self.passed += 1

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        self.passed += err is None


class Runner(unittest.TextTestRunner):
    resultclass = Result


def main(arguments):
    """Returns the exit code."""
    result = unittest.main(module=None, argv=["python3 -m unittest", *arguments], testRunner=Runner, exit=False).result
    reasons = sorted({" ".join(reason.split()) for _, reason in result.skipped})
    all_skipped = result.wasSuccessful() and result.skipped and not result.passed
    for reason in reasons:
        print(f"{'all of it is skipped' if all_skipped else 'skipped'}: {reason}", flush=True)
    if all_skipped:
        return ALL_SKIPPED
    return 0 if result.wasSuccessful() and result.passed else 1


if __name__ == "__main__":
    sys.path[0] = os.getcwd()  # where `python3 -m unittest` looks for modules, in place of the folder of this file
    sys.exit(main(sys.argv[1:]))
