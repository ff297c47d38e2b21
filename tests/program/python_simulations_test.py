"""The compiled part of the Python package as a user meets it: materials, simulations in this process, pages of the guide."""

import os
import re
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np

from cooling_block import INSIDE, block, with_core
from pages import blocks
from program import PATIENCE, SOURCES, ProgramTest

import solidus_casting as sc


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
                              text=True, stdin=subprocess.DEVNULL, timeout=200 * PATIENCE)
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
