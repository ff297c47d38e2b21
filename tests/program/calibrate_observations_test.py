"""Fits to displacements, gaps, forces and times of freezing, of cases with known answers (docs/guide/calibrate.md)."""

import csv
import json
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
FREEZING = """
include = "%s"
title = "A bar freezes"
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


if __name__ == "__main__":
    unittest.main()
