"""The Python package as a user meets it: cases, runs as a child and their results."""

import inspect
import os
import signal
import threading
import time
import unittest
from unittest import mock

import numpy as np

from cooling_block import CASE, INSIDE, block
from program import SOURCES, ProgramTest

import solidus_casting as sc
from solidus_casting.sections import Section
from solidus_casting.shape_functions import ELEMENTS, locate


class Cases(ProgramTest):
    def test_keys_are_read_and_changed_as_attributes_and_by_path(self):
        case = sc.Case.load(SOURCES / "cases/hot_spots")
        self.assertEqual(case.time.step, "2 s")
        self.assertEqual(case["body.casting.material"], case.body[0].material)
        case.time.step = "1 s"
        case["body.casting.initial_temperature"] = "720 degC"
        self.assertEqual((case["time.step"], case.body.casting.initial_temperature), ("1 s", "720 degC"))
        del case["time.step"]
        self.assertNotIn("step", case.time)
        self.assertEqual(case.copy({"time.step": "3 s"}).time.step, "3 s")
        self.assertNotIn("step", case.time)

    def test_what_the_case_does_not_give_has_the_programs_default_or_that_of_the_included_file(self):
        self.assertEqual(sc.Case.load(SOURCES / "cases/hot_spots").time.growth, 1.5)
        variant = sc.Case.load(SOURCES / "cases/aluminium_cylinder/isothermal.toml")
        self.assertIn("include", variant)
        self.assertEqual(variant.body.part.initial_temperature, "670 degC")
        variant.body.part.initial_temperature = "690 degC"
        self.assertEqual(variant.resolved()["body"][0]["initial_temperature"], "690 degC")
        self.assertEqual(variant.body.mould.material, "steel_mould")

    def test_a_variant_of_a_case_is_loaded_by_its_name(self):
        case = sc.Case.load(f"{SOURCES}/cases/thick_cylinder:te_x6_isothermal")
        self.assertEqual(case.coupling.structural_heating, "literal")
        self.assertTrue(case.body.wall.material.endswith("materials/te_x6.toml"))
        case.time.step = "20 s"
        with case.as_arguments() as words:
            self.assertEqual(words, [f"{SOURCES}/cases/thick_cylinder/case.toml:te_x6_isothermal", "--set", 'time.step="20 s"'])
        self.assertEqual(case.resolved()["time"]["step"], "20 s")
        with self.assertRaises(sc.InputError) as caught:
            sc.Case.load(f"{SOURCES}/cases/thick_cylinder:te_x6_isotermal")
        self.assertIn("te_x6_isothermal", str(caught.exception))

    def test_completion_offers_the_keys_of_the_program(self):
        case = block()
        self.assertLessEqual({"title", "mesh", "body", "output"}, set(dir(case)))
        self.assertLessEqual({"end", "step", "adaptive"}, set(dir(case.time)))
        self.assertIn("block", dir(case.body))
        self.assertIn("film", case.explain("thermal_condition.kind"))

    def test_no_key_is_hidden_by_a_function_of_the_classes(self):
        functions = {name for name, _ in inspect.getmembers(sc.Case) if not name.startswith("_")}
        inner = {name for name, _ in inspect.getmembers(Section) if not name.startswith("_")}

        def sections(schema, depth):
            yield depth, schema
            for value in schema.get("properties", {}).values():
                for part in (value, value.get("items", {})):
                    if "properties" in part:
                        yield from sections(part, depth + 1)

        from solidus_casting.schema import case_schema

        for depth, schema in sections(case_schema(), 0):
            self.assertEqual(set(schema["properties"]) & (functions if depth == 0 else inner), set())

    def test_an_unknown_key_or_a_value_of_the_wrong_kind_is_refused_at_once(self):
        case = block()
        for change, found, allowed in ((("time.stp", "1 s"), "no key 'stp'", "did you mean 'step'?"),
                                       (("time.step", 1), "1 is not a text", "for example \"0.5 s\""),
                                       (("analysis.kind", "solidd"), "'solidd'", "did you mean 'solid'?"),
                                       (("time.solid_fraction_change", 3), "out of range", "at most 1"),
                                       (("body.blok.material", "x"), "no 'blok'", "block")):
            with self.subTest(change=change), self.assertRaises(sc.InputError) as caught:
                case[change[0]] = change[1]
            self.assertIn(found, caught.exception.found)
            self.assertIn(allowed, caught.exception.allowed)
        self.assertEqual(case.to_dict(), CASE)

    def test_errors_of_the_programs_readers_carry_file_line_and_what_is_allowed(self):
        file = self.write("case.toml", block(body=[{**CASE["body"][0], "material": "aluminium_alsi7"}]).to_toml())
        with self.assertRaises(sc.InputError) as caught:
            sc.Case.load(file).check()
        error = caught.exception
        self.assertEqual((error.file, file.read_text().splitlines()[error.line - 1]), (file, "[[body]]"))
        self.assertIn("aluminium_alsi7", error.found)
        self.assertIn("aluminium_alsi7mg", error.allowed)

        case = sc.Case.load(SOURCES / "cases/hot_spots")
        case.time.step = "1 K"  # only the program knows units
        with self.assertRaises(sc.InputError) as caught:
            case.check()
        self.assertEqual(caught.exception.key, "time.step")
        self.assertIn("the unit 'K' does not fit", caught.exception.found)

        case = block()  # is in no file at all
        case.time.step = "1 K"
        with self.assertRaises(sc.InputError) as caught:
            case.check()
        self.assertEqual((caught.exception.file, caught.exception.key), (None, "time.step"))

        self.write("broken.toml", "title = \n")
        with self.assertRaises(sc.InputError) as caught:
            sc.Case.load(self.folder / "broken.toml")
        self.assertEqual(caught.exception.line, 1)

    def test_a_case_made_from_nothing_is_saved_and_read_back(self):
        case = sc.Case()
        for key, value in CASE.items():
            if key != "body":
                case[key] = value
        body = case.body.add(name="block", material="aluminium_alsi7mg")
        body.initial_temperature = "700 degC"
        with self.assertRaises(sc.InputError):
            case.body.add(name="block")
        case.probe.add(name="unwanted", field="temperature", point=["0 mm", "0 mm"], unit="K")
        case.probe.append({"name": "also", "field": "temperature", "point": ["0 mm", "0 mm"], "unit": "K"})
        case.probe.remove("unwanted")
        del case.probe["also"]
        with self.assertRaises(TypeError):
            case.probe.clear()
        file = case.save(self.folder / "made")
        self.assertEqual(sc.Case.load(file).to_dict(), CASE)
        self.assertIn("in order", case.check())

    def test_a_case_saved_elsewhere_finds_its_files(self):
        case = sc.Case.load(SOURCES / "cases/hot_spots")
        file = case.save(self.folder / "elsewhere.toml")
        self.assertEqual(sc.Case.load(file).mesh.file, str(SOURCES / "cases/hot_spots/hot_spots.geo"))
        self.assertIn("in order", sc.Case.load(file).check())


class Runs(ProgramTest):
    def test_a_run_tells_of_every_step_and_leaves_results(self):
        seen = []
        case = block()
        results = sc.run(case, self.folder / "out", progress=seen.append)
        self.assertEqual([p.number for p in seen], list(range(1, 11)))
        self.assertEqual((seen[-1].time, seen[-1].end, seen[-1].fraction), (60, 60, 1))
        self.assertTrue(results.finished)
        self.assertEqual(results.summary["steps"], 10)
        self.assertEqual(results.times.tolist(), [0, 12, 24, 36, 48, 60])
        self.assertEqual(results.history.columns[:2], ["time", "T_inside"])
        self.assertEqual(results.units["T_inside"], "K")
        self.assertEqual(results.history.array.dtype["T_inside"], np.dtype(float))
        self.assertEqual(results.steps["reason"][0], "as asked")
        self.assertEqual(results.case.time.end, "60 s")

        # A probe after the fact is that of the run, to rounding.
        own = np.interp(results.times, results.history["time"], results.history["T_inside"])
        after = results.probe("temperature", INSIDE)
        np.testing.assert_allclose(after, own, rtol=1e-12)
        self.assertEqual(results.probe("temperature", [INSIDE, (0, 0)]).shape, (6, 2))
        with self.assertRaisesRegex(sc.SolidusError, "no element holds the point"):
            results.probe("temperature", (1, 1))
        moment = results.at(24)
        self.assertEqual((moment.location("temperature"), moment.unit("temperature")), ("nodes", "K"))
        self.assertIs(moment["temperature"], moment["temperature"])
        self.assertFalse(moment["temperature"].flags.owndata)  # a view of what was unpacked
        self.assertEqual(moment.cells["quad8"].shape, (32, 8))
        with self.assertRaisesRegex(KeyError, "did you mean 'temperature'"):
            moment["temprature"]
        with self.assertRaisesRegex(KeyError, "the nearest are at 24 s"):
            results.at(25)

        # The last moment again, in other libraries, where they are there.
        try:
            frame = results.history.to_pandas("time")
        except ImportError as error:
            self.assertIn("install", str(error))
        else:
            self.assertEqual(frame.loc[60.0, "T_inside"], results.history["T_inside"][-1])
            self.assertEqual(frame.attrs["units"]["T_inside"], "K")
        for name, count in (("vtk", lambda grid: (grid.GetNumberOfPoints(), grid.GetNumberOfCells())),
                            ("pyvista", lambda grid: (grid.n_points, grid.n_cells)),
                            ("meshio", lambda grid: (len(grid.points), sum(map(len, (c.data for c in grid.cells)))))):
            with self.subTest(library=name):
                try:
                    grid = getattr(results[-1], f"to_{name}")()
                except ImportError as error:
                    self.assertIn("install", str(error))
                    continue
                self.assertEqual(count(grid), (len(moment.points), 32))

    def test_failures_become_exceptions(self):
        with self.assertRaises(sc.InputError) as caught:
            sc.run(block(body__block__material="nothing"), self.folder / "a")
        self.assertEqual(caught.exception.key, "body.block")
        with self.assertRaisesRegex(ValueError, "where to"):
            sc.run(block())
        # Heat of an absurd power: no step goes through.
        hot = block()
        hot.thermal_condition.add(name="laser", group="block", kind="source", power="-1e12 W/m3")
        with self.assertRaises(sc.RunStopped) as caught, self.assertLogs("solidus_casting") as said:
            sc.run(hot, self.folder / "b")
        self.assertIn("thermal_condition.laser: the source 'laser' has -1e+12 W/m3", " ".join(said.output))
        self.assertIn("could not go on", caught.exception.reason)
        self.assertEqual(caught.exception.results.folder, self.folder / "b")

    def test_ctrl_c_stops_a_run_behind_a_step_and_it_goes_on(self):
        case = block(time__end="1 h", time__step="0.1 s", output__every="30 min")

        def press(progress):
            if progress.number == 5:
                threading.Thread(target=lambda: (time.sleep(0.2), os.kill(os.getpid(), signal.SIGINT))).start()

        # A shell's background jobs are born deaf to Ctrl-C.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        with self.assertRaises(sc.RunInterrupted) as caught:
            sc.run(case, self.folder / "out", progress=press)
        reached = caught.exception.results.steps["time"][-1]
        self.assertGreater(reached, 0)
        self.assertFalse(caught.exception.results.finished)
        short = case.copy({"time.end": f"{reached + 0.5} s"})
        self.assertAlmostEqual(sc.run(short, self.folder / "out", restart=True).steps["time"][-1], reached + 0.5)

    def test_several_processes_without_mpirun_are_refused_in_one_sentence(self):
        case = sc.Case.load(SOURCES / "cases/hot_spots")
        with mock.patch.dict(os.environ, {"PATH": str(self.folder)}), \
                self.assertRaisesRegex(sc.ProgramMissing, "several processes need mpirun, which is not on the PATH"):
            sc.run(case, self.folder / "out", processes=2)

    def test_an_exception_of_the_callers_function_stops_the_run(self):
        def refuse(progress):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            sc.run(block(time__end="1 h", time__step="0.1 s"), self.folder / "out", progress=refuse)
        time.sleep(0.1)
        self.assertFalse((self.folder / "out/lock").exists() and sc.Results(self.folder / "out").finished)

    def test_a_table_that_is_being_written_is_read_without_its_last_half_row(self):
        self.write("r/steps.csv", "time[s],reason\n1,as asked\n2,as")
        self.write("r/history.csv", "time[s],T[K],T[degC]\n1,300,26.85\n2,3")
        results = sc.Results(self.folder / "r")
        self.assertEqual(results.steps["time"].tolist(), [1, 2])
        self.assertEqual(results.history["T[K]"].tolist(), [300])
        self.assertEqual(results.summary, {})


class Shapes(unittest.TestCase):
    def test_every_element_reproduces_what_its_order_promises_and_finds_its_points(self):
        rng = np.random.default_rng(1)
        for number, element in ELEMENTS.items():
            with self.subTest(element=element.name):
                nodes = self.reference_nodes(element)
                np.testing.assert_allclose(element.shapes(nodes), np.eye(element.nodes), atol=1e-13)
                order = 2 if element.nodes > {2: 4, 3: 8}[element.dimension] or element.name in ("tri6", "tet10") else 1
                xi = rng.uniform(0.1, 0.9 / element.dimension, (5, element.dimension))
                coefficients = rng.normal(size=(element.dimension, element.dimension))
                offset = rng.normal(size=element.dimension)

                def polynomial(x):
                    value = x @ offset + 2
                    return value + (np.einsum("...i,ij,...j", x, coefficients, x) if order == 2 else 0)

                np.testing.assert_allclose(element.shapes(xi) @ polynomial(nodes), polynomial(xi), rtol=1e-12)
                step = 1e-6
                for axis in range(element.dimension):
                    shift = step * np.eye(element.dimension)[axis]
                    numeric = (element.shapes(xi + shift) - element.shapes(xi - shift)) / (2 * step)
                    np.testing.assert_allclose(element.slopes(xi)[..., axis], numeric, atol=1e-8)

                bent = nodes @ (np.eye(element.dimension) + 0.2 * coefficients / np.abs(coefficients).max()) + 3
                bent = bent + 0.02 * rng.normal(size=bent.shape)
                far = bent + 10
                for reference in xi:
                    point = element.shapes(reference) @ bent
                    cell, weights, outside = locate(element, np.stack([far, bent]), point)
                    self.assertEqual(cell, 1)
                    np.testing.assert_allclose(weights, element.shapes(reference), atol=1e-10)
                    self.assertLessEqual(outside, 0)
                self.assertIsNone(locate(element, np.stack([far, bent]), bent.max(0) + 1))

    @staticmethod
    def reference_nodes(element):
        if not element.simplex:
            from solidus_casting.shape_functions import _CUBE, _SQUARE

            return {2: _SQUARE, 3: _CUBE}[element.dimension][:element.nodes]
        corners = np.vstack([np.zeros(element.dimension), np.eye(element.dimension)])
        edges = {2: [(0, 1), (1, 2), (2, 0)], 3: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}[element.dimension]
        middles = [(corners[a] + corners[b]) / 2 for a, b in edges]
        return np.vstack([corners, middles])[:element.nodes]


if __name__ == "__main__":
    unittest.main()
