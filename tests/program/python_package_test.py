"""The Python package as a user meets it: cases, runs as a child, results, materials and simulations in this process."""

import copy
import inspect
import os
import re
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

from pages import blocks
from program import SOURCES, ProgramTest

import solidus_casting as sc
from solidus_casting.sections import Section
from solidus_casting.shape_functions import ELEMENTS, locate

CASE = {
    "title": "A block cools",
    "analysis": {"kind": "plane_strain", "physics": "heat"},
    "mesh": {"shape": "block", "element": "quad8", "block": {"size": ["40 mm", "20 mm"], "divisions": [8, 4]}},
    "time": {"end": "60 s", "step": "6 s"},
    "body": [{"name": "block", "material": "aluminium_alsi7mg", "initial_temperature": "700 degC"}],
    "thermal_condition": [{"name": "air", "group": "x_max", "kind": "film", "coefficient": "3000 W/m2/K",
                           "ambient": "20 degC"}],
    "probe": [{"name": "T_inside", "field": "temperature", "point": ["21.7 mm", "3.1 mm"], "unit": "K"}],
    "output": {"every": "12 s"},
}
INSIDE = (0.0217, 0.0031)
# Where the build has made the compiled part, it must be found.
with_core = unittest.skipUnless(sc.has_core() or os.environ.get("SOLIDUS_EXPECT_CORE"),
                                "the compiled part of the package was not built")


def block(**changes):
    case = sc.Case(copy.deepcopy(CASE))
    for path, value in changes.items():
        case[path.replace("__", ".")] = value
    return case


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
        except ImportError:
            pass
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

        with self.assertRaises(sc.RunInterrupted) as caught:
            sc.run(case, self.folder / "out", progress=press)
        reached = caught.exception.results.steps["time"][-1]
        self.assertGreater(reached, 0)
        self.assertFalse(caught.exception.results.finished)
        short = case.copy({"time.end": f"{reached + 0.5} s"})
        self.assertAlmostEqual(sc.run(short, self.folder / "out", restart=True).steps["time"][-1], reached + 0.5)

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


@with_core
class Materials(unittest.TestCase):
    def test_properties_are_functions_of_temperature_with_source_and_range(self):
        m = sc.material("aluminium_alsi7mg")
        self.assertIn("AlSi7Mg", m.title)
        self.assertEqual(m.conductivity(sc.celsius(25)), 159)
        np.testing.assert_allclose(m["conductivity"](sc.celsius([550, 577])), [150, 145])
        self.assertEqual((m.conductivity.unit, bool(m.conductivity.source)), ("W/m/K", True))
        temperatures, values = m.young_modulus.points
        np.testing.assert_allclose(m.young_modulus(temperatures), values)
        self.assertEqual(m.solid_fraction(sc.celsius(20)), 1)
        self.assertEqual(m.solid_fraction(sc.celsius(800)), 0)
        heat = m.enthalpy(sc.celsius(np.array([100., 590, 700])))
        np.testing.assert_allclose(m.temperature(heat), sc.celsius([100, 590, 700]))
        self.assertIn("aluminium_alsi7mg", sc.materials())
        with self.assertRaises(sc.InputError) as caught:
            sc.material("aluminium_alsi7")
        self.assertIn("aluminium_alsi7mg", caught.exception.allowed)
        with self.assertRaisesRegex(AttributeError, "did you mean 'conductivity'"):
            m.conductvity

    def test_many_points_at_once_answer_as_each_by_itself_and_as_hooke(self):
        law = sc.Law("aluminium_alsi7mg")
        rng = np.random.default_rng(2)
        strain = rng.normal(scale=2e-3, size=(50, 6))
        temperature = sc.celsius(rng.uniform(20, 560, 50))
        together = law.update(strain, temperature, 1.0, tangent=True)
        self.assertTrue(together.converged.all())
        self.assertGreater(together.state.hardening.max(), 0)
        for i in (0, 17, 49):
            alone = law.update(strain[i:i + 1], temperature[i], 1.0)
            np.testing.assert_array_equal(alone.stress[0], together.stress[i])
        small = np.array([1e-5, 0, 0, 0, 0, 0])
        moduli = law.moduli(law.reference_temperature)
        k, g = moduli["bulk"], moduli["shear"]
        elastic = law.update(small, law.reference_temperature, 1.0)
        np.testing.assert_allclose(elastic.stress[0], [1e-5 * (k + 4 * g / 3), *2 * [1e-5 * (k - 2 * g / 3)], 0, 0, 0],
                                   atol=1e-3)
        # The tangent is the derivative of the stress.
        step = 1e-8
        for component in (0, 3):
            shift = np.zeros(6)
            shift[component] = step
            numeric = (law.update(strain + shift, temperature, 1.0).stress
                       - law.update(strain - shift, temperature, 1.0).stress) / (2 * step)
            exact = together.tangent[:, :, component] * (1 if component < 3 else 2)  # of tensor components
            self.assertLess(np.abs(numeric - exact).max(), 1e-4 * np.abs(together.tangent).max())
        # Old state in, new state out.
        again = law.update(strain, temperature, 1.0, together.state)
        self.assertTrue(np.all(again.state.hardening >= together.state.hardening - 1e-15))

    def test_a_drawn_bar_follows_hooke_then_the_flow_curve(self):
        m = sc.material("aluminium_alsi7mg")
        strain = np.linspace(0, 0.05, 101)
        answer = m.draw(strain, sc.celsius(20), 1e-6)
        young = m.young_modulus(sc.celsius(25))
        self.assertAlmostEqual(answer["stress"][1] / (young * strain[1]), 1, delta=0.01)
        plastic = answer["plastic_strain"][-1]
        self.assertAlmostEqual(plastic, 0.05 - answer["stress"][-1] / young, places=5)
        # By Voce's law the stress lies between the flow stress and the saturation, the overstress aside.
        self.assertGreater(answer["stress"][-1], 150e6)
        stronger = m.changed({"plasticity.saturation_stress": "300 MPa"})
        self.assertGreater(stronger.tension([0.05], sc.celsius(20))[0], 1.2 * m.tension([0.05], sc.celsius(20))[0])
        with self.assertRaises(sc.InputError):
            m.changed({"plasticity.saturation_stres": "300 MPa"})

    def test_the_hardening_that_made_a_curve_is_found_again(self):
        from solidus_casting.fitting import fit_hardening

        base = sc.material("aluminium_99_7_plastic").changed(
            {"plasticity": {"flow_stress": "40 MPa", "isotropic_hardening": "saturation", "saturation_stress": "110 MPa",
                            "saturation_rate": 25, "hardening_modulus": "0 MPa"}})
        strain = np.linspace(0.002, 0.2, 40)
        stress = base.tension(strain, sc.celsius(20))
        found = fit_hardening("saturation", strain, stress, base, sc.celsius(20), start={
            "flow_stress": 60e6, "saturation_stress": 90e6, "saturation_rate": 10.0})
        np.testing.assert_allclose([found["flow_stress"], found["saturation_stress"], found["saturation_rate"]],
                                   [40e6, 110e6, 25], rtol=1e-3)


@with_core
class Simulations(ProgramTest):
    def test_a_simulation_that_is_stepped_leaves_the_results_of_a_run(self):
        case = block()
        by_child = sc.run(case, self.folder / "child")
        with sc.Simulation(case, self.folder / "stepped") as simulation:
            steps = list(simulation)
            self.assertTrue(simulation.finished)
            self.assertIsNone(simulation.advance())
            stepped = simulation.results
        in_process = sc.run(case, self.folder / "in_process", in_process=True)
        self.assertEqual([s.number for s in steps], list(range(1, 11)))
        self.assertEqual(steps[-1].heat.iterations, int(by_child.steps["heat_iterations"][-1]))
        for other in (stepped, in_process):
            self.assertTrue(other.finished)
            for name in by_child.history:
                np.testing.assert_array_equal(other.history[name], by_child.history[name])
            np.testing.assert_array_equal(other[-1]["temperature"], by_child[-1]["temperature"])

    def test_a_repeated_step_does_not_count_and_gives_the_same(self):
        with sc.Simulation(block(), self.folder / "out") as simulation:
            simulation.advance()
            first = simulation.advance()
            kept = simulation["temperature"].copy()
            moment = simulation.moment
            half = simulation.repeat(3.0)
            self.assertEqual((first.time, half.time, half.number), (12, 9, 2))
            with self.assertRaisesRegex(sc.SolidusError, "has gone on"):
                moment["solid_fraction"]
            again = simulation.repeat(6.0)
            self.assertEqual((again.time, again.rejected), (12, 2))
            np.testing.assert_allclose(simulation["temperature"], kept, rtol=1e-9)
            self.assertEqual(len(simulation.results.steps), 1)  # the pending step is not written
            simulation.commit()
            self.assertEqual(simulation.results.steps["rejection"][-1], "repeated as asked")
            with self.assertRaisesRegex(sc.InputError, "no step to repeat"):
                simulation.repeat()

    def test_a_condition_that_changes_acts_from_the_next_step_or_the_repeated_one_on(self):
        with sc.Simulation(block()) as simulation, sc.Simulation(block(thermal_condition__air__ambient="600 degC")) as hot:
            cold = simulation.advance()
            simulation.change("thermal_condition.air.ambient", "600 degC")
            warm = simulation.repeat()
            self.assertGreater(warm.min_temperature, cold.min_temperature + 10)
            self.assertAlmostEqual(warm.min_temperature, hot.advance().min_temperature, delta=1e-6)
            for key, value, text in (("time.step", "1 s", "cannot change"), ("thermal_condition.air.ambient", "5 m", "unit"),
                                     ("thermal_condition.oil.ambient", "5 K", "no 'oil'")):
                with self.assertRaisesRegex(sc.InputError, text):
                    simulation.change(key, value)

    def test_fields_probes_and_criteria_are_there_while_it_runs(self):
        with sc.Simulation(block(time__step="2 s")) as simulation:
            simulation.run(until=20)
            self.assertEqual(simulation.time, 20)
            self.assertIn("niyama", simulation.fields())
            value = simulation.probe("temperature", INSIDE)
            self.assertTrue(simulation["temperature"].min() < value < simulation["temperature"].max())
            with self.assertRaisesRegex(sc.InputError, "commit"):
                simulation["solidified_at"]
            simulation.commit()
            self.assertEqual(len(simulation["solidified_at"]), len(simulation.moment.points))

    def test_heat_and_mechanics_with_contact_are_driven_too(self):
        case = sc.Case.load(SOURCES / "cases/two_blocks")
        with sc.Simulation(case) as simulation:
            step = simulation.advance()
            self.assertGreater(step.mechanics.iterations, 0)
            gap = simulation["gap"]
            again = simulation.repeat()
            np.testing.assert_allclose(simulation["gap"], gap, atol=1e-12)
            self.assertEqual(again.time, step.time)
            self.assertEqual(simulation["displacement"].shape, (len(simulation.moment.points), 3))

    def test_a_steady_case_is_solved_at_once(self):
        case = block(time={"steady": True}, body__block__initial_temperature="100 degC")
        case.thermal_condition.add(name="hot", group="x_min", kind="temperature", temperature="200 degC")
        del case["output"]
        with sc.Simulation(case) as simulation:
            with self.assertRaisesRegex(sc.InputError, "no steps"):
                simulation.advance()
            simulation.run()
            self.assertTrue(simulation.finished)
            self.assertAlmostEqual(simulation["temperature"].max(), sc.celsius(200), places=6)
            self.assertGreater(sc.celsius(199), simulation.probe("temperature", INSIDE))

    def test_failures_become_exceptions(self):
        with self.assertRaises(sc.InputError) as caught:
            sc.Simulation(block(body__block__material="nothing"))
        self.assertEqual(caught.exception.key, "body.block")
        hot = block()
        hot.thermal_condition.add(name="laser", group="block", kind="source", power="-1e12 W/m3")
        with self.assertRaises(sc.RunStopped) as caught, self.assertLogs("solidus_casting") as said:
            sc.Simulation(hot).run()
        self.assertIn("thermal_condition.laser: the source 'laser' has -1e+12 W/m3", " ".join(said.output))
        self.assertNotIn("checkpoint", caught.exception.reason)
        self.assertNotIn("--restart", caught.exception.reason)

    def test_ctrl_c_stops_it_behind_a_step(self):
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with sc.Simulation(block(time__end="10 h", time__step="0.1 s", output__every="5 h"), self.folder / "out") as simulation:
            with self.assertRaises(sc.RunInterrupted):
                simulation.run()
            self.assertGreater(simulation.time, 0)


class Pages(ProgramTest):
    def blocks(self):
        page = (SOURCES / "docs/guide/python.md").read_text()
        found = [block.text for block in blocks(page) if block.language == "python"]
        self.assertGreater(len(found), 10)
        return found

    def python(self, name, text, *launcher):
        script = self.write(name, text)
        environment = {**os.environ, "PYTHONPATH": str(SOURCES / "python")}
        done = subprocess.run([*launcher, sys.executable, script], cwd=self.folder, env=environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=200)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-3000:])
        return done.stdout

    @with_core
    def test_every_block_of_the_guide_runs_in_its_order(self):
        (self.folder / "cases").symlink_to(SOURCES / "cases")
        serial = [text for text in self.blocks() if "mpi4py" not in text]
        parallel, = (text for text in self.blocks() if "mpi4py" in text)
        said = self.python("guide.py", "\n".join(serial))
        self.assertIn("did you mean 'step'?", said)
        self.assertIn("repeated as asked", said)
        try:
            import mpi4py  # noqa: F401
        except ImportError:
            self.skipTest("the block of several processes: mpi4py is not there")
        said = self.python("parallel.py", parallel, "mpirun", "-n", "2", "--bind-to", "none", "--oversubscribe")
        alone = sc.run(self.folder / "small/case.toml", self.folder / "alone")
        coldest, processes = re.search(r"coldest ([\d.]+) K on (\d) processes", said).groups()
        self.assertEqual(processes, "2")
        self.assertAlmostEqual(float(coldest), alone[-1]["temperature"].min(), delta=1e-5)
        np.testing.assert_allclose(sc.Results(self.folder / "results/small/parallel")[-1].probe("temperature", INSIDE),
                                   alone[-1].probe("temperature", INSIDE), rtol=1e-7)  # the solver's tolerance

    @with_core
    def test_a_coupled_simulation_is_the_same_on_two_processes(self):
        """Blocks in contact, driven by mpi4py: three steps, of which the last is repeated half as long."""
        try:
            import mpi4py  # noqa: F401
        except ImportError:
            self.skipTest("mpi4py is not there")
        text = f"""
from mpi4py import MPI
import solidus_casting as sc
world = MPI.COMM_WORLD
sc.initialize(world)
with sc.Simulation({str(SOURCES / "cases/two_blocks")!r}) as simulation:
    for step in simulation:
        if step.number == 3:
            break
    largest = [world.allreduce(abs(simulation[field]).max(), MPI.MAX) for field in ("temperature", "displacement")]
    simulation.repeat(step.step / 2)
    largest.append(world.allreduce(simulation["temperature"].max(), MPI.MAX))
if world.rank == 0:
    print(world.size, *(repr(float(value)) for value in largest))
"""
        said = [self.python("coupled.py", text, *launcher).split()[-4:]
                for launcher in ([], ["mpirun", "-n", "2", "--bind-to", "none", "--oversubscribe"])]
        self.assertEqual([words[0] for words in said], ["1", "2"])
        alone, together = ([float(word) for word in words[1:]] for words in said)
        np.testing.assert_allclose(together, alone, rtol=1e-6)  # measured: 1e-9

    def test_the_reference_is_that_of_the_docstrings(self):
        from solidus_docs.python_reference import reference

        self.assertEqual((SOURCES / "docs/reference/python.md").read_text(), reference(),
                         "PYTHONPATH=python python3 -m solidus_docs.python_reference > docs/reference/python.md")


if __name__ == "__main__":
    unittest.main()
