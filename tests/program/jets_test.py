"""Jets of water on a die and heat lost in the shot sleeve, through the whole program."""

import csv
import math
import re
import unittest

from program import ProgramTest, solidus

# A slab of one temperature, insulated but for the jet on its back.
SLAB = """
title = "A slab that a jet cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["40 mm", "10 mm"]
divisions = [4, 4]
[time]
end = "1 s"
step = "0.02 s"
[[body]]
name = "slab"
group = "block"
material = "lump.toml"
initial_temperature = "680 degC"
"""
JET = """
[[jet]]
name = "bubbler"
group = "y_min"
nozzle = "4 mm"
distance = "24 mm"
radius = "20 mm"
flow = "4 l/min"
inlet_temperature = "30 degC"
"""
SLEEVE = """
[[shot_sleeve]]
body = "slab"
diameter = "60 mm"
length = "300 mm"
filling = 0.5
time = "4 s"
temperature = "200 degC"
coefficient = "2000 W/m2/K"
"""
LUMP = """
title = "A metal of one temperature"
density = { value = "2500 kg/m3" }
conductivity = { value = "1e6 W/m/K" }
specific_heat = { value = "1000 J/kg/K" }
"""


class JetsTest(ProgramTest):
    def run_case(self, name, text):
        self.write("lump.toml", LUMP)
        self.write(f"{name}.toml", text)
        result = solidus("run", f"{name}.toml", "-o", name, "--no-progress", cwd=self.folder, env={"SOLIDUS_PROCESSES": "1"})
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.folder / name / "history.csv", encoding="utf-8") as table:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]
        return result.stdout + result.stderr, rows

    def test_a_jet_is_a_film_of_martins_coefficient(self):
        said, rows = self.run_case("jet", SLAB + JET)
        film = float(re.search(r"Re = \d+, (\d+) W", said)[1])
        # Water of 30 degC: 995.61 kg/m3, 4180.3 J/(kg K), 0.61434 W/(m K), 7.9722e-4 Pa s.
        re_number = 4 * 4e-3 / 60 * 995.61 / (math.pi * 0.004 * 7.9722e-4)
        prandtl = 7.9722e-4 * 4180.3 / 0.61434
        root = 0.004 / (2 * 0.020)
        nusselt = 2 * root * (1 - 2.2 * root) * 2 * math.sqrt(re_number * (1 + 0.005 * re_number**0.55)) * prandtl**0.42
        self.assertAlmostEqual(film, nusselt * 0.61434 / 0.004, delta=0.6)
        # A lump under this film, in short steps.
        expected = 30 + 650 * math.exp(-film / (2500 * 1000 * 0.01))
        self.assertAlmostEqual(rows[-1]["T_max[degC]"], expected, delta=1)

    def test_metal_is_colder_by_what_its_sleeve_takes(self):
        said, rows = self.run_case("sleeve", SLAB + SLEEVE)
        rate = 2000 * (4 / 0.06 + 1 / 0.3) / (2500 * 1000)
        self.assertAlmostEqual(rows[0]["T_max[degC]"], 200 + 480 * math.exp(-4 * rate), delta=1e-6)
        self.assertIn("680.0 degC when it is poured into the shot sleeve", said)

    def test_mistakes_have_their_place(self):
        self.write("lump.toml", LUMP)
        for name, text, expected in (
                ("flow", JET.replace("4 l/min", "0.1 l/min"), "has a Reynolds number of"),
                ("near", JET.replace("24 mm", "4 mm"), "has a distance over the nozzle's diameter of 1"),
                ("wide", JET.replace("20 mm", "60 mm"), "has (nozzle/(2 radius))^2 of"),
                ("hot", JET.replace("30 degC", "300 degC"), "has an inlet temperature in degC of 300"),
                ("group", JET.replace("y_min", "nowhere"), "nowhere"),
                ("body", SLEEVE.replace('"slab"', '"casting"'), "[[shot_sleeve]] of 'casting': there is no such body"),
                ("warm", SLEEVE.replace("200 degC", "700 degC"), "its wall is hotter than the metal"),
                ("twice", SLEEVE + SLEEVE, "it is given twice"),
                ("full", SLEEVE.replace("0.5", "1.5"), "filling")):
            with self.subTest(name):
                self.write(f"{name}.toml", SLAB + text)
                result = solidus("check", f"{name}.toml", cwd=self.folder)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(f"{name}.toml:", result.stderr)
                self.assertIn(expected, result.stderr)
        frozen = SLAB.replace("lump.toml", "aluminium_alsi7mg") + SLEEVE.replace("4 s", "60 s")
        self.write("frozen.toml", frozen)
        result = solidus("check", "frozen.toml", cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("is solid before it is in the die", result.stderr)


if __name__ == "__main__":
    unittest.main()
