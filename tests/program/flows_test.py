"""Flows by the solver of `solidus fill` against what is known of them: rest, a rising level, a dam that breaks, a U-tube, metal that
freezes on its way, half the cube. By night those that take longer (docs/verification/filling.md)."""

import json
import os
import shutil
import subprocess
import unittest

import numpy as np

from flow_scenes import ALUMINIUM, WATER, Scene, box
from pages import blocks
from program import PROGRAM, SOURCES, ProgramTest
from solidus_plots import filling_dictionaries as dictionaries
from solidus_plots.filling_age import Ages
from solidus_plots.vtu import read_fields

FOUND = shutil.which("icoReactingMultiphaseInterFoam")
MISSING = "OpenFOAM is not installed (Debian's openfoam)"
NIGHTLY = bool(os.environ.get("SOLIDUS_NIGHTLY"))
AT_NIGHT = "a minute or more: ./dev nightly"

G = 9.81
# J. C. Martin, W. J. Moyce, Phil. Trans. R. Soc. Lond. A 244 (1952) 312-324, tables 2 and 6: a column of the width a and the height 2 a.
# Front z/a over t sqrt(2 g/a), height over 2 a over t sqrt(g/a).
FRONT = ((0.41, 1.11), (0.84, 1.22), (1.19, 1.44), (1.43, 1.67), (1.63, 1.89), (1.83, 2.11), (1.98, 2.33), (2.20, 2.56), (2.32, 2.78),
         (2.51, 3.00), (2.65, 3.22), (2.83, 3.44), (2.98, 3.67), (3.11, 3.89), (3.33, 4.11))
HEIGHT = ((0.56, 0.94), (0.77, 0.89), (0.93, 0.83), (1.08, 0.78), (1.28, 0.72), (1.46, 0.67), (1.66, 0.61), (1.84, 0.56), (2.00, 0.50),
          (2.21, 0.44), (2.45, 0.39))


@unittest.skipUnless(FOUND, MISSING)
class Flows(ProgramTest):
    def test_metal_at_rest_stays_so_and_has_the_pressure_of_its_depth(self):
        scene = Scene(box(6, 1, 12), 0.005, ALUMINIUM, metal=lambda x: x[:, 2] < 6)
        c = scene.cubes.cells
        for _, read in scene.frames(self.folder / "rest", 0.1, 0.1):
            deeper = read("p")[(c[:, 0] == 2) & (c[:, 2] == 0)] - read("p")[(c[:, 0] == 2) & (c[:, 2] == 8)]
            # From half a cube above the bottom to the level, and air above it.
            self.assertAlmostEqual(deeper[0] / (G * (2500 * 0.0275 + 0.0125)), 1, delta=1e-5)
            self.assertLess(np.abs(read("U")).max(), 2e-3)
            self.assertLess(np.abs(read("alpha.melt") - (c[:, 2] < 6)).max(), 1e-4)

    def test_a_box_that_is_filled_from_below_has_its_level(self):
        scene = Scene(box(4, 4, 10), 0.005, ALUMINIUM, gate=lambda x, d: d[:, 2] < 0, vent=lambda x, d: d[:, 2] > 0, speed=(0, 0, 0.1))
        for time, read in scene.frames(self.folder / "rise", 0.3, 0.1):
            metal = read("alpha.melt")
            # What came, and the same in all columns; nothing takes heat.
            self.assertAlmostEqual(metal.sum() * 0.005 / 16 / (0.1 * time), 1, delta=1.5e-3)
            columns = [metal[(scene.cubes.cells[:, 0] == i) & (scene.cubes.cells[:, 1] == j)].sum() * 0.005 for i in range(4) for j in range(4)]
            self.assertLess(np.ptp(columns), 1e-3 * 0.1 * time)
            self.assertLess(np.abs(read("T") - 980).max(), 1e-6)

    def test_metal_in_a_straight_duct_is_as_old_as_its_way_is_long(self):
        """0.5 m/s along slipping walls; behind the first cubes of the front the age is distance over speed."""
        speed, edge, n = 0.5, 0.005, 16
        scene = Scene(box(n, 3, 3), edge, ALUMINIUM, gate=lambda x, d: d[:, 0] < 0, vent=lambda x, d: d[:, 0] > 0, speed=(speed, 0, 0),
                      gravity=(0, 0, -1e-4))
        frames = list(scene.frames(self.folder / "duct", 0.14, 0.01))
        along = scene.cubes.cells[:, 0]
        ages, age, metal, before, last = Ages(scene.cubes, np.flatnonzero(along == 0), [1, 0, 0]), np.zeros(9 * n), np.zeros(9 * n), None, 0.0
        for time, read in frames:
            velocity, now = read("U"), np.clip(read("alpha.melt"), 0, 1)
            age = ages.step(age, velocity if before is None else before, velocity, metal, now, time - last)
            metal, before, last = now, velocity, time
        true = (along + 0.5) * edge / speed
        self.assertLess(np.abs(age - true)[true < 0.08].max(), 1e-3)
        self.assertLess(np.abs(age - true)[metal > 0.99].max(), edge / speed)

    @unittest.skipUnless(NIGHTLY, AT_NIGHT)
    def test_a_dam_that_breaks_runs_as_martin_and_moyce_measured(self):
        n, a = 10, 0.05715
        scene = Scene(box(5 * n, 1, 25), a / n, WATER, metal=lambda x: (x[:, 0] < n) & (x[:, 2] < 2 * n), hot=293.0, air=293.0)
        c, times, fronts, heights = scene.cubes.cells, [0.0], [1.0], [1.0]
        for time, read in scene.frames(self.folder / "dam", 0.19, 0.005):
            metal = read("alpha.melt")
            floor = metal[c[:, 2] == 0]
            last = np.flatnonzero(floor > 0.5).max()
            fronts.append((last + 0.5 + (floor[last] - 0.5) / (floor[last] - floor[last + 1])) / n)
            heights.append(metal[c[:, 0] == 0].sum() / (2 * n))
            times.append(time)
        self.assertAlmostEqual(metal.sum() / (2 * n * n), 1, delta=1e-6)
        for t, z in FRONT:
            # The gate of the experiment takes its time; the front is early by it, and on smooth ground.
            self.assertAlmostEqual(np.interp(t * np.sqrt(a / (2 * G)), times, fronts) / z, 1, delta=0.15 if t < 2 else 0.08)
        for t, h in HEIGHT:
            self.assertAlmostEqual(np.interp(t * np.sqrt(a / G), times, heights), h, delta=0.03)

    @unittest.skipUnless(NIGHTLY, AT_NIGHT)
    def test_metal_swings_in_a_u_tube(self):
        """Two legs joined below, and above for the air: half a period is pi sqrt(L/2g), L the length of the metal along its middle."""
        w, edge = 4, 0.005
        cells = np.array([(x, 0, z) for x in range(3 * w) for z in range(8 * w) if z < w or z >= 7 * w or x < w or x >= 2 * w])
        scene = Scene(cells, edge, ALUMINIUM, metal=lambda x: np.where(x[:, 0] < w, x[:, 2] < 5 * w, x[:, 2] < 4 * w))
        c, times, levels = scene.cubes.cells, [], []
        for time, read in scene.frames(self.folder / "tube", 0.6, 0.02):
            metal = read("alpha.melt")
            levels.append(metal[c[:, 0] < w].sum() - metal[c[:, 0] >= 2 * w].sum())
            times.append(time)
        still = [times[i] + 0.02 * levels[i] / (levels[i] - levels[i + 1]) for i in range(len(levels) - 1) if levels[i] * levels[i + 1] < 0]
        length = (2 * 4 + 2) * w * edge
        self.assertAlmostEqual((still[1] - still[0]) / (np.pi * np.sqrt(length / (2 * G))), 1, delta=0.05)
        self.assertAlmostEqual(2 * still[0] / (still[1] - still[0]), 1, delta=0.05)

    @unittest.skipUnless(NIGHTLY, AT_NIGHT)
    def test_metal_that_runs_along_a_cold_channel_freezes_where_it_should(self):
        """In a square channel of the width d it cools as exp(-4 h x/(rho c d u)); where it comes to its freezing temperature the program
        tells a misrun. Twice, with cubes and steps halved."""
        d, speed, h, mould = 0.008, 0.5, 5000.0, 300.0
        expected = speed * ALUMINIUM.density * ALUMINIUM.heat * d / (4 * h) * np.log((980 - mould) / (ALUMINIUM.freezing - mould))
        for across, step in ((2, 2e-3), (4, 1e-3)):
            n, edge = 25 * across, d / across
            scene = Scene(box(n, across, across), edge, ALUMINIUM, gate=lambda x, d: d[:, 0] < 0, vent=lambda x, d: d[:, 0] > 0,
                          speed=(speed, 0, 0), gravity=(0, 0, -1e-4), air=mould, step=step,
                          walls={"free": dictionaries.wall_entry(h, mould, mould)})
            along, arrival = scene.cubes.cells[:, 0], np.full(n * across ** 2, np.nan)
            for time, read in scene.frames(self.folder / f"channel{across}", 0.36, 0.01):
                new = np.isnan(arrival) & (read("alpha.melt") + read("alpha.solid") > 0.5)
                arrival[new] = read("T")[new]
            front = np.array([np.nanmean(arrival[along == i]) for i in range(n) if np.isfinite(arrival[along == i]).any()])
            self.assertAlmostEqual((np.flatnonzero(front < ALUMINIUM.freezing)[0] + 0.5) * edge / expected, 1, delta=0.2)
            steady = np.array([read("T")[along == i].mean() for i in range(n)])
            self.assertAlmostEqual((np.flatnonzero(steady < ALUMINIUM.freezing + 1)[0] + 0.5) * edge / expected, 1, delta=0.2)


@unittest.skipUnless(FOUND and NIGHTLY, MISSING if not FOUND else AT_NIGHT)
class Fillings(ProgramTest):
    def setUp(self):
        super().setUp()
        page = (SOURCES / "docs/guide/filling.md").read_text()
        (self.folder / "case.toml").write_text(next(block.text for block in blocks(page) if block.text.startswith('title = "A plate on a die"')))

    def filled(self, name, *more):
        """The corners of the cubes and their times of arrival."""
        self.done("fill", "case.toml", "-o", name, "--processes", "1", *more, timeout=1200)
        grid = read_fields(self.folder / name / "filling.vtu")
        return grid.points[np.asarray(grid.connectivity).reshape(-1, 8)], np.asarray(grid.cell_data["fill_time"])

    DRIVES = {
        "head": ["head='100 mm'"],
        "pressure": ["times=['0 s', '1 s']", "pressure=['0 Pa', '1500 Pa']"],
        "shot": ["times=['0 s', '0.3 s', '0.35 s']", "speed=['0.1 m/s', '0.1 m/s', '1 m/s']"],
        "tilt": ["time='2 s'", "times=['0 s', '2 s']", "tilt=['0 degree', '90 degree']", "tilt_axis=[0, 1, 0]"],
    }

    def summary(self, name):
        return json.loads((self.folder / name / "filling.json").read_text())

    def test_whatever_drives_the_metal_two_processes_and_a_restart_give_the_same(self):
        case = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text("".join(line for line in case.splitlines(True) if not line.startswith("time = ")))
        for drive, keys in self.DRIVES.items():
            with self.subTest(drive):
                keys = [word for key in keys for word in ("--set", f"filling.{key}")]
                self.done("fill", "case.toml", "-o", f"{drive}_1", "--processes", "1", *keys, timeout=1200)
                self.done("fill", "case.toml", "-o", f"{drive}_2", "--processes", "2", *keys, timeout=1200)
                self.stopped(f"{drive}_stopped", keys)
                self.done("fill", "case.toml", "-o", f"{drive}_stopped", "--restart", "--processes", "1", *keys, timeout=1200)
                one, two, resumed = (self.summary(f"{drive}_{name}") for name in ("1", "2", "stopped"))
                self.assertGreater(one["full"], 0.98)
                # A restart gives the same to the last digit; on two processes sums are in another order.
                self.assertEqual((resumed["time"], resumed["full"], resumed["balance"]), (one["time"], one["full"], one["balance"]))
                self.assertAlmostEqual(two["balance"]["there"] / one["balance"]["there"], 1, delta=2e-3)
                self.assertAlmostEqual(two["balance"]["lost"] / one["balance"]["lost"], 1, delta=0.03)

    def stopped(self, name, keys):
        """A filling that a signal ends when it is on its way."""
        run = subprocess.Popen([str(PROGRAM), "fill", "case.toml", "-o", name, "--processes", "1", *keys], cwd=self.folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for line in run.stdout:
            if line.strip().startswith("40 % of the time"):
                run.terminate()
        self.assertEqual(run.wait(timeout=100), 130)
        run.stdout.close()

    def test_half_the_cube_gives_nearly_the_same_filling(self):
        gate = ("--set", "filling.gate_width='12 mm'")  # of itself it is four cubes wide
        coarse_corners, coarse = self.filled("coarse", *gate)
        fine_corners, fine = self.filled("fine", *gate, "--set", "filling.cells=2400")
        # Each coarse cube against the mean of the fine ones whose middles it holds.
        half = 0.5 * np.ptp(coarse_corners[0, :, 0])
        away = np.abs(coarse_corners.mean(axis=1)[:, None] - fine_corners.mean(axis=1)[None])
        inside = (away < half + 1e-9).all(axis=2)
        apart = np.abs((inside * fine).sum(axis=1) / inside.sum(axis=1) - coarse) / coarse.max()
        self.assertLess(apart.mean(), 0.07)
        self.assertLess(np.median(apart), 0.05)


if __name__ == "__main__":
    unittest.main()
