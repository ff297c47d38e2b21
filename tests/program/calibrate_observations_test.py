"""Fits to displacements, gaps, forces and times of freezing, of cases with known answers (docs/guide/calibrate.md)."""

import csv
import json
import shutil
import unittest

import numpy as np

from program import SOURCES, ProgramTest

# Two bars whose gap closes (cases/ten_tests/closing_gap), hotter from the start on, with a probe for each kind of observation.
BARS = """
include = "%s"
title = "A gap that closes"
[time]
end = "4000 s"
step = "200 s"
[[thermal_condition]]
name = "hot"
temperature = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 20], [3000, 150], [4000, 150]] }
[[probe]]
name = "u"
field = "displacement"
component = "x"
point = ["100 mm", "5 mm"]
body = "left"
unit = "um"
[[probe]]
name = "force"
kind = "global"
global = "gap_normal_force"
unit = "N"
"""
UNKNOWNS = """
[[observation]]
column = "gap_open"
probe = "gap_open"
unit = "um"
noise = 0.1
until = 1800
[[observation]]
column = "u"
probe = "u"
unit = "um"
noise = 0.1
[[observation]]
column = "force"
probe = "force"
unit = "N"
noise = 1e4
from = 3000
[[unknown]]
name = "expansion"
key = "vary.body.left.expansion"
start = 1.1
[[unknown]]
name = "gas"
key = "contact.gap.heat.gas_conductivity"
unit = "W/m/K"
start = 0.08
[[unknown]]
name = "stiffness"
key = "vary.body.left.young_modulus"
start = 0.8
"""
PRESSED = """contact_law = "table"
contact_conductance = { of = "pressure", argument_unit = "MPa", unit = "W/m2/K", points = [[0, 1500], [10, 3000], [40, 7000]] }
"""
BY_PRESSURE = """
set = ['coupling.order="mechanics_first"']
[[observation]]
column = "T_left_open"
noise = 0.1
[[observation]]
column = "T_right_open"
noise = 0.1
[[unknown]]
name = "h"
key = "contact.gap.heat.contact_conductance"
of = "pressure"
argument_unit = "MPa"
at = [0, 10, 40]
unit = "W/m2/K"
start = 2500
"""
FREEZING = """
include = "%s"
title = "A bar freezes"
"""
# A quarter of a plate with an empty bore of 2 mm, of which the far edges keep the temperature of a plate without it, 2 K/mm.
HOLE = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 30, 30};
Disk(2) = {0, 0, 0, 1};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Physical Surface("plate") = {3};
left[] = Curve In BoundingBox{-0.01, -0.01, -0.01, 0.01, 30.01, 0.01};
right[] = Curve In BoundingBox{29.99, -0.01, -0.01, 30.01, 30.01, 0.01};
Physical Curve("left") = {left[]};
Physical Curve("right") = {right[]};
Field[1] = MathEval;
Field[1].F = "0.08 + 0.1*(Sqrt(x*x + y*y) - 1)";
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
"""
PLATE = """
title = "A plate with a bore"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "plate.geo"
unit = "mm"
[time]
steady = true
[[body]]
name = "plate"
material = "metal.toml"
initial_temperature = "400 degC"
[[thermal_condition]]
name = "left"
group = "left"
kind = "temperature"
temperature = "400 degC"
[[thermal_condition]]
name = "right"
group = "right"
kind = "temperature"
temperature = "460 degC"
[[probe]]
name = "T_wall"
field = "temperature"
point = ["1 mm", "0 mm"]
unit = "degC"
"""
SLAB = """
title = "A slab with a thermocouple in its middle"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
[mesh.block]
size = ["10 mm", "1 mm"]
divisions = [10, 1]
[time]
end = "10 s"
step = "0.5 s"
[[body]]
name = "block"
material = "metal.toml"
initial_temperature = { formula = "400 + 2000*x", unit = "degC" }
[[thermal_condition]]
name = "left"
group = "x_min"
kind = "temperature"
temperature = "400 degC"
[[thermal_condition]]
name = "right"
group = "x_max"
kind = "temperature"
temperature = "420 degC"
[[probe]]
name = "T"
field = "temperature"
point = ["5 mm", "0.5 mm"]
unit = "degC"
"""
IN_A_BORE = """
[[observation]]
column = "T"
probe = "T"
noise = 0.1
from = 5
bore = { diameter = 2, bead = 0.8, filling = 0.25, direction = [1, 0] }
[[unknown]]
name = "hot wall"
key = "thermal_condition.right.temperature"
unit = "degC"
start = 415
"""
PROBE = """
[[probe]]
name = "frozen_%d"
field = "solidified_at"
point = ["%d mm", "0 mm"]
unit = "s"
"""


def columns(file):
    rows = list(csv.reader(file.read_text().splitlines()))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


class Observations(ProgramTest):
    def found(self):
        return [u["value"] for u in json.loads((self.folder / "out/calibrate.json").read_text())["unknowns"]]

    def test_gaps_displacements_and_forces_are_observations(self):
        self.write("case.toml", BARS % (SOURCES / "cases/ten_tests/closing_gap/solidus.toml"))
        self.done("run", "case.toml", "-o", "truth")
        table = columns(self.folder / "truth/history.csv")
        names = ["time[s]", "gap_open[um]", "u[um]", "force[N]"]
        self.assertGreater(table["gap_open[um]"][1], 50)
        self.assertGreater(max(table["force[N]"]), 1e5)
        self.write("measured.csv", "\n".join([",".join(names), *(",".join(map(repr, row)) for row in zip(*(table[n] for n in names)))]))
        self.write("calibrate.toml", UNKNOWNS)
        said = self.done("calibrate", "case.toml", "measured.csv", "-o", "out", "-j", "2")
        self.assertIn("derivatives by differences of runs", said)
        np.testing.assert_allclose(self.found(), [1, 0.05, 1], rtol=2e-3)

    def test_points_of_a_conductance_by_pressure_are_found(self):
        # The bars of the gap, with a conductance that rises with the pressure.
        source = SOURCES / "cases/ten_tests/closing_gap"
        text = (source / "solidus.toml").read_text().replace('conductance = "5000 W/m2/K"\n', PRESSED)
        for name in ("mesh.msh", "left.toml", "right.toml"):
            text = text.replace(f'"{name}"', f'"{source / name}"')
        self.write("bars.toml", text)
        self.write("case.toml", BARS % "bars.toml")
        self.done("run", "case.toml", "-o", "truth", "--set", 'coupling.order="mechanics_first"')
        table = columns(self.folder / "truth/history.csv")
        names = ["time[s]", "T_left_open[degC]", "T_right_open[degC]"]
        self.write("measured.csv", "\n".join([",".join(names), *(",".join(map(repr, row)) for row in zip(*(table[n] for n in names)))]))
        self.write("calibrate.toml", BY_PRESSURE)
        said = self.done("calibrate", "case.toml", "measured.csv", "-o", "out")
        self.assertIn("derivatives by forward differentiation", said)
        np.testing.assert_allclose(self.found(), [1500, 3000, 7000], rtol=1e-6)
        self.assertLessEqual(json.loads((self.folder / "out/calibrate.json").read_text())["runs"], 15)

    def test_times_of_freezing_are_observations(self):
        self.write("case.toml", FREEZING % (SOURCES / "cases/ten_tests/stefan/solidus.toml") + PROBE % (10, 10) + PROBE % (20, 20))
        self.done("run", "case.toml", "-o", "truth")
        table = columns(self.folder / "truth/history.csv")
        values = {name: table[f"{name}[s]"][-1] for name in ("frozen_10", "frozen_20")}
        # Neumann's front passes x at t = (x/(2 lambda))^2/a, four times later at twice the distance.
        self.assertAlmostEqual(values["frozen_20"] / values["frozen_10"], 4, delta=0.2)
        self.write("measured.csv", "time[s],T_5mm[degC]\n" + "\n".join(
            f"{t!r},{v!r}" for t, v in zip(table["time[s]"][1:], table["T_5mm[degC]"][1:])))
        self.write("calibrate.toml", '[[observation]]\ncolumn = "T_5mm"\nprobe = "T_5mm"\nunit = "degC"\nnoise = 0.5\n' + "".join(
            f'[[observation]]\nprobe = "{name}"\nvalue = {value!r}\nunit = "s"\nnoise = 0.05\n' for name, value in values.items())
            + '[[unknown]]\nname = "latent"\nkey = "vary.body.bar.latent_heat"\nstart = 1.2\n'
            '[[unknown]]\nname = "k"\nkey = "vary.body.bar.conductivity"\nstart = 0.9\n')
        self.done("calibrate", "case.toml", "measured.csv", "-o", "out", "-j", "2")
        np.testing.assert_allclose(self.found(), [1, 1], rtol=5e-3)

    def test_the_gradient_doubles_at_an_empty_bore(self):
        self.write("plate.geo", HOLE)
        shutil.copy(SOURCES / "cases/ten_tests/clamped_cube/metal.toml", self.folder)
        self.write("case.toml", PLATE)
        self.done("run", "case.toml", "-o", "out")
        # The wall of the hole reads what the plate without it has at two radii from the axis: calibrate_file.place_of_bead.
        read = columns(self.folder / "out/history.csv")["T_wall[degC]"][-1]
        self.assertAlmostEqual((read - 400) / 2, 2.0, delta=0.02)

    def test_the_bore_of_a_thermocouple_enters_the_interval(self):
        shutil.copy(SOURCES / "cases/ten_tests/clamped_cube/metal.toml", self.folder)
        self.write("case.toml", SLAB)
        self.write("measured.csv", "time[s],T[degC]\n" + "".join(f"{t},{410 + 0.1 * (-1) ** t}\n" for t in range(1, 11)))
        self.write("calibrate.toml", IN_A_BORE)
        self.done("calibrate", "case.toml", "measured.csv", "-o", "out")
        wall, place = json.loads((self.folder / "out/calibrate.json").read_text())["unknowns"]
        self.assertAlmostEqual(wall["value"], 420, delta=0.1)
        # The bead is 2/(1 + 0.25) (2 − 0.8)/4 mm from the axis in the mean of squares, where the slab has 2 K/mm; the reading in
        # the middle has half of what the wall has.
        of_place = 2 / 1.25 * 1.2 / 4 * 2 / 0.5
        self.assertAlmostEqual(wall["deviation"], np.hypot(of_place, 0.1 / np.sqrt(6) / 0.5), delta=0.01 * of_place)
        self.assertAlmostEqual(place["deviation"], 0.48, delta=0.001)


if __name__ == "__main__":
    unittest.main()
