"""Laws of an interface that the case gives in parts: a conductance for each side (monograph 3.45), and spots whose mean
conductivity is that of both materials (3.47)."""

import csv

from program import ProgramTest, solidus

METAL = """
density = "7800 kg/m3"
conductivity = "{} W/m/K"
specific_heat = "500 J/kg/K"
"""
CASE = """
title = "A hot block on a cold one"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "hex8"
[mesh.two_blocks]
lower = ["10 mm", "10 mm", "20 mm"]
lower_divisions = [1, 1, 4]
upper = ["10 mm", "10 mm", "20 mm"]
upper_divisions = [1, 1, 4]
[time]
end = "20 s"
step = "2 s"
[[body]]
name = "upper"
material = "hot.toml"
initial_temperature = "450 degC"
[[body]]
name = "lower"
material = "cold.toml"
initial_temperature = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[[probe]]
name = "T"
field = "temperature"
point = ["5 mm", "5 mm", "0 mm"]
body = "lower"
unit = "degC"
[contact.heat]
gap_law = "constant"
"""
SPOTS = """contact_law = "spots"
open_conductance = "1500 W/m2/K"
[contact.heat.asperities]
roughness = "4 um"
slope = 0.15
hardness_coefficient = "6270 MPa"
"""


class Sides(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("hot.toml", METAL.format(200))
        self.write("cold.toml", METAL.format(50))

    def end(self, name, law):
        self.write(f"{name}.toml", CASE + law)
        self.done("run", f"{name}.toml", "-o", name)
        with (self.folder / name / "history.csv").open(newline="") as file:
            return float(list(csv.DictReader(file))[-1]["T[degC]"])

    def test_both_sides_in_a_row_conduct_as_one_coefficient(self):
        sides = ('contact_law = "sides"\n[[contact.heat.sides]]\nslave_conductance = "3000 W/m2/K"\n'
                 'master_conductance = "6000 W/m2/K"\n')
        self.assertAlmostEqual(self.end("sides", sides), self.end("one", 'conductance = "2000 W/m2/K"\n'), delta=1e-6)

    def test_a_share_beside_both_sides_is_refused(self):
        self.write("both.toml", CASE + 'contact_law = "sides"\nslave_resistance = 0.3\n[[contact.heat.sides]]\n'
                   'slave_conductance = "3000 W/m2/K"\nmaster_conductance = "6000 W/m2/K"\n')
        refused = solidus("check", "both.toml", cwd=self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("'slave_resistance' with a law that has both sides", refused.stdout + refused.stderr)

    def test_spots_conduct_by_both_materials(self):
        given = self.end("given", SPOTS + 'conductivity = "80 W/m/K"\n')  # 2 x 200 x 50/250
        self.assertAlmostEqual(self.end("found", SPOTS), given, delta=1e-6)
