"""Feeding with heat alone compared with the coupled run, and with itself with half the elements, on four castings."""

import csv
import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import unittest

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(Path(__file__).parent)]

from feeding_castings import CASTINGS, case, geometry  # noqa: E402
from solidus_plots.vtu import read_collection, read_fields  # noqa: E402

HOLES = ("pipe", "sink", "cavity", "pores")
TWICE = 0.1  # by which holes of the coupled run may differ: the aim is 15 %
HALVED_ALL, HALVED_LARGEST = 0.01, 0.05  # by which half the elements may change all holes, and the largest


def holes_of_heat(folder):
    """Volumes of holes by kind, and what the solid has contracted by [m3]."""
    with (folder / "feeding.csv").open() as file:
        last = list(csv.DictReader(file))[-1]
    return {kind: float(last[f"{kind}[m3]"]) for kind in HOLES}, float(last["outside[m3]"])


def largest_hole(folder):
    """Volume [m3] and place [m] of the largest hole that the summary names; of a pipe its lowest place."""
    found = json.loads((folder / "summary.json").read_text())["criteria"]
    names = [f"{kind}_1_volume" for kind in ("pipe", "cavity", "sink") if f"{kind}_1_volume[m3]" in found]
    name = max(names, key=lambda one: found[f"{one}[m3]"])
    return found[f"{name}[m3]"], np.array(found[f"{name}_at[m]"])


def holes_of_coupled_run(folder, contracted):
    """Pores and what the skin of the casting was drawn in by, beyond the contraction of the solid [m3]."""
    grid = read_fields(read_collection(folder / "fields.pvd")[1][-1])
    starts = grid.offsets - np.diff(grid.offsets, prepend=0)
    cells = np.flatnonzero(grid.cell_data["body"] == 0)
    corners = grid.connectivity[starts[cells][:, None] + np.arange(3)]
    x = grid.points[corners][:, :, :2]
    u = np.asarray(grid.point_data["displacement"]).reshape(len(grid.points), -1)[corners][:, :, :2]
    edges = np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=1)  # [cell, edge, direction]
    moved = np.stack([u[:, 1] - u[:, 0], u[:, 2] - u[:, 0]], axis=1)
    area = 0.5 * np.abs(np.linalg.det(edges))
    growth = np.trace(np.linalg.solve(edges, moved), axis1=1, axis2=2)  # div u
    pores = float((area * np.asarray(grid.cell_data["pore_fraction"])[cells]).sum())
    return pores, float(-(area * growth).sum()) - contracted


class FeedingTwice(unittest.TestCase):
    def run_case(self, folder, name, *more):
        out = folder / name
        done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], "run", str(folder / "case.toml"), "--no-progress", "-o", str(out),
                               *more], capture_output=True, text=True, timeout=1800, check=False)
        self.assertEqual(done.returncode, 0, done.stdout[-1000:] + done.stderr)
        return out

    def setUp(self):
        self.folder = Path(os.environ["SOLIDUS_FOLDER"]) / "feeding_twice"
        shutil.rmtree(self.folder, ignore_errors=True)

    def made(self, section):
        folder = self.folder / section.name
        folder.mkdir(parents=True)
        (folder / f"{section.name}.geo").write_text(geometry(section))
        (folder / "case.toml").write_text(case(section))
        return folder

    def test_the_coupled_run_has_the_same_holes(self):
        for section in CASTINGS:
            with self.subTest(casting=section.name):
                folder = self.made(section)
                holes, contracted = holes_of_heat(self.run_case(folder, "heat", "--heat-only"))
                pores, drawn_in = holes_of_coupled_run(self.run_case(folder, "coupled", "--coupled"), contracted)
                alone = sum(holes.values())
                print(f"{section.name}: heat alone {1e6 * alone:.4g} cm3 ("
                      + ", ".join(f"{kind} {1e6 * volume:.4g}" for kind, volume in holes.items())
                      + f"); coupled {1e6 * (pores + drawn_in):.4g} cm3 (pores {1e6 * pores:.4g}, skin drawn in "
                        f"{1e6 * drawn_in:.4g})", flush=True)
                self.assertLess(abs(pores + drawn_in - alone), TWICE * alone)

    def test_half_the_elements_change_little(self):
        for section in CASTINGS:
            with self.subTest(casting=section.name):
                folder = self.made(section)
                coarse, fine = (self.run_case(folder, f"size_{size:g}", "--heat-only", "--set",
                                              f'mesh.constant=[{{name="size",value={size}}}]') for size in (3, 1.5))
                sums = [sum(holes_of_heat(one)[0].values()) for one in (coarse, fine)]
                (one, here), (other, there) = largest_hole(coarse), largest_hole(fine)
                print(f"{section.name}: all holes {1e6 * sums[0]:.4g} and {1e6 * sums[1]:.4g} cm3, the largest {1e6 * one:.4g} "
                      f"and {1e6 * other:.4g} cm3, {1e3 * np.linalg.norm(here - there):.2g} mm apart", flush=True)
                self.assertLess(abs(sums[0] - sums[1]), HALVED_ALL * sums[1])
                self.assertLess(abs(one - other), HALVED_LARGEST * other)
                self.assertLess(np.linalg.norm(here - there), 3e-3)


if __name__ == "__main__":
    unittest.main()
