"""What the data add: spreads of materials and conditions carried to the answers of a run.

The case is a plate that a film cools so slowly that it has one temperature. With freezing at one temperature T_m it is solid at

    t = (rho V/A)/h [ c ln((T_0 - T_a)/(T_m - T_a)) + L/(T_m - T_a) ]

T_0 of pouring, T_a of the air.
"""

import csv
import json
import math
import unittest

from program import ProgramTest, solidus

RHO, C, L, H, DEPTH = 2000.0, 1000.0, 3e5, 100.0, 0.01
T_0, T_M, T_A = 700.0, 600.0, 20.0

METAL = """
density = "2000 kg/m3"
conductivity = "10000 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "300 kJ/kg"
fraction = { kind = "linear", solidus = "600 degC", liquidus = "600 degC" }
[spread]
density = { relative = 0.02, source = "weighed" }
conductivity = { relative = 0.2, estimate = true }
latent_heat = { relative = 0.10, estimate = true }
freezing_temperatures = { shift = "0 K", source = "defined" }
"""
CASE = """
title = "A plate in air"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [2, 1]
[time]
end = "200 s"
step = "0.5 s"
until = "solid"
[criteria]
follow = true
[[body]]
name = "plate"
group = "block"
material = "metal.toml"
initial_temperature = "700 degC"
[[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "20 degC"
[spread.thermal_condition.air]
coefficient = { factor = 1.3, estimate = true }
[output]
every = "60 s"
"""
FROZE = "plate: last melt froze"


def time_to_solid(rho=RHO, c=C, latent=L, h=H, t_0=T_0):
    return rho * DEPTH / h * (c * math.log((t_0 - T_A) / (T_M - T_A)) + latent / (T_M - T_A))


def expected_parts():
    """Two standard deviations by each parameter: half the difference of both ends, or one end where it is small."""
    best = time_to_solid()
    up, down = time_to_solid(h=1.3 * H), time_to_solid(h=H / 1.3)
    slope, bend = 0.5 * (up - down), 0.5 * (up + down) - best
    return {"film coefficient of air": math.hypot(slope, bend / math.sqrt(2)),
            "latent heat of metal": time_to_solid(latent=1.1 * L) - best,
            "specific heat of metal": time_to_solid(c=1.05 * C) - best,
            "density of metal": time_to_solid(rho=1.02 * RHO) - best,
            "pouring temperature": time_to_solid(t_0=T_0 + 10) - best,
            "conductivity of metal": 0.0}


class Uncertain(ProgramTest):
    def write_case(self, metal=METAL, case=CASE):
        self.write("metal.toml", metal)
        self.write("case.toml", case)

    def answer(self, folder="out", name=FROZE):
        document = json.loads((self.folder / folder / "uncertain.json").read_text())
        return next(answer for answer in document["answers"] if answer["name"] == name)

    def test_the_spread_of_a_freezing_time_is_that_of_its_closed_form(self):
        self.write_case()
        said = self.done("uncertain", "case.toml", "-o", "out", "-j", "2")
        answer, best, expected = self.answer(), time_to_solid(), expected_parts()
        self.assertAlmostEqual(answer["value"], best, delta=0.01 * best)
        parts = {part["label"]: part["plus_minus"] for part in answer["parts"]}
        self.assertEqual(set(parts), set(expected))
        for label, part in expected.items():
            self.assertAlmostEqual(parts[label], part, delta=0.03 * part + 0.002 * best, msg=label)
        self.assertEqual([part["label"] for part in answer["parts"]][:4], sorted(expected, key=lambda k: -expected[k])[:4])
        total = math.sqrt(sum(part ** 2 for part in expected.values()))
        of_data = math.sqrt(answer["plus_minus"] ** 2 - answer["step_and_mesh"] ** 2)
        self.assertAlmostEqual(of_data, total, delta=0.03 * total)
        # What is known exactly takes no run; the others one each, and what matters one for its other end.
        self.assertNotIn("freezing temperatures", said)
        self.assertEqual(len(list((self.folder / "out").glob("*_up/run.json"))), len(expected))
        self.assertTrue((self.folder / "out/06_film_coefficient_of_air_down/run.json").exists())
        self.assertLessEqual(len(list((self.folder / "out").glob("*/run.json"))), 20)
        self.assertRegex(said, rf"{FROZE} +1[0-9]{{2}} s ± [0-9]+ \(film coefficient of air [0-9]+, latent heat of metal [0-9]+")
        self.assertIn("no spread is stated for the specific heat of metal: 5 % taken", said)
        self.assertIn("no spread is stated for the pouring temperature: 10 K taken", said)
        self.assertNotIn("stated for the density", said)
        self.assertRegex(said, rf"{FROZE} .*, step and mesh [0-9]+\)")
        self.assertNotIn("step and mesh are not in these numbers", said)
        self.assertTrue((self.folder / "out/uncertain.png").stat().st_size > 10000)
        with (self.folder / "out/uncertain.csv").open(newline="") as table:
            rows = [row for row in csv.DictReader(table) if row["answer"] == FROZE]
        film = next(row for row in rows if row["parameter"] == "film coefficient of air")
        self.assertAlmostEqual(float(film["at the lower end"]), time_to_solid(h=H / 1.3), delta=0.01 * best)
        # Runs that have ended are kept.
        before = (self.folder / "out/best/run.json").stat().st_mtime_ns
        said = self.done("uncertain", "case.toml", "-o", "out", "--restart", "--one-sided")
        self.assertIn(f"{1 + len(expected)} runs, in ", said)
        self.assertEqual((self.folder / "out/best/run.json").stat().st_mtime_ns, before)
        self.assertEqual([part["down"] for part in self.answer()["parts"]], [None] * len(expected))

    def test_a_latin_hypercube_agrees_with_the_first_order(self):
        self.write_case()
        said = self.done("uncertain", "case.toml", "-o", "out", "--samples", "60", "--seed", "3", "--set", "time.step=2 s")
        document = json.loads((self.folder / "out/uncertain_samples.json").read_text())
        answer = next(answer for answer in document["answers"] if answer["name"] == FROZE)
        total = math.sqrt(sum(part ** 2 for part in expected_parts().values()))
        # A standard deviation of 60 samples is known to 1/sqrt(120), 9 %; twice that.
        self.assertAlmostEqual(answer["plus_minus"], total, delta=0.18 * total)
        self.assertEqual(list(answer["rank_correlations"])[:2], ["film coefficient of air", "latent heat of metal"])
        self.assertLess(answer["rank_correlations"]["film coefficient of air"], -0.8)
        self.assertIn("60 runs, 0 failed", said)

    def test_what_a_case_does_not_use_is_not_uncertain(self):
        self.write("case.toml", """
title = "A bush in sand"
[analysis]
kind = "axisymmetric"
gravity = "9.81 m/s2"
[mesh]
shape = "cylinder_in_mould"
element = "tri3"
[mesh.cylinder_in_mould]
radius = "10 mm"
height = "20 mm"
mould_wall = "10 mm"
mould_bottom = "10 mm"
mould_height = "30 mm"
element_size = "5 mm"
mould_element_size = "5 mm"
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "part"
material = "brass"
initial_temperature = "1020 degC"
[[body]]
name = "mould"
material = "furan_sand"
initial_temperature = { formula = "293.15 + 0*x", unit = "K" }
[[interface]]
bodies = "all"
[[thermal_condition]]
name = "wind.1"
group = "part_free"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
[spread.body.mould]
conductivity = { relative = 0.07, source = "own" }
[spread.contact.part_mould]
conductance = { factor = 1.2, source = "own" }
""")
        def listed(*words):
            document = json.loads(self.done("uncertain", "case.toml", "--parameters", "--log", "warn", *words))
            return {entry["label"]: entry for entry in document["parameters"]}, document["not_varied"]
        coupled, fixed = listed()
        heat, _ = listed("--heat-only")
        # Sand neither melts nor deforms: its density and specific heat are one thing. The case's own spreads come first.
        sand = coupled["heat capacity per volume of furan_sand"]
        self.assertAlmostEqual(sand["relative"], math.hypot(0.065, 0.1))
        self.assertNotIn("density of furan_sand", coupled)
        self.assertEqual(coupled["conductivity of mould"]["relative"], 0.07)
        self.assertEqual(coupled["conductance of part_mould"]["factor"], 1.2)
        self.assertEqual(coupled["conduction of the gap of copper_alloy_in_sand"]["factor"], 1.5)
        mechanical = {label for label, entry in coupled.items() if entry["mechanical"]}
        self.assertEqual(mechanical, {f"{what} of brass" for what in (
            "volume change", "Young's modulus", "Poisson's ratio", "expansion", "strength")})
        self.assertEqual(set(coupled) - set(heat), mechanical | {"conduction of the gap of copper_alloy_in_sand"})
        self.assertEqual(len(fixed), 2, fixed)
        self.assertIn("for it is given by place", fixed[0])
        self.assertIn("film coefficient of wind.1, for a dot", fixed[1])

    def test_few_runs_move_things_together_and_say_so(self):
        self.write_case(case=CASE + '[[thermal_condition]]\nname = "top"\ngroup = "y_max"\nkind = "film"\n'
                          'coefficient = "1 W/m2/K"\nambient = "20 degC"\n')
        said = self.done("uncertain", "case.toml", "--runs", "7", "--dry-run")
        self.assertIn("moved together, to keep to the number of runs: film coefficient of air, film coefficient of top", said)
        self.assertNotIn("left out", said)
        said = self.done("uncertain", "case.toml", "--runs", "4", "-o", "out")
        self.assertIn("left out, to keep to the number of runs: ", said)
        self.assertEqual(len(list((self.folder / "out").glob("*/run.json"))), 4)

    def test_a_run_that_fails_is_told_and_its_parameter_left_out_of_the_answer(self):
        # With the greater latent heat the plate is not solid by the end.
        self.write_case(case=CASE.replace('end = "200 s"', f'end = "{time_to_solid() + 3} s"'))
        said = self.done("uncertain", "case.toml", "-o", "out", "--one-sided")
        self.assertIn(f"{FROZE}: without ", said)
        self.assertIn("latent heat of metal", self.answer()["incomplete"])

    def test_a_mistake_is_told_before_anything_runs(self):
        for metal, case, words, text in (
                (METAL.replace("relative = 0.02", "relative = -0.02"), CASE, (), "metal.toml:11:"),
                (METAL.replace("density = { rel", "expansion = { rel"), CASE, (), "'expansion', which the material 'metal' has not"),
                (METAL, CASE.replace("condition.air]\n", "condition.wind]\n"), (), "no thermal condition named 'wind'"),
                (METAL, CASE, ("--runs", "1"), "--runs is a whole number, 2 at least, not '1'"),
                (METAL, CASE, ("--jobs", "many"), "--jobs is a whole number"),
                (METAL, CASE, ("--samples", "9", "--one-sided"), "belong to the first order"),
                (METAL, CASE, ("--seed", "9"), "--seed belongs to --samples"),
                (METAL, CASE, ("--set", "time.stop=3"), "unknown key 'stop'")):
            self.write_case(metal, case)
            result = solidus("uncertain", "case.toml", "-o", "out", *words, cwd=self.folder)
            self.assertEqual(result.returncode, 1, text)
            self.assertIn(text, result.stderr)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
