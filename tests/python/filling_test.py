"""Cubes of a cavity, gates, vents, walls and the start of freezing, without a flow: `solidus fill`."""

import ctypes
import json
from math import exp, sqrt
from pathlib import Path
import signal
import tempfile
from types import SimpleNamespace
import unittest
from unittest import mock

import numpy as np

from solidus_plots import filling_dictionaries as dictionaries
from solidus_plots import fill, filling_film, filling_flow, filling_gates, filling_trust, filling_walls
from solidus_plots.filling_age import Ages
from solidus_plots.filling_cavity import cavity_of
from solidus_plots.filling_drive import Drive, Tilt
from solidus_plots.filling_history import full_volume, with_heat_of, with_returned_heat
from solidus_plots.filling_mesh import Cubes, inner_faces, write_mesh
from solidus_plots.filling_results import places_of, start_of, state_at
from solidus_plots.filling_view import View, to_bytes
from solidus_plots.filling_view import write as write_view
from solidus_plots.vtu import Grid, ResultError

UP = np.array([0.0, 0.0, 1.0])


def blocks(size, counts, inside):
    """A grid of bricks over a box: body 0 where inside(centre) holds, else body 1."""
    axes = [np.linspace(0, length, n + 1) for length, n in zip(size, counts)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    i, j, k = (a.ravel() for a in np.meshgrid(*map(np.arange, counts), indexing="ij"))

    def node(x, y, z):
        return (x * (counts[1] + 1) + y) * (counts[2] + 1) + z

    corners = np.stack([node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                        node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)], axis=1)
    grid = Grid(points, np.full(len(corners), 12), 8 * np.arange(1, len(corners) + 1), corners.ravel())
    grid.cell_data = {"body": np.where(inside(points[corners].mean(axis=1)), 0, 1)}
    return grid


def plate(edge=0.005):
    """A plate of 100 x 20 x 60 mm in the middle of a block of sand."""
    low, high = np.array([0.03, 0.03, 0.03]), np.array([0.13, 0.05, 0.09])
    return cavity_of(blocks((0.16, 0.08, 0.12), (32, 16, 24), lambda x: ((x > low) & (x < high)).all(axis=1)), [0], edge)


class Cavities(unittest.TestCase):
    def test_a_plate_has_its_volume_and_its_skin_whatever_the_cubes(self):
        for edge in (0.005, 0.0043, 0.0062):
            cavity = plate(edge)
            self.assertAlmostEqual(cavity.cubes.volume(), 0.1 * 0.02 * 0.06, delta=1e-12)
            self.assertAlmostEqual(cavity.area.sum(), 2 * (0.1 * 0.02 + 0.1 * 0.06 + 0.02 * 0.06), delta=1e-12)
            self.assertAlmostEqual(cavity.scale, 1, delta=0.1)
            self.assertTrue((cavity.touches == 1).all())

    def test_stairs_give_off_heat_for_the_slope_that_they_stand_for(self):
        """A wedge: of a slope of 0.8 in 1 the stairs have 1.8 times the area of its foot, the slope 1.28 times."""
        grid = blocks((0.08, 0.02, 0.08), (16, 4, 16), lambda x: x[:, 0] > -1)
        grid.points[:, 2] *= 1 - grid.points[:, 0] / 0.1  # the top falls by 0.8 m a metre
        cavity = cavity_of(grid, [0], 0.002)
        centres = cavity.face_centres()
        slope = (np.abs(centres[:, 2] - 0.08 * (1 - centres[:, 0] / 0.1)) < 0.003) & (centres[:, 0] > 0.01) & (centres[:, 0] < 0.06) \
            & (np.abs(centres[:, 1] - 0.01) < 0.006)
        share = cavity.area[slope].sum() / (slope.sum() * cavity.cubes.edge ** 2)
        self.assertAlmostEqual(share, 1.2806 / 1.8, delta=0.05)  # sqrt(1 + 0.8^2)/(1 + 0.8)

    def test_a_mesh_of_cubes_is_closed_and_in_the_order_of_openfoam(self):
        cubes = Cubes(np.zeros(3), 0.01, np.argwhere(np.ones((3, 2, 2))))
        owners, neighbours, _ = inner_faces(cubes)
        self.assertTrue((owners < neighbours).all())
        self.assertEqual(sorted(zip(owners, neighbours)), list(zip(owners, neighbours)))
        faces, directions = cubes.skin()
        self.assertEqual(len(owners) * 2 + len(faces), 6 * 12)
        self.assertEqual(np.abs(directions.sum(axis=0)).sum(), 0)
        with tempfile.TemporaryDirectory() as folder:
            write_mesh(Path(folder), cubes, [("skin", "wall", faces, directions)])
            self.assertEqual(filling_flow.boundary_of(Path(folder)), {"skin": (len(faces), len(owners))})
            self.assertEqual(len(filling_flow.numbers_of(Path(folder) / "constant/polyMesh/owner")), len(owners) + len(faces))


class Gates(unittest.TestCase):
    def test_the_chosen_gate_lies_low_and_vents_on_the_highest_places(self):
        cavity = plate()
        gate = filling_gates.gate_of(cavity, {}, [], UP, 1e-4)
        heights = cavity.face_centres()[:, 2]
        self.assertLess(heights[gate.faces].max(), 0.06)
        self.assertGreaterEqual(len(gate.faces), filling_gates.FEW)
        vents, _ = filling_gates.vents_of(cavity, {"vents": []}, [UP], gate)
        self.assertTrue((heights[vents] > 0.0895).all())
        walls = filling_gates.walls_of(cavity, gate, vents)
        self.assertEqual(len(gate.faces) + len(vents) + sum(map(len, walls.values())), len(cavity.faces))
        self.assertEqual(sum(map(len, filling_gates.by_body(cavity, vents).values())), len(vents))

    def test_every_horn_has_a_vent(self):
        """Two legs that rise from a bar: air would be caught in both."""
        cavity = cavity_of(blocks((0.06, 0.02, 0.06), (12, 4, 12), lambda x: (x[:, 2] < 0.02) | (np.abs(x[:, 0] - 0.03) > 0.015)), [0], 0.005)
        gate = filling_gates.gate_of(cavity, {"gate_at": [0.03, 0.01, 0.0]}, [], UP, 1e-4)
        vents, _ = filling_gates.vents_of(cavity, {"vents": []}, [UP], gate)
        tops = cavity.face_centres()[vents]
        for x in (0.01, 0.05):
            self.assertTrue(((np.abs(tops[:, 0] - x) < 0.01) & (tops[:, 2] > 0.055)).any())

    def test_a_gate_at_a_point_is_a_square_there(self):
        cavity = plate()
        gate = filling_gates.gate_of(cavity, {"gate_at": [0.03, 0.04, 0.06], "gate_width": 0.02}, [], UP, 1e-4)
        self.assertEqual(gate.direction.tolist(), [1, 0, 0])
        self.assertAlmostEqual(cavity.face_centres()[gate.faces][:, 2].mean(), 0.06, delta=0.003)


    def test_a_gate_far_from_the_casting_is_refused(self):
        with self.assertRaisesRegex(ResultError, "the gate is 500 mm away"):
            filling_gates.gate_of(plate(), {"gate_at": [0.03, 0.04, 0.59]}, [], UP, 1e-4)


class Films(unittest.TestCase):
    def test_a_film_shows_an_upright_layer(self):
        cavity = plate()
        self.assertEqual(filling_film.upright_plane(cavity, UP)[0], 1)
        self.assertEqual(filling_film.upright_plane(cavity, np.array([0.0, 1.0, 0.0]))[0], 2)

    def test_a_film_is_written(self):
        cavity = plate(0.01)
        mould = SimpleNamespace(cavity=cavity, up=UP, gate=SimpleNamespace(faces=np.array([0])))
        with tempfile.TemporaryDirectory() as name:
            levels = [np.full(len(cavity.cubes.cells), level, np.uint8) for level in (0, 128, 255)]
            filling_film.draw(Path(name) / "filling.gif", mould, [0.1, 0.2, 0.3], levels)
            self.assertEqual((Path(name) / "filling.gif").read_bytes()[:4], b"GIF8")


class Walls(unittest.TestCase):
    def test_heat_into_a_half_space_behind_a_film(self):
        """The mean of h erfcx(h sqrt(t)/e) against Simpson's rule; h at the start, e/sqrt(pi t) in the end."""
        h, e = 1000.0, 1200.0
        times = np.linspace(0.5, 1.5, 2001)
        values = np.array([h * filling_walls.erfcx(h * sqrt(t) / e) for t in times])
        simpson = (values[0] + values[-1] + 4 * values[1:-1:2].sum() + 2 * values[2:-2:2].sum()) / 6000
        self.assertAlmostEqual(float(filling_walls.mean_conductance(h, e, np.array([0.5]), np.array([1.5]))[0]), simpson, delta=1e-4 * simpson)
        self.assertAlmostEqual(float(filling_walls.mean_conductance(h, e, np.array([0.0]), np.array([1e-9]))[0]), h, delta=1e-3 * h)
        self.assertAlmostEqual(float(filling_walls.mean_conductance(h, e, np.array([1e5]), np.array([1.001e5]))[0]),
                               e / sqrt(np.pi * 1.0005e5), delta=0.01)
        self.assertAlmostEqual(filling_walls.erfcx(1), exp(1) * 0.15729920705, delta=1e-9)


    def test_a_face_gives_off_heat_by_the_metal_that_touches_it(self):
        """A row of cubes filled from the left up to the middle of the third: the fourth is reached within the stretch."""
        cubes = Cubes(np.zeros(3), 0.01, np.array([[i, 0, 0] for i in range(6)]))
        wet = filling_walls.wetted(cubes, np.array([1.0, 1.0, 0.5, 0.0, 0.0, 0.0]))
        self.assertEqual(wet.tolist(), [1, 1, 0.75, 0.25, 0, 0])


    def test_heat_of_a_stretch_is_that_of_the_film_and_half_a_cube(self):
        """Metal that cools from 900 to 700 K in 0.1 s before a wall of 300 K, by straight lines, and as a cube of air does."""
        cavity = SimpleNamespace(faces=np.array([0, 1]), area=np.full(2, 1e-4), cubes=SimpleNamespace(edge=0.01))
        wall = filling_walls.Wall("wall_1", 1, np.array([0, 1]), 1000.0, 1e9, 300.0, cavity)
        wall.begin(0.1, np.ones(2))
        moments = [(0.0, np.array([900.0, 900.0]), np.array([50.0, 0.03])), (0.1, np.array([700.0, 700.0]), np.array([50.0, 0.03]))]
        wall.end(moments, np.array([1.0, 0.0]), 90.0, 0.03)
        for heat, conductivity in zip(wall.heat, (50.0, 0.03)):
            self.assertAlmostEqual(heat / (500 * 1e-4 * 0.1 / (1 / 1000 + 0.005 / conductivity)), 1, delta=1e-6)
        self.assertEqual(wall.contact.tolist(), [0.1, 0])


class Files(unittest.TestCase):
    def test_fields_of_openfoam_are_read_in_all_their_forms(self):
        read = filling_flow.values_in
        self.assertEqual(read(" uniform 3;", 2).tolist(), [3, 3])
        self.assertEqual(read(" uniform (1 2 3);", 2).tolist(), [[1, 2, 3]] * 2)
        self.assertEqual(read(" nonuniform List<scalar> \n2\n(\n1.5\n2.5\n)\n;", 2).tolist(), [1.5, 2.5])
        self.assertEqual(read(" nonuniform List<scalar> 2(1.5 2.5);", 2).tolist(), [1.5, 2.5])
        self.assertEqual(read(" nonuniform List<scalar> 3{7};", 3).tolist(), [7, 7, 7])
        self.assertEqual(read(" nonuniform List<vector> \n2\n(\n(1 2 3)\n(4 5 6)\n)\n;", 2).tolist(), [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(read(" nonuniform List<vector> 1((1 2 3));", 1).tolist(), [[1, 2, 3]])

    def test_what_openfoam_says_is_told_in_a_sentence(self):
        self.assertEqual(filling_flow.reason_in("--> FOAM FATAL ERROR : \n    Could not find entry\n    'x'\n\n    From f"),
                         "OpenFOAM stopped: Could not find entry 'x'")
        self.assertIn("blew up at 0.2 s", filling_flow.reason_in("Time = 0.2\n#0 Foam::sigFpe::sigHandler"))

    def test_cells_are_changed_on_all_parts(self):
        with tempfile.TemporaryDirectory() as name:
            run = filling_flow.FoamRun.__new__(filling_flow.FoamRun)
            run.n_cells, run.parts = 3, [filling_flow.Part(Path(name) / part, np.array(cells), {}) for part, cells in (("a", [2, 0]), ("b", [1]))]
            for part in run.parts:
                (part.folder / "1").mkdir(parents=True)
                (part.folder / "1/T").write_text("internalField   uniform 3;\n\nboundaryField\n{\n    wall\n    {\n        type x;\n    }\n}\n")
            run.change_cells("1", "T", np.array([1.5, 2.5, 3.5]))
            self.assertEqual(run.read("1", "T").tolist(), [1.5, 2.5, 3.5])
            self.assertIn("type x;", (run.parts[0].folder / "1/T").read_text())


    def test_a_file_that_is_rewritten_is_never_half_a_file(self):
        with tempfile.TemporaryDirectory() as name:
            file = Path(name) / "U"
            file.write_text("whole")
            with mock.patch.object(Path, "replace", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
                filling_flow.rewrite(file, "other")
            self.assertEqual(file.read_text(), "whole")
            filling_flow.rewrite(file, "other")
            self.assertEqual(file.read_text(), "other")


class Vents(unittest.TestCase):
    def test_as_much_gas_leaves_as_metal_comes_from_where_gas_is(self):
        speeds = dictionaries.vent_speeds(np.array([1.0, 0.5, 0.0]), 3e-5, 1e-5)
        self.assertAlmostEqual(speeds.sum() * 1e-5, 3e-5, delta=1e-18)
        self.assertAlmostEqual(speeds[0] / speeds[1], 2, delta=1e-9)
        self.assertEqual(speeds[2], 0)
        self.assertAlmostEqual(dictionaries.vent_speeds(np.zeros(4), 4.0, 1.0)[0], 1, delta=1e-12)  # no gas: all alike

    def test_air_that_has_not_come_up_leaves_by_the_vents_above_it(self):
        cubes = Cubes(np.zeros(3), 0.01, np.argwhere(np.ones((5, 1, 3), bool)))
        top = cubes.number(np.array([[i, 0, 2] for i in range(5)]))
        metal = np.ones(15)
        metal[cubes.number(np.array([3, 0, 0]))] = 0.4
        air = fill.air_near(cubes, metal, top)
        self.assertEqual(int(air.argmax()), 3)
        self.assertGreaterEqual(air.max(), dictionaries.SHUT_SHARE)
        # Air at a vent is what it is.
        metal[top[1]] = 0.7
        self.assertEqual(fill.air_near(cubes, metal, top).round(9).tolist(), [0, 0.3, 0, 0, 0])

    def test_velocities_of_a_vent_are_read_back(self):
        text = dictionaries.vent_velocity(np.array([[0, 0, 0.5], [0, -0.25, 0]]))
        self.assertEqual(filling_flow.values_in(text[text.index("value ") + 6:], 2).tolist(), [[0, 0, 0.5], [0, -0.25, 0]])

    def test_processes_get_slices_across_an_axis(self):
        """Debian's openfoam comes without the library of scotch."""
        with tempfile.TemporaryDirectory() as name:
            dictionaries.write_numerics(Path(name), 3, axis=1)
            text = (Path(name) / "system/decomposeParDict").read_text()
        self.assertIn("method simple;", text)
        self.assertIn("n (1 3 1);", text)

    def test_no_function_object_and_no_expression(self):
        """Debian 13's build of OpenFOAM 1912 ends at the first of them."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            flow = dictionaries.Flow((0, 0, -9.81), (0, 0, 0.1), 970.0, 300.0, 100.0, 1e-3)
            dictionaries.write_control(folder, flow, 1, 0.01)
            dictionaries.write_fields(folder, flow, {"vent_1": dictionaries.INSULATING})
            self.assertIn("\n    vent_1\n    {", (folder / "0/U").read_text())
            for file in (*folder.glob("system/*"), *folder.glob("0/*")):
                self.assertNotRegex(file.read_text(), "functions|expr|coded")


class Drives(unittest.TestCase):
    """A plate of 60 mm whose gate is a square of 20 mm in the middle of its lower face."""

    def drive(self, filling, flow=1e-4):
        cavity = plate()
        gate = filling_gates.gate_of(cavity, {"gate_at": [0.08, 0.04, 0.03], "gate_width": 0.02}, [], UP, flow)
        return Drive(filling, cavity, gate, 2500.0, flow, Tilt(filling, [0.0, 0.0, -9.81]))

    def test_a_steady_rate_takes_volume_over_flow(self):
        drive = self.drive({})
        self.assertAlmostEqual(drive.time, 1.2e-4 / 1e-4, delta=1e-9)
        self.assertAlmostEqual(drive.next(0.3, 3e-5, 1e-6), 0.01, delta=1e-12)

    def test_a_shot_is_slow_and_then_fast(self):
        """0.1 m/s for 1 s and 1 m/s from 1.1 s on: the integral of straight lines."""
        drive = self.drive({"times": [0, 1, 1.1], "speed": [0.1, 0.1, 1.0]})
        slow, ramp = 0.1 * drive.area, 0.055 * drive.area
        self.assertLess(slow + ramp, drive.volume)
        self.assertAlmostEqual(drive.time, 1.1 + (drive.volume - slow - ramp) / drive.area, delta=1e-6)
        self.assertAlmostEqual(drive.next(0, 0, slow), 1, delta=1e-9)
        with self.assertRaisesRegex(ResultError, "bring [0-9]+ % of the cavity"):
            self.drive({"times": [0, 0.1], "speed": [0.2, 0.0]})

    def test_a_head_drives_as_torricelli_says_and_lifts_as_high_as_it_is(self):
        drive = self.drive({"head": 0.5})
        self.assertAlmostEqual(1e-7 / drive.area / drive.next(0, 0, 1e-7), sqrt(2 * 9.81 * 0.5), delta=0.02)
        self.assertIsNone(self.drive({"head": 0.03}).next(1.0, 0.8 * 1.2e-4, 1e-6))
        # What resists slows: R v^2 beside rho/2 v^2.
        drive.observe(0.1, 0.0, 3 * 0.5 * 2500 * 4.0, 2.0)
        drive.observe(0.2, 0.0, 3 * 0.5 * 2500 * 4.0, 2.0)
        self.assertGreater(drive.resistance, 0.5 * 2500)

    def test_low_pressure_lifts_the_metal_as_it_rises(self):
        """Slowly, by 100 Pa a second: the level follows the pressure, and its top is reached when P = rho g z."""
        drive = self.drive({"times": [0, 20], "pressure": [0, 2000]})
        self.assertAlmostEqual(drive.time, 2500 * 9.81 * 0.06 / 100, delta=0.05 * drive.time)

    def test_gravity_turns_the_other_way_than_the_mould(self):
        tilt = Tilt({"times": [0, 2], "tilt": [0, np.pi / 2], "tilt_axis": [0, 1, 0]}, [0.0, 0.0, -9.81])
        np.testing.assert_allclose(tilt.gravity(0), [0, 0, -9.81], atol=1e-12)
        # The top of the mould turns towards x: what falls in it falls towards x.
        np.testing.assert_allclose(tilt.gravity(2), [9.81, 0, 0], atol=1e-12)
        self.assertEqual(len(tilt.positions()), 9)


class Age(unittest.TestCase):
    def filled(self, forward, duration=0.012, speed=0.5, edge=0.005):
        """A duct of 30 cubes whose metal moves as a plug: (age, true age, metal) when it is nearly full."""
        cubes = Cubes(np.zeros(3), edge, np.argwhere(np.ones((30, 3, 3), bool)))
        way = (cubes.cells[:, 0] + 0.5) * edge
        way = way if forward else 30 * edge - way
        sign = 1 if forward else -1
        ages = Ages(cubes, np.flatnonzero(cubes.cells[:, 0] == (0 if forward else 29)), [sign, 0, 0])
        velocity = np.tile([sign * speed, 0.0, 0.0], (len(way), 1))
        age, metal, time = np.zeros(len(way)), np.zeros(len(way)), 0.0
        while speed * (time + duration) < 30 * edge:
            time += duration
            now = np.clip((speed * time - way) / edge + 0.5, 0, 1)
            age, metal = ages.step(age, velocity, velocity, metal, now, duration), now
        return age, way / speed, metal

    def test_in_a_straight_duct_age_is_distance_over_speed(self):
        for forward in (True, False):
            age, true, metal = self.filled(forward)
            # Exactly where metal followed metal; the first of it, which ran ahead as a front, within half a cube and a moment.
            behind = true < 0.1
            self.assertLess(np.abs(age - true)[behind].max(), 1e-9)
            self.assertLess(np.abs(age - true)[metal > 0.99].max(), 0.011)
            self.assertTrue((age[metal < 0.01] == 0).all())

    def test_metal_that_stands_gets_older_by_the_time(self):
        cubes = Cubes(np.zeros(3), 0.01, np.argwhere(np.ones((4, 2, 2), bool)))
        ages, still = Ages(cubes, np.flatnonzero(cubes.cells[:, 0] == 0), [1, 0, 0]), np.zeros((16, 3))
        found = ages.step(np.linspace(0, 1, 16), still, still, np.ones(16), np.ones(16), 0.25)
        self.assertLess(np.abs(found - np.linspace(0.25, 1.25, 16)).max(), 1e-12)

    def test_a_path_that_leads_into_a_wall_stays_before_it(self):
        cubes = Cubes(np.zeros(3), 0.01, np.argwhere(np.ones((4, 2, 2), bool)))
        up = np.tile([0.0, 0.0, 1.0], (16, 1))
        found = Ages(cubes, np.flatnonzero(cubes.cells[:, 0] == 0), [1, 0, 0]).step(np.ones(16), up, up, np.ones(16), np.ones(16), 0.1)
        self.assertLess(np.abs(found - 1.1).max(), 1e-12)


class Shown(unittest.TestCase):
    """What the report gets of a filling."""

    def test_many_cubes_are_joined_with_the_means_of_their_metal(self):
        view = View(Cubes(np.zeros(3), 0.001, np.argwhere(np.ones((30, 30, 30), bool))))
        self.assertEqual((view.factor, len(view.cells), view.edge), (2, 3375, 0.002))
        metal = np.zeros(27000)
        metal[np.arange(27000) % 2 == 0] = 1.0
        view.add(0.1, 0.5, metal, np.where(metal > 0, 900.0, 300.0), np.ones((27000, 3)))
        _, _, share, hot, moving = view.moments[0]
        self.assertAlmostEqual(float(share.mean()), 0.5, delta=1e-3)
        self.assertEqual((hot.min(), moving.max()), (900, 1))

    def test_values_are_bytes_and_nothing_is_zero(self):
        self.assertEqual(to_bytes(np.array([np.nan, 1.0, 2.0, 3.0, 9.0]), 1.0, 3.0).tolist(), [0, 1, 128, 255, 255])

    def test_the_files_say_where_their_numbers_are_and_stay_small(self):
        cavity = plate(0.005)
        n = len(cavity.cubes.cells)
        mould = SimpleNamespace(cavity=cavity, up=UP, pouring=973.0, material={"liquidus": 886.0},
                                gate=SimpleNamespace(faces=np.array([0]), direction=np.array([1, 0, 0]), width=0.01))
        history = SimpleNamespace(view=View(cavity.cubes))
        for time in (0.1, 0.2, 0.3):
            history.view.add(time, time, np.full(n, time > 0.15, float), np.full(n, 900.0), np.full((n, 3), 0.5))
        with tempfile.TemporaryDirectory() as name:
            write_view(Path(name), mould, SimpleNamespace(freezing=870.0), history, {"fill_time": (np.full(n, 0.15), "s")}, [], [])
            page, numbers = json.loads((Path(name) / "report.json").read_text()), (Path(name) / "report.bin").read_bytes()
        self.assertEqual(sum(length for _, length in page["parts"].values()), len(numbers))
        start, length = page["parts"]["state"]
        states = np.frombuffer(numbers[start:start + length], np.uint8).reshape(3, n)
        self.assertEqual([states[0].max(), states[1].min() > 0], [0, True])
        start, length = page["parts"]["velocity"]
        velocity = np.frombuffer(numbers[start:start + length], np.uint8).reshape(3, 3, n)
        self.assertEqual((set(velocity[:, 0].ravel()), set(velocity[:, 2].ravel())), ({128}, {255}))

    def test_places_that_a_foundry_looks_at_are_told_and_marked(self):
        """A row of five cubes filled from both ends: fronts meet in the middle, cold."""
        cubes = Cubes(np.zeros(3), 0.01, np.array([[i, 0, 0] for i in range(5)]))
        mould = SimpleNamespace(cavity=SimpleNamespace(cubes=cubes, body=np.zeros(5), faces=np.arange(5)), material={"liquidus": 886.0},
                                vents=np.array([2]), leak=np.array([2]))
        history = SimpleNamespace(fill_time=np.array([1.0, 2, 3, 2, 1]), arrival=np.array([950.0, 900, 870, 900, 950]), metal=np.ones(5),
                                  front_velocity=np.array([[1.0, 0, 0], [1, 0, 0], [0, 0, 0], [-1, 0, 0], [-1, 0, 0]]))
        places = places_of(mould, history)
        self.assertEqual([place["kind"] for place in places], ["misrun", "cold_shut"])
        self.assertIn("below the liquidus: cold shut", places[1]["text"])
        self.assertEqual(np.round(places[1]["at"], 6).tolist(), [0.025, 0.005, 0.005])


class Signals(unittest.TestCase):
    def test_a_filling_in_the_background_of_a_script_is_stopped_too(self):
        """Shells turn SIGINT off for what they start with &."""
        before = [signal.signal(number, signal.SIG_IGN) for number in (signal.SIGINT, signal.SIGTERM)]
        try:
            fill.end_with_the_program()
            with self.assertRaises(KeyboardInterrupt):
                signal.raise_signal(signal.SIGTERM)
        finally:
            ctypes.CDLL(None).prctl(fill.PR_SET_PDEATHSIG, 0)
            for number, handler in zip((signal.SIGINT, signal.SIGTERM), before):
                signal.signal(number, handler)


class Moments(unittest.TestCase):
    def test_moments_have_names_that_openfoam_keeps(self):
        for interval, whole in ((0.0320135754323, 2.6), (3.3e-4, 0.033), (4.123456789, 412.3)):
            short = fill.short_number(interval, whole)
            self.assertAlmostEqual(short / interval, 1, delta=1e-3)
            self.assertEqual(float(f"{50 * short:.10g}"), float(f"{50 * short:.14g}"))


class Trust(unittest.TestCase):
    def test_what_a_build_can_be_trusted_with_is_told(self):
        self.assertIn("breaks down, so no other meshes", filling_trust.told({"cubes": 1e-15, "sheared": float("inf")}))
        self.assertIn("wrong by 56 %, so no other meshes", filling_trust.told({"cubes": 1e-15, "sheared": 0.56}))
        self.assertIn("and in sheared cells within 1e-03", filling_trust.told({"cubes": 1e-15, "sheared": 1e-3}))
        for wrong in (0.3, float("nan")):
            with self.assertRaisesRegex(filling_flow.FlowError, "worth nothing"):
                filling_trust.told({"cubes": wrong, "sheared": 0.0})


class Volumes(unittest.TestCase):
    def test_volume_that_the_solver_lost_goes_to_the_front(self):
        metal = np.array([1.0, 1.2, 0.6, 0.3, 0.0, -0.01])
        for wanted in (2.9, 3.2, 2.5):
            share = full_volume(metal, wanted)
            self.assertAlmostEqual(share.sum(), wanted, delta=1e-11)
            self.assertEqual(share[[0, 1, 4, 5]].tolist(), [1, 1, 0, 0])
            self.assertTrue(((share >= 0) & (share <= 1)).all())

    def test_metal_that_is_handed_on_takes_its_heat_along(self):
        before, after = np.array([1.3, 0.4, 1.0]), np.array([1.0, 0.7, 1.0])
        temperature = np.array([900.0, 600.0, 700.0])
        mixed = with_heat_of(before, after, temperature)
        self.assertAlmostEqual((before * temperature).sum(), (after * mixed).sum(), delta=1e-9)
        self.assertEqual(mixed[[0, 2]].tolist(), [900, 700])
        # What the solver has lost has the mean temperature.
        grown = with_heat_of(np.array([1.0, 0.5]), np.array([1.0, 0.8]), np.array([900.0, 600.0]))
        self.assertAlmostEqual(grown[1], (0.5 * 600 + 0.3 * 800) / 0.8, delta=1e-9)
        self.assertEqual(with_heat_of(before, before, temperature).tolist(), temperature.tolist())

    def test_heat_that_the_solver_lost_goes_to_metal_that_freezes(self):
        """Cold metal is warmed up to its freezing temperature, then what has frozen melts; hot metal and what is too much stay."""
        melt = dictionaries.Melt(7200.0, 900.0, 240e3, 1400.0, 30.0, 30.0, 2e-3, 1.0)
        metal, solid = np.array([1.0, 0.8, 0.5, 0.2]), np.array([0.0, 0.6, 0.5, 0.0])
        temperature = np.array([1500.0, 1000.0, 1300.0, 1390.0])

        def heat(temperature, solid):
            return (melt.heat * metal * temperature + melt.latent * (metal - solid)).sum()

        lacks = (melt.heat * metal * (melt.freezing - temperature).clip(0)).sum()
        for missing in (0.3 * lacks, lacks + 50e3):
            warm, frozen, returned = with_returned_heat(missing, metal, solid, temperature, melt)
            self.assertAlmostEqual(returned, missing, delta=1e-9 * missing)
            self.assertAlmostEqual(heat(warm, frozen) - heat(temperature, solid), missing, delta=1e-9 * heat(warm, frozen))
            self.assertEqual(warm[0], 1500)
            self.assertTrue(((warm[1:] <= melt.freezing) & (warm[1:] > temperature[1:])).all())
            self.assertTrue((frozen <= solid).all())
        # More than cold and frozen metal can take is not given to hot metal; metal that has too much keeps it.
        warm, frozen, returned = with_returned_heat(1e9, metal, solid, temperature, melt)
        self.assertEqual((warm[1:].tolist(), frozen.sum()), ([melt.freezing] * 3, 0))
        self.assertAlmostEqual(returned, lacks + melt.latent * solid.sum(), delta=1e-6)
        for missing in (0.0, -1e5):
            warm, frozen, returned = with_returned_heat(missing, metal, solid, temperature, melt)
            self.assertEqual((warm.tolist(), frozen.tolist(), returned), (temperature.tolist(), solid.tolist(), 0))

    def test_without_a_front_the_volume_stays(self):
        self.assertEqual(full_volume(np.array([1.0, 0.0]), 1.5).tolist(), [1, 0])


class Start(unittest.TestCase):
    def test_freezing_starts_with_the_heat_of_the_flow(self):
        """To rounding of the mean, with air that is left and a freezing range that the flow does not have."""
        temperature = np.arange(800.0, 1000.0, 0.25)
        solid = np.clip((880 - temperature) / 30, 0, 1)
        enthalpy = 2500 * (1100 * (temperature - 800) + 4e5 * (1 - solid))

        class Mould:
            cavity = plate()
            pouring = 973.0
            material = {"temperatures": temperature.tolist(), "enthalpy": enthalpy.tolist(), "density": 2500.0}

        class History:
            metal = np.where(np.arange(len(Mould.cavity.body)) % 50 == 0, 0.1, 1.0)

            @staticmethod
            def heat_lost():
                return np.linspace(0, 3e5, len(Mould.cavity.body))

        h, t, _ = start_of(Mould, History)
        lost = np.average(History.heat_lost(), weights=History.metal)
        self.assertAlmostEqual((np.interp(973.0, temperature, enthalpy) - h.mean()) / 2500 / lost, 1, delta=1e-10)
        self.assertAlmostEqual(np.abs(np.interp(t, temperature, enthalpy) / h - 1).max(), 0, delta=1e-9)

    def test_at_one_temperature_the_solid_fraction_tells(self):
        temperature, enthalpy = np.array([900.0, 933, 933, 960]), np.array([0.0, 30, 130, 160])
        t, solid = state_at(np.array([15.0, 55.0, 145.0]), temperature, enthalpy)
        self.assertEqual(t[1], 933)
        self.assertAlmostEqual(solid[1], 0.75)
        self.assertEqual((solid[0], solid[2]), (0, 0))


if __name__ == "__main__":
    unittest.main()
