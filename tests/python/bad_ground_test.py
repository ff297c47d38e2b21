"""What a machine lacks is reported in one sentence: by ./dev and by the verbs in Python."""

import errno
import itertools
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock
import warnings

import numpy as np

from solidus_plots import curves, style
from solidus_plots.history import Table
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError

ROOT = Path(__file__).resolve().parents[2]
TOOLS = ("bash", "sed", "env", "nproc", "cat", "dirname", "mkdir", "basename", "mktemp", "rm", "grep", "sort", "tr")


class BadGround(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.tools = self.folder / "tools"  # a PATH that has these programs and no others
        self.tools.mkdir()
        for tool in TOOLS:
            (self.tools / tool).symlink_to(shutil.which(tool))

    def dev(self, *arguments, at=ROOT, **variables):
        """What ./dev prints, on a system that has but a few tools, and its exit code."""
        return subprocess.run([self.tools / "bash", at / "dev", *arguments], cwd=at, text=True, capture_output=True, timeout=60,
                              env={"PATH": str(self.tools), "LC_ALL": "C.UTF-8", **variables})

    def system(self, text):
        file = self.folder / "os-release"
        file.write_text(text)
        return str(file)

    def test_dev_says_which_systems_are_known_and_what_others_need(self):
        for text, known in (('PRETTY_NAME="Debian GNU/Linux 13 (trixie)"\nID=debian\nVERSION_ID="13"\n', True),
                            ('PRETTY_NAME="Debian GNU/Linux forky/sid"\nID=debian\n', False),
                            ('PRETTY_NAME="Fedora Linux 43"\nID=fedora\nVERSION_ID=43\n', False)):
            said = self.dev("systems", SOLIDUS_OS_RELEASE=self.system(text)).stdout
            name = text.split('"')[1]
            self.assertIn(f"This is {name}: {'known' if known else 'not tested'}.", said)
            self.assertIn("petsc-dev", said)

    def test_dev_names_what_is_to_be_installed_by_hand_without_the_tools_of_debian(self):
        said = self.dev("setup")
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr, r"^dev: this is not Debian .*; please install: clang\+\+, cmake, ninja, ")

    def test_dev_names_the_mpirun_that_is_missing(self):
        said = self.dev("run", "cases/hot_spots", NP="2", SOLIDUS_PROGRAM="/bin/false")
        self.assertEqual(said.returncode, 1)
        self.assertEqual(said.stderr, "dev: NP=2 needs mpirun, which is not there (Debian's openmpi-bin)\n")

    def test_dev_names_the_folder_for_temporary_files_that_processes_lack(self):
        (self.tools / "mpirun").symlink_to("/bin/true")
        said = self.dev("run", "cases/hot_spots", NP="2", SOLIDUS_PROGRAM="/bin/false", TMPDIR="/no/folder")
        self.assertEqual(said.returncode, 1)
        self.assertEqual(said.stderr, "dev: NP=2 needs a folder for temporary files, and '/no/folder' cannot be written: TMPDIR=FOLDER names "
                                      "another one\n")

    def test_dev_says_that_a_tree_cannot_be_written(self):
        tree = self.folder / "tree"
        tree.mkdir()
        shutil.copy(ROOT / "dev", tree)
        (tree / "build").write_text("a file where the folder would be made")
        said = self.dev("docs", "--site", at=tree)
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr, "^dev: .*/tree cannot be written: copy the sources to a folder of yours")

    def test_a_python_without_numpy_is_named(self):
        said = subprocess.run([sys.executable, "-S", "-m", "solidus_plots.verb", "compare", "a", "b"], text=True,
                              capture_output=True, timeout=60, env={"PYTHONPATH": str(ROOT / "python")})
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr, r"^solidus: pictures and comparisons need numpy and matplotlib, and \S+ has no "
                                      r"'(numpy|matplotlib)'\n  Debian's python3-numpy and python3-matplotlib; SOLIDUS_PYTHON")

    def test_a_folder_that_cannot_be_written_is_named_without_numbers_of_the_system(self):
        error = OSError(errno.EROFS, os.strerror(errno.EROFS), "results/x/plots")
        self.assertEqual(sentence(error), "results/x/plots: cannot be written: Read-only file system")
        error = OSError(errno.EISDIR, os.strerror(errno.EISDIR), "cases/hot_spots")
        self.assertEqual(sentence(error), "cases/hot_spots: Is a directory")
        self.assertEqual(sentence(FileNotFoundError(errno.ENOENT, "No usable temporary directory found in ['/tmp']")),
                         "No usable temporary directory found in ['/tmp']")
        self.assertEqual(sentence(ResultError("history.csv: there is no such file")), "history.csv: there is no such file")

    def test_a_missing_font_is_named(self):
        with mock.patch.object(style, "FONT", "No Such Font"), self.assertRaisesRegex(ResultError, "the font No Such Font is missing"):
            style.setup()

    def test_a_slow_machine_draws_without_warnings(self):
        to_and_fro = np.tile([0.0, 5.0], 200)  # there is no place for a legend that hides nothing
        steps = Table({header: to_and_fro for header in ("dt[s]", "heat_iterations[1]", "mechanics_iterations[1]", "rejected[1]")})
        steps["time[s]"] = np.arange(400.0)
        style.setup()
        with mock.patch("matplotlib.legend.time.perf_counter", side_effect=itertools.count(0, 2)), warnings.catch_warnings():
            warnings.simplefilter("error")
            curves.steps(steps, self.folder)


if __name__ == "__main__":
    unittest.main()
