"""Derivatives of runs in which bodies deform, and a fit of a conductance over the gap that opens in them
(docs/guide/calibrate.md): a cylinder in its mould, coarse."""

import csv
import json
import unittest

import numpy as np

from program import SOURCES, ProgramTest, solidus

CASE = """
include = "%s"
title = "A cylinder in its mould, coarse"
[mesh.cylinder_in_mould]
radius = "15 mm"
height = "30 mm"
mould_wall = "20 mm"
mould_bottom = "20 mm"
mould_height = "50 mm"
element_size = "5 mm"
mould_element_size = "10 mm"
[time]
end = "40 s"
step = "2 s"
[heat]
tolerance = 1e-11
[mechanics]
tolerance = 1e-9
displacement_tolerance = 1e-8
[coupling]
order = "mechanics_first"
[[thermal_condition]]
name = "top"
group = "part_top"
kind = "radiation"
emissivity = 0.4
ambient = "25 degC"
[[probe]]
name = "T_center"
point = ["0 mm", "15 mm"]
[[probe]]
name = "T_casting_surface"
point = ["15 mm", "15 mm"]
[[probe]]
name = "T_mould_surface"
point = ["15 mm", "15 mm"]
[[probe]]
name = "u_casting_surface"
point = ["15 mm", "15 mm"]
[[probe]]
name = "u_mould_surface"
point = ["15 mm", "15 mm"]
[criteria]
follow = false
"""
AT = (0, 0.01, 0.03, 0.06)
TRUE = np.array([2300, 2000, 900, 350, 0.4])
UNKNOWNS = """
[[unknown]]
name = "h"
key = "contact.interface.heat.gap_conductance"
also = "contact.interface.heat.conductance"
of = "gap"
argument_unit = "mm"
at = [0, 0.01, 0.03, 0.06]
unit = "W/m2/K"
start = [1000, 1000, 1000, 1000]
lower = 50
upper = 20000
[[unknown]]
name = "emissivity"
key = "thermal_condition.top.emissivity"
start = 0.6
upper = 1
"""
PROBES = ("T_center[degC]", "T_casting_surface[degC]", "T_mould_surface[degC]", "u_casting_surface[mm]")


def columns(path):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, np.array(rows, dtype=float).T))


def interface(values):
    points = ", ".join(f"[{at!r}, {float(v)!r}]" for at, v in zip(AT, values))
    return [f'contact.interface.heat.gap_conductance={{ of = "gap", argument_unit = "mm", unit = "W/m2/K", points = [{points}] }}',
            f"contact.interface.heat.conductance={float(values[0])!r} W/m2/K"]


def knot(number):
    return lambda value: interface([value if i == number else v for i, v in enumerate(TRUE[:4])])


# From which value, and the assignments for a value. The change of a difference lets no point pass a switch.
PARAMETERS = {"knot 1": (TRUE[1], knot(1)), "knot 2": (TRUE[2], knot(2)),
              "emissivity": (0.4, lambda v: [f"thermal_condition.top.emissivity={v!r}"]),
              "expansion": (1.0, lambda v: [f"vary.body.part.expansion={v!r}"]),
              "pour": (670.0, lambda v: [f"body.part.initial_temperature={v!r} degC"])}
CHANGE = 1e-5


class Coupled(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("case.toml", CASE % (SOURCES / "cases/aluminium_cylinder/case.toml"))
        self.base = [word for text in interface(TRUE[:4]) for word in ("--set", text)]

    def test_derivatives_know_of_the_gap(self):
        listed = [f'[[parameter]]\nname = "{name}"\nchange = {1e-6 * value!r}\nset = {json.dumps(text(value * (1 + 1e-6)))}\n'
                  for name, (value, text) in PARAMETERS.items()]
        self.write("parameters.toml", "\n".join(listed))
        self.done("run", "case.toml", "-o", "base", *self.base, "--sensitivities", "parameters.toml")
        found = columns(self.folder / "base/sensitivities.csv")
        self.assertGreater(columns(self.folder / "base/history.csv")["gap[mm]"][-1], 0.03)
        for name, (value, text) in PARAMETERS.items():
            ends = []
            for sign in (-1, 1):
                moved = [word for assignment in text(value * (1 + sign * CHANGE)) for word in ("--set", assignment)]
                self.done("run", "case.toml", "-o", "beside", *self.base, *moved)
                ends.append(columns(self.folder / "beside/history.csv"))
            for probe in PROBES:
                expected = (ends[1][probe] - ends[0][probe]) / (2 * CHANGE * value)
                error = np.max(np.abs(found[f"{probe} by {name}"] - expected)) / np.max(np.abs(expected))
                # 2e-5 of the expansion, 7e-6 at most of the others.
                self.assertLess(error, 3e-5 if name == "expansion" else 1e-5, f"{name}, {probe}")

    def test_a_conductance_over_the_gap_is_found(self):
        truth = ["--set", 'mechanics.tolerance=1e-6', "--set", "heat.tolerance=1e-8"]
        self.done("run", "case.toml", "-o", "truth", *self.base, *truth)
        table = columns(self.folder / "truth/history.csv")
        names = ("time[s]", *PROBES)
        self.write("measured.csv", "\n".join([",".join(names), *(",".join(map(repr, map(float, row)))
                                                                 for row in zip(*(table[name] for name in names)))]))
        observed = "".join(f'[[observation]]\ncolumn = "{name.partition("[")[0]}"\nprobe = "{name.partition("[")[0]}"\n'
                           f'noise = {noise}\n' for name, noise in zip(PROBES, (0.5, 0.5, 0.5, 1e-4)))
        coarse = 'coarse = ["time.step=4 s"]\n'
        self.write("calibrate.toml", coarse + observed + UNKNOWNS)
        said = self.done("calibrate", "case.toml", "measured.csv", "-o", "out", *truth)
        self.assertIn("derivatives by forward differentiation", said)
        self.assertIn("the search begins with coarse runs: time.step=4 s", said)
        found = json.loads((self.folder / "out/calibrate.json").read_text())
        np.testing.assert_allclose([u["value"] for u in found["unknowns"]], TRUE, rtol=1e-5)
        # From the flat start it takes fifteen.
        self.assertLessEqual(found["runs"], 10)
        self.assertGreater(found["coarse_runs"], 3)
        self.assertLess(found["with_derivatives"], found["runs"])
        self.write("calibrate.toml", coarse.replace("time.step=4 s", "time.end=20 s") + observed + UNKNOWNS)
        result = solidus("calibrate", "case.toml", "measured.csv", "-o", "out", *truth, cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("'coarse': coarse runs have the time.end and the probes of the case", result.stderr)

    def test_what_has_no_derivatives_says_why(self):
        self.write("parameters.toml", '[[parameter]]\nname = "a"\nchange = 1e-6\nset = ["vary.body.part.density=1.000001"]\n')
        for assignment, message in (("coupling.order=heat_first", 'order = "mechanics_first"'),
                                    ("coupling.scheme=simultaneous", 'order = "mechanics_first"'),
                                    ("analysis.physics=mechanics", "")):
            result = solidus("run", "case.toml", "-o", "out", "--set", "time.end=4 s", "--set", assignment,
                             "--sensitivities", "parameters.toml", cwd=self.folder)
            self.assertEqual(result.returncode, 1, assignment)
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
