"""`solidus new --process shell` on five parts, from their STEP files and from STL files of the castings that these gave: cases that answer
without editing, by heat alone, and freeze in the same time."""

import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import unittest

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from solidus_plots import vtu  # noqa: E402
from solidus_plots.triangle_surface import Surface, write_stl  # noqa: E402

TETRAHEDRON, SIDES = 10, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))  # VTK's number, outward sides
PARTS = [
    ("dumbbell", "tin_bronze"),
    ("flange", "low_carbon_steel"),
    ("hook", "low_carbon_steel"),
    ("impeller", "tin_bronze"),
    ("stepped_plate", "aluminium_alsi7mg"),
]
FINENESS = "0.4"
SAME = 0.1  # of the time to freeze: two coarse meshes of one part


def casting_surface(folder):
    """Points [m] and outward triangles of the first body of a run."""
    _, files = vtu.read_collection(folder / "fields.pvd")
    grid = vtu.read_fields(files[-1])
    numbers, cells = grid.cells(TETRAHEDRON)
    cells = cells[grid.cell_data["body"][numbers] == 0]
    sides = np.concatenate([cells[:, side] for side in SIDES])
    # A side of two tetrahedra is inside.
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return grid.points, sides[first[count == 1]]


class Shells(unittest.TestCase):
    def run_program(self, folder, *arguments):
        done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], *arguments], cwd=folder, capture_output=True, text=True,
                              timeout=3600, check=False)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stdout[-2000:]}{done.stderr}")

    def frozen(self, folder, part, alloy, name):
        """Makes and runs the case of a file.

        @returns the time at which its last melt froze [s]
        """
        self.run_program(folder, "new", str(part), "--process", "shell", "--alloy", alloy, "--fineness", FINENESS, "-o", name)
        self.run_program(folder, "run", name, "--heat-only", "--no-progress", "-o", f"out_{name}")
        casting, = json.loads((folder / f"out_{name}/summary.json").read_text())["answers"]["castings"].values()
        self.assertEqual(casting["solid_fraction"], 1)
        return casting["last_melt_froze"]["value[s]"]

    def test_parts_answer_from_step_and_from_stl(self):
        for part, alloy in PARTS:
            with self.subTest(part=part):
                folder = Path(os.environ["SOLIDUS_FOLDER"]) / "shells" / part
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir(parents=True)
                step = self.frozen(folder, ROOT / f"tests/parts/{part}.step", alloy, "step")
                points, triangles = casting_surface(folder / "out_step")
                self.assertGreater(Surface(points, triangles).volume(), 0)
                write_stl(folder / f"{part}.stl", points, triangles)
                stl = self.frozen(folder, folder / f"{part}.stl", alloy, "stl")
                print(f"{part}: frozen after {step:.4g} s from STEP, {stl:.4g} s from STL", flush=True)
                self.assertLess(abs(stl / step - 1), SAME)


if __name__ == "__main__":
    unittest.main()
