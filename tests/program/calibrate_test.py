"""Derivatives of runs against differences, and fits of cases with known answers (docs/guide/calibrate.md)."""

import csv
import json
import sys
import unittest

import numpy as np

from program import SOURCES, ProgramTest, solidus

sys.path.insert(0, str(SOURCES / "python"))

from solidus_plots.calibrate_model import lagged  # noqa: E402

METAL = """
title = "A metal that freezes over a range and at one temperature"
[density]
value = "2500 kg/m3"
[conductivity]
argument_unit = "degC"
unit = "W/m/K"
points = [[0, 120], [500, 160], [700, 80]]
[specific_heat]
argument_unit = "degC"
unit = "J/kg/K"
points = [[0, 900], [600, 1150]]
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "300 kJ/kg"
[phase_change.fraction]
kind = "table"
temperatures = ["555 degC", "555 degC", "610 degC"]
fractions = [1, 0.75, 0]
"""
CASE = """
title = "Freezing in a mould"
[analysis]
kind = "axisymmetric"
physics = "heat"
[mesh]
shape = "cylinder_in_mould"
element = "quad4"
[mesh.cylinder_in_mould]
radius = "20 mm"
height = "40 mm"
mould_wall = "20 mm"
mould_bottom = "20 mm"
mould_height = "60 mm"
element_size = "8 mm"
mould_element_size = "10 mm"
[time]
end = "40 s"
step = "2 s"
[heat]
tolerance = 1e-11
[[body]]
name = "part"
material = "metal.toml"
initial_temperature = "690 degC"
[[body]]
name = "mould"
material = "h13_tool_steel"
initial_temperature = "180 degC"
[[thermal_condition]]
name = "top"
group = "part_top"
kind = "radiation"
emissivity = 0.4
ambient = "25 degC"
[[thermal_condition]]
name = "outside"
group = "mould_outside"
kind = "film"
coefficient = { of = "temperature", argument_unit = "degC", unit = "W/m2/K", points = [[150, 60], [250, 150]] }
ambient = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 20], [40, 60]] }
[[contact]]
name = "interface"
slave = "part_surface"
master = "mould_surface"
[contact.heat]
contact_law = "table"
gap_law = "table"
slave_emissivity = 0.5
master_emissivity = 0.6
[[contact.heat.at]]
temperature = "300 degC"
contact_conductance = "900 W/m2/K"
gap_conductance = "900 W/m2/K"
[[contact.heat.at]]
temperature = "420 degC"
contact_conductance = "2500 W/m2/K"
gap_conductance = "2500 W/m2/K"
[[probe]]
name = "T_centre"
field = "temperature"
point = ["0 mm", "20 mm"]
unit = "degC"
[[probe]]
name = "T_wall"
field = "temperature"
point = ["23 mm", "20 mm"]
unit = "degC"
[criteria]
follow = false
"""
# What is changed, from which value, and by how much for a difference, so little that no node passes a bend of its curve or the
# end of its plateau by it; the assignment for a value.
PARAMETERS = {
    "knot": (900.0, 5e-3, lambda v: 'contact.interface.heat.at=[{ temperature = "300 degC", contact_conductance = "%r W/m2/K", '
             'gap_conductance = "%r W/m2/K" }, { temperature = "420 degC", contact_conductance = "2500 W/m2/K", '
             'gap_conductance = "2500 W/m2/K" }]' % (v, v)),
    "emissivity": (0.4, 2e-6, lambda v: f"thermal_condition.top.emissivity={v!r}"),
    "latent": (1.0, 5e-6, lambda v: f"vary.body.part.latent_heat={v!r}"),
    "specific": (1.0, 5e-6, lambda v: f"vary.body.part.specific_heat={v!r}"),
    "conductivity": (1.0, 5e-6, lambda v: f"vary.body.part.conductivity={v!r}"),
    "mould": (1.0, 5e-6, lambda v: f"vary.body.mould.conductivity={v!r}"),
    "pour": (690.0, 5e-4, lambda v: f"body.part.initial_temperature={v!r} degC"),
    "place": (23.0, 1e-3, lambda v: f'probe.T_wall.point=["{v!r} mm", "20 mm"]')}


def columns(path):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, np.array(rows, dtype=float).T))


class Sensitivities(ProgramTest):
    def derivatives(self, parameters, *words):
        listed = [f'[[parameter]]\nname = "{name}"\nchange = {1e-6 * value!r}\nset = [{json.dumps(text(value * (1 + 1e-6)))}]\n'
                  for name, (value, _, text) in parameters.items()]
        self.write("parameters.toml", "\n".join(listed))
        self.done("run", "case.toml", "-o", "base", "--sensitivities", "parameters.toml", *words)
        return columns(self.folder / "base/sensitivities.csv")

    def difference(self, name, parameters, *words):
        """The central one at the times of a run, by probe."""
        value, change, text = parameters[name]
        ends = []
        for sign in (-1, 1):
            self.done("run", "case.toml", "-o", "beside", "--set", text(value + sign * change), *words)
            ends.append(columns(self.folder / "beside/history.csv"))
        return {probe: (ends[1][probe] - ends[0][probe]) / (2 * change) for probe in ("T_centre[degC]", "T_wall[degC]")}

    def check(self, names, within, *words):
        parameters = {name: PARAMETERS[name] for name in names}
        found = self.derivatives(parameters, *words)
        for name in names:
            for probe, expected in self.difference(name, parameters, *words).items():
                error = np.max(np.abs(found[f"{probe} by {name}"] - expected)) / max(np.max(np.abs(expected)), 1e-12)
                self.assertLess(error, within, f"{name}, {probe}, {words}")

    def test_forward_derivatives_are_those_of_differences(self):
        self.write("metal.toml", METAL)
        self.write("case.toml", CASE)
        self.check(PARAMETERS, 1e-5)
        self.check(("knot", "latent"), 1e-5, "--set", "heat.stepping=backward_euler", "--set", "mesh.element=tri3")

    def test_a_run_without_derivatives_says_why(self):
        self.write("metal.toml", METAL)
        self.write("case.toml", CASE)
        self.write("parameters.toml", '[[parameter]]\nname = "a"\nchange = 1e-6\nset = ["vary.body.part.density=1.000001"]\n')
        for assignment, message in (("time.adaptive=true", "derivatives are known of runs with steps of a given size"),
                                    ("mesh.element=tri6", None),
                                    ("heat.integration=open", "derivatives are known where nodes hold the heat")):
            result = solidus("run", "case.toml", "-o", "out", "--sensitivities", "parameters.toml", "--set", assignment,
                             "--set", "time.end=2 s", cwd=self.folder)
            self.assertEqual(result.returncode, 0 if message is None else 1, result.stderr)
            if message:
                self.assertIn(message, result.stderr)
        self.write("parameters.toml", '[[parameter]]\nname = "a"\nchange = 0.0\nset = []\n')
        result = solidus("run", "case.toml", "-o", "out", "--sensitivities", "parameters.toml", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("parameters.toml:1:", result.stderr)


TRUE = np.array([600, 680, 800, 1000, 1350, 1800, 2300, 2700, 0.28])  # of examples/thermocouples/truth.toml
TWO = """
[[observation]]
column = "T_centre"
probe = "T_centre"
[[observation]]
column = "T_wall"
probe = "T_wall"
[[unknown]]
name = "emissivity"
key = "thermal_condition.top.emissivity"
start = 0.6
upper = 1
[[unknown]]
name = "film"
key = "%s"
start = 1.3
"""


class Fits(ProgramTest):
    def measure(self, run, probes, *words):
        """What a run has computed, as a table of a logger with all its digits."""
        self.done("run", run, "-o", "truth", *words)
        table = columns(self.folder / "truth/history.csv")
        header = {name.partition("[")[0]: name for name in table}
        rows = zip(*(table[name] for name in ("time[s]", *(header[probe] for probe in probes))))
        self.write("measured.csv", "\n".join(["time[s]," + ",".join(header[probe] for probe in probes),
                                              *(",".join(map(repr, map(float, row))) for row in rows)]))

    def found(self, folder="out"):
        return json.loads((self.folder / folder / "calibrate.json").read_text())

    def test_eight_points_of_a_conductance_and_an_emissivity_are_found_in_fifteen_runs(self):
        example = SOURCES / "examples/thermocouples"
        said = self.done("calibrate", str(example), str(example / "logger.csv"), "-o", "out")
        found = self.found()
        values = np.array([u["value"] for u in found["unknowns"]])
        off = np.abs(np.log(values / TRUE))
        self.assertTrue(np.all((off < 0.02) | (off < 2.5 * np.array([u["deviation"] for u in found["unknowns"]]))), values)
        self.assertLessEqual(found["runs"], 15)
        self.assertEqual(found["derivatives"], "forward")
        self.assertIn("column 'TC5' is not used: it says 22.1 from line 5 to 190: a dead channel", said)
        self.assertRegex(said, r"h at 380 degC +13[0-9]{2} +1[0-9]{3} +1[0-9]{3}  W/m2/K")
        for observation in found["observations"]:
            self.assertAlmostEqual(observation["rms"], 0.5, delta=0.1)
        self.assertIn("The case is in order.", self.done("check", "out/fitted.toml"))
        self.assertIn("by_name_alone = true", (self.folder / "out/interface.toml").read_text())
        self.assertTrue((self.folder / "out/calibrate.png").stat().st_size > 10000)
        # Without noise nothing is left but what the search and the derivatives leave.
        self.write("calibrate.toml", (example / "calibrate.toml").read_text().replace("begin = 5.0 ", "begin = 0.0 ").replace(
            "noise = 0.5", "").replace('"TC1"', '"T_centre"').replace('"TC2"', '"T_casting"').replace('"TC3"', '"T_wall"')
            .replace('"TC4"', '"T_mould"'))
        self.measure(str(example / "truth.toml"), ("T_centre", "T_casting", "T_wall", "T_mould"))
        self.done("calibrate", str(example), "measured.csv", "--unknowns", "calibrate.toml", "-o", "exact")
        found = self.found("exact")
        np.testing.assert_allclose([u["value"] for u in found["unknowns"]], TRUE, rtol=1e-5)
        self.assertLessEqual(found["runs"], 15)

    def test_points_of_a_card_a_place_a_lag_and_the_clock_are_found_together(self):
        self.write("metal.toml", METAL.replace("points = [[0, 120], [500, 160], [700, 80]]", "points = [[500, 160], [700, 80]]"))
        self.write("case.toml", CASE)
        self.done("run", "case.toml", "-o", "truth", "--set", 'probe.T_wall.point=["23.4 mm", "20 mm"]')
        table, lag, clock = columns(self.folder / "truth/history.csv"), 1.5, 0.7
        time = np.arange(1.0, 39.0, 0.5)
        curves = [np.interp(time + clock, table["time[s]"], lagged(table["time[s]"], table[f"{probe}[degC]"], lag))
                  for probe in ("T_centre", "T_wall")]
        self.write("measured.csv", "\n".join(["time[s],T_centre[degC],T_wall[degC]", *(",".join(map(repr, map(float, row)))
                                                                                      for row in zip(time, *curves))]))
        self.write("calibrate.toml", """
[[unknown]]
name = "k"
kind = "card"
key = "body.part.material"
property = "conductivity"
of = "temperature"
argument_unit = "degC"
at = [500, 700]
unit = "W/m/K"
start = [130, 100]
[[unknown]]
name = "place"
kind = "place"
probe = "T_wall"
direction = [1, 0]
[[unknown]]
name = "lag"
kind = "lag"
start = 0.5
[[unknown]]
name = "clock"
kind = "clock"
""")
        self.done("calibrate", "case.toml", "measured.csv", "-o", "out")
        np.testing.assert_allclose([u["value"] for u in self.found()["unknowns"]], [160, 80, 0.4, lag, clock], rtol=1e-4)
        self.assertIn("The case is in order.", self.done("check", "out/fitted.toml"))

    def test_differences_of_runs_serve_where_there_are_no_derivatives(self):
        self.write("metal.toml", METAL)
        self.write("case.toml", CASE + """[[probe]]
name = "solid"
kind = "mean"
field = "solid_fraction"
group = "part"
unit = "1"
""")
        self.write("calibrate.toml", "[[observation]]\ncolumn = \"solid\"\nprobe = \"solid\"\nunit = \"1\"\nnoise = 1e-3\n"
                   + (TWO % "vary.thermal_condition.outside.coefficient").replace("probe = \"T_", "noise = 0.1\nprobe = \"T_"))
        self.measure("case.toml", ("T_centre", "T_wall", "solid"))
        said = self.done("calibrate", "case.toml", "measured.csv", "-o", "out", "-j", "2")
        self.assertIn("derivatives by differences of runs, 2 at a time: 'solid' is no temperature", said)
        np.testing.assert_allclose([u["value"] for u in self.found()["unknowns"]], [0.4, 1.0], rtol=1e-3)
        self.assertLessEqual(self.found()["runs"], 15)

    def test_unknowns_that_cannot_be_told_apart_are_refused_with_their_names(self):
        self.write("metal.toml", METAL)
        self.write("case.toml", CASE)
        self.write("calibrate.toml", TWO % "vary.thermal_condition.top.coefficient")
        self.measure("case.toml", ("T_centre", "T_wall"))
        result = solidus("calibrate", "case.toml", "measured.csv", "-o", "out", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("the readings depend on 'emissivity' and 'film' through one combination of them", result.stderr)
        result = solidus("calibrate", "case.toml", "measured.csv", "--set", "time.end=20 s", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("measured.csv:13: 22 s of the logger is 22 s of the case, which ends at 20 s", result.stderr)


if __name__ == "__main__":
    unittest.main()
