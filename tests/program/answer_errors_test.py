"""The errors that a run states of its answers: against finer runs, and by comparison with further runs."""

import re
import statistics
import subprocess
import unittest

import castings_with_errors as castings
from program import PATIENCE, PROGRAM, ProgramTest, solidus
from summary_test import CASE, GEOMETRY



BAR = """
title = "Bar"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "bar.inp"
unit = "mm"
[time]
end = "40 s"
step = "5 s"
[[body]]
name = "bar"
role = "casting"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[thermal_condition]]
name = "end"
group = "end"
kind = "film"
coefficient = "1500 W/m2/K"
ambient = "20 degC"
"""


class ExpectedSteps(ProgramTest):
    # In a die temperatures make most steps, in sand the skin that lets go and the last melt.
    def test_of_castings_that_deform_are_right_within_two(self):
        for name in ("alsi10mg_die", "nodular_iron_sand"):
            folder = self.folder / name
            summary = castings.run(PROGRAM, folder, castings.make(PROGRAM, folder, name, 1))
            with self.subTest(casting=name, steps=summary["steps"]):
                share = summary["understood"]["expected"]["steps"] / summary["steps"]
                self.assertGreater(share, 0.5)
                self.assertLess(share, 2)


class StatedErrors(ProgramTest):
    # Two of the castings of the nightly run.
    def test_cover_the_errors_of_castings(self):
        for name in ("nodular_iron_sand", "alsi10mg_die"):
            found = list(castings.stated(PROGRAM, self.folder, name))
            # The iron's graphite closes its pores; whether a trace is left depends on the last digits.
            of_all = {"solid after", "largest gap", "largest distortion", "largest von Mises"}
            self.assertLessEqual(of_all, {answer for answer, *_ in found}, name)
            if name == "alsi10mg_die":
                self.assertIn("pores", {answer for answer, *_ in found})
            for answer, value, stated, error in found:
                with self.subTest(casting=name, answer=answer, value=value):
                    self.assertGreaterEqual(stated, error)
            self.assertLessEqual(statistics.median(stated / max(error, 1e-12) for _, _, stated, error in found), 10)

    def test_are_the_same_on_two_processes(self):
        folder = self.folder / "casting"
        one = castings.answers(castings.run(PROGRAM, folder, castings.make(PROGRAM, folder, "alsi10mg_die", 1)))
        subprocess.run(["mpirun", "-n", "2", PROGRAM, "run", "case", "--no-progress", "-o", "on_two"], cwd=folder, check=True,
                       capture_output=True, timeout=120 * PATIENCE)
        two = castings.answers(self.summary(folder / "on_two"))
        self.assertEqual(one.keys(), two.keys())
        for answer, numbers in one.items():
            for own, other in zip(numbers, two[answer], strict=True):
                self.assertAlmostEqual(own, other, delta=1e-3 * abs(numbers[0]) + 1e-2 * numbers[1], msg=answer)


class Sure(ProgramTest):
    def casting(self):
        folder = self.folder / "casting"
        castings.make(PROGRAM, folder, "nodular_iron_sand", 1)
        return folder

    def test_compares_with_longer_steps_and_larger_elements(self):
        folder = self.casting()
        told = self.done("run", "case", "--sure", "--no-progress", "-o", "out", cwd=folder)
        self.assertRegex(told, r"--sure: compared with longer steps, a factor of [12](\.\d+)?")
        self.assertRegex(told, r"--sure: compared with larger elements, a factor of [12](\.\d+)?")
        # Printed twice, as estimated and as compared.
        printed = re.findall(r"its last melt froze [\d.]+ ± [\d.]+ s \(step ([\d.]+), mesh ([\d.]+)\)", told)
        self.assertEqual(len(printed), 2)
        estimate_of_step, estimate_of_mesh = map(float, printed[0])
        run = self.summary(folder / "out")
        steps, mesh = (self.summary(folder / f"out/sure/{name}") for name in ("longer_steps", "larger_elements"))
        froze, longer, larger = (s["answers"]["castings"]["part"]["last_melt_froze"] for s in (run, steps, mesh))
        self.assertTrue(froze["step_compared"] and froze["mesh_compared"])
        # Richardson for errors of first order, and a quarter more; never less than half of the estimate.
        of_step = 1.25 * abs(froze["value[s]"] - longer["value[s]"]) / (run["steps"] / steps["steps"] - 1)
        edges = (run["mesh"]["bodies"]["part"] / mesh["mesh"]["bodies"]["part"]) ** 0.5
        of_mesh = 1.25 * abs(froze["value[s]"] - larger["value[s]"]) / (edges - 1)
        self.assertAlmostEqual(froze["error_of_step[s]"], max(of_step, estimate_of_step / 2), delta=0.01 * estimate_of_step)
        self.assertAlmostEqual(froze["error_of_mesh[s]"], max(of_mesh, estimate_of_mesh / 2), delta=0.05 * estimate_of_mesh)

    def test_makes_a_coarser_mesh_of_a_script(self):
        self.write("plate.geo", GEOMETRY)
        self.write("case.toml", CASE.format(end=40, feeders="top"))
        told = self.done("run", "case.toml", "--sure", "--no-progress", "-o", "out")
        self.assertRegex(told, r"compared with larger elements, a factor of [12]\.\d+")
        self.assertIn("compared with longer steps, a factor of 2", told)
        coarse, given = (sum(self.summary(self.folder / folder)["mesh"]["bodies"].values())
                         for folder in ("out/sure/larger_elements", "out"))
        self.assertLess(coarse, given / 2)

    def test_says_what_it_cannot_compare(self):
        # A bar of ten squares of 4 mm that cools at one end.
        nodes = "\n".join(f"{1 + i + 11 * j}, {4 * i}, {4 * j}" for j in range(2) for i in range(11))
        squares = "\n".join(f"{i}, {i}, {i + 1}, {i + 12}, {i + 11}" for i in range(1, 11))
        self.write("bar.inp", f"*NODE\n{nodes}\n*ELEMENT, TYPE=CPE4, ELSET=bar\n{squares}\n*SURFACE, NAME=end, TYPE=ELEMENT\n1, S4\n")
        self.write("case.toml", BAR)
        told = self.done("run", "case.toml", "--sure", "--no-progress", "-o", "out")
        self.assertRegex(told, "no comparison with larger elements: '.*bar.inp' holds a mesh, .*; the estimate is kept")
        self.assertIn("compared with longer steps, a factor of 2", told)

    def test_a_factor_on_sizes_is_refused_where_it_would_change_none(self):
        self.write("bar.inp", "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPE3, ELSET=bar\n1, 1, 2, 3\n")
        self.write("case.toml", BAR.replace('unit = "mm"', 'unit = "mm"\nsize_factor = 2'))
        self.assertIn("the file holds a mesh, whose elements have their sizes", self.refused("case.toml"))
        self.casting()
        self.assertIn("the mesh is a built-in shape", self.refused("casting/case", "--set", "mesh.size_factor=2"))

    def refused(self, *arguments):
        done = solidus("check", *arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stderr

    def test_of_a_steady_case_is_refused(self):
        folder = self.casting()
        case = folder / "case/case.toml"
        lines = case.read_text().splitlines()
        start, end = lines.index("[time]"), lines.index("[[body]]")
        case.write_text("\n".join([*lines[:start], "[time]", "steady = true", *lines[end:]]))
        refused = solidus("run", "case", "--sure", cwd=folder)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("--sure compares answers of a transient run", refused.stderr)


if __name__ == "__main__":
    unittest.main()
