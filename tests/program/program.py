"""Runs the program as a user does. SOLIDUS_PROGRAM names it, SOLIDUS_FOLDER a folder for what tests leave."""

import json
import os
from pathlib import Path
import shutil
import subprocess
import unittest

PROGRAM = os.environ["SOLIDUS_PROGRAM"]
SOURCES = Path(__file__).resolve().parents[2]
NIGHTLY = "SOLIDUS_NIGHTLY" in os.environ  # all of what `./dev test` takes a sample of (tests/nightly.hpp)
PATIENCE = float(os.environ.get("SOLIDUS_TEST_PATIENCE", "1"))  # limits of time are multiplied by it


def solidus(*arguments, cwd=None, env=None, timeout=120):
    """What it prints, and its exit code."""
    return subprocess.run([PROGRAM, *arguments], cwd=cwd, env={**os.environ, **(env or {})}, text=True,
                          capture_output=True, timeout=PATIENCE * timeout, stdin=subprocess.DEVNULL)


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, which is empty when it begins."""

    def setUp(self):
        self.folder = Path(os.environ["SOLIDUS_FOLDER"]) / self.id()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def done(self, *arguments, **options):
        """What the program prints where it must end well."""
        result = solidus(*arguments, cwd=options.pop("cwd", self.folder), **options)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stdout[-1000:]}{result.stderr}")
        return result.stdout

    def summary(self, folder):
        return json.loads((Path(folder) / "summary.json").read_text())
