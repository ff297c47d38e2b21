"""Each folder of cases/ has a notebook that runs. SOLIDUS_NOTEBOOKS names those that are executed; all of them are looked at."""

import ast
import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import unittest

from program import SOURCES, ProgramTest

import solidus_casting as sc

FOLDERS = sorted(folder for folder in (SOURCES / "cases").iterdir() if folder.is_dir())
CHOSEN = os.environ.get("SOLIDUS_NOTEBOOKS", "").split()
MOST_CELLS = 20


class Notebooks(ProgramTest):
    def test_every_case_has_a_notebook_of_the_format_that_jupyter_reads(self):
        for folder in FOLDERS:
            with self.subTest(case=folder.name):
                notebook = json.loads((folder / "notebook.ipynb").read_text(encoding="utf-8"))
                self.assertEqual(notebook["nbformat"], 4)
                self.assertGreaterEqual(notebook["nbformat_minor"], 5)
                self.assertEqual(notebook["metadata"]["kernelspec"]["name"], "python3")
                cells = notebook["cells"]
                self.assertTrue(3 <= len(cells) <= MOST_CELLS)
                self.assertEqual(cells[0]["cell_type"], "markdown")
                self.assertTrue("".join(cells[0]["source"]).startswith("# "))
                self.assertEqual(len({cell["id"] for cell in cells}), len(cells))
                for cell in cells:
                    keys = {"cell_type", "id", "metadata", "source"}
                    if cell["cell_type"] == "code":
                        keys |= {"execution_count", "outputs"}
                        self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
                        ast.parse("".join(cell["source"]))
                    self.assertEqual(set(cell), keys)
                    self.assertRegex(cell["id"], r"^[a-zA-Z0-9_-]{1,64}$")

    def test_every_notebook_is_run_by_one_of_the_tests(self):
        if "SOLIDUS_ALL_NOTEBOOKS" in os.environ:
            self.assertEqual(sorted(os.environ["SOLIDUS_ALL_NOTEBOOKS"].split()), [folder.name for folder in FOLDERS])

    def test_notebooks_run_from_their_first_cell_to_their_last(self):
        for name in CHOSEN:
            with self.subTest(notebook=name):
                source = SOURCES / "cases" / name
                code = (source / "notebook.ipynb").read_text()
                if not sc.has_core() and not os.environ.get("SOLIDUS_EXPECT_CORE") and any(
                        word in code for word in ("sc.material(", "sc.Simulation(")):
                    self.skipTest("the compiled part of the package was not built")
                folder = self.folder / "cases" / name
                shutil.copytree(source, folder)
                environment = {**os.environ, "PYTHONPATH": str(SOURCES / "python"), "MPLBACKEND": "Agg"}
                done = subprocess.run([sys.executable, Path(__file__).with_name("run_notebook.py"), "notebook.ipynb"], cwd=folder,
                                      env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
                self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-4000:])


if __name__ == "__main__":
    unittest.main()
