"""Sand with stiffness and strength through the whole program: strengths in closed form with several elements, collapse, restart,
processes, heat, and what is refused."""

import csv
import math
import unittest

from program import ProgramTest, solidus

SAND = """
density = "1500 kg/m3"
conductivity = "0.6 W/m/K"
specific_heat = "1000 J/kg/K"
young_modulus = "300 MPa"
poisson_ratio = "0.25"
expansion = "0 1/K"
[granular]
friction_angle = "35 degree"
dilatancy_angle = "10 degree"
cohesion = "80 kPa"
tension_cutoff = "20 kPa"
residual_stiffness = 0
"""
# A cylinder between plates without friction, pressed at its side, in {element}s.
CYLINDER = """
title = "Sand under cell pressure"
[analysis]
kind = "{kind}"
physics = "mechanics"
[mesh]
shape = "block"
element = "{element}"
[mesh.block]
size = {size}
divisions = {divisions}
[time]
end = "10 s"
step = "0.5 s"
[[body]]
name = "block"
material = "sand.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "{axis}_min"
kind = "displacement"
u{component} = "0 mm"
[[mechanical_condition]]
name = "plate"
group = "{axis}_max"
kind = "displacement"
u{component} = {{ of = "time", argument_unit = "s", unit = "mm", points = [[0, 0], [10, -0.5]] }}
[[probe]]
name = "axial"
kind = "mean"
field = "stress"
component = "{component}{component}"
group = "block"
unit = "kPa"
[mechanics]
tolerance = 1e-12
simplices = "displacement"
"""
SIDE = """
[[mechanical_condition]]
name = "side_{group}"
group = "{group}"
kind = "pressure"
pressure = {{ of = "time", argument_unit = "s", unit = "kPa", points = [[0, 0], [2, 50]] }}
"""
HELD = """
[[mechanical_condition]]
name = "held_{group}"
group = "{group}"
kind = "displacement"
{component} = "0 mm"
"""
# A hot block of aluminium lies on sand and is pressed onto it.
HOT = """
title = "A hot block on sand"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
gravity = "9.81 m/s2"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["100 mm", "40 mm"]
lower_divisions = [10, 5]
upper = ["60 mm", "30 mm"]
upper_divisions = [7, 4]
[time]
end = "40 s"
step = "2 s"
[criteria]
follow = false
[[body]]
name = "upper"
material = "aluminium_99_7"
initial_temperature = "500 degC"
[[body]]
name = "lower"
role = "mould"
material = "furan_sand_yielding"
initial_temperature = "20 degC"
[[interface]]
bodies = "all"
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "middle_lower"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "middle_upper"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "press"
group = "upper_y_max"
kind = "pressure"
pressure = {{ of = "time", argument_unit = "s", unit = "MPa", points = [[0, 0], [40, {press}]] }}
[[probe]]
name = "u"
field = "displacement"
component = "y"
point = ["0 mm", "40 mm"]
body = "lower"
unit = "mm"
[[probe]]
name = "strain"
kind = "maximum"
field = "equivalent_plastic_strain"
group = "lower"
unit = "1"
[output]
checkpoint_every = 5
"""


class Sand(ProgramTest):
    def rows(self, name):
        with (self.folder / name / "history.csv").open() as table:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]

    def history(self, name, text, *more, **options):
        file = self.write(f"{name}.toml", text)
        self.done("run", str(file), "-o", str(self.folder / name), "--no-progress", *more, **options)
        return self.rows(name)

    def test_elements_of_all_kinds_bear_what_mohr_and_coulomb_say_at_a_cell_pressure(self):
        self.write("sand.toml", SAND)
        n = (1 + math.sin(math.radians(35))) / (1 - math.sin(math.radians(35)))
        expected = -(50 * n + 2 * 80 * math.sqrt(n))
        for element in ("quad4", "quad8", "tri6", "tri3"):
            text = CYLINDER.format(kind="axisymmetric", element=element, size='["10 mm", "20 mm"]', divisions="[1, 1]",
                                   axis="y", component="z") + SIDE.format(group="x_max")
            self.assertAlmostEqual(self.history(element, text)[-1]["axial[kPa]"] / expected, 1, delta=1e-8, msg=element)
        for element in ("hex8", "tet4", "tet10", "hex20"):
            text = CYLINDER.format(kind="solid", element=element, size='["10 mm", "10 mm", "20 mm"]', divisions="[1, 1, 1]",
                                   axis="z", component="z")
            text += "".join(HELD.format(group=f"{axis}_min", component=f"u{axis}") + SIDE.format(group=f"{axis}_max") for axis in "xy")
            self.assertAlmostEqual(self.history(element, text)[-1]["axial[kPa]"] / expected, 1, delta=1e-8, msg=element)

    def test_a_hot_block_sinks_into_sand_and_the_first_law_closes(self):
        rows = self.history("hot", HOT.format(press=3))
        self.assertGreater(rows[-1]["strain[1]"], 1e-4)
        self.assertLess(abs(self.summary(self.folder / "hot")["answers"]["relative_energy_defect"]), 1e-6)

    def test_sand_that_collapses_ends_no_run(self):
        rows = self.history("collapse", HOT.format(press=8))
        self.assertGreater(rows[-1]["strain[1]"], 0.02)
        self.assertTrue(all(math.isfinite(value) for row in rows for value in row.values()))

    def test_a_run_that_goes_on_and_one_on_two_processes_give_the_same(self):
        whole = self.history("whole", HOT.format(press=3))
        file = str(self.folder / "whole.toml")
        self.done("run", file, "-o", "parts", "--no-progress", "--set", "time.end=20 s")
        self.done("run", file, "-o", "parts", "--no-progress", "--restart")
        self.assertEqual((self.folder / "parts/history.csv").read_text(), (self.folder / "whole/history.csv").read_text())
        two = self.history("two", HOT.format(press=3), env={"SOLIDUS_PROCESSES": "2"})
        for column in ("u[mm]", "strain[1]"):
            self.assertAlmostEqual(two[-1][column] / whole[-1][column], 1, delta=1e-4, msg=column)

    def test_what_sand_does_not_go_with_is_refused_in_words(self):
        text = HOT.format(press=3)
        file = self.write("refused.toml", text + '[coupling]\nscheme = "simultaneous"\n')
        result = solidus("check", str(file), cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("the granular law of 'furan_sand_yielding' does not give", result.stderr)


if __name__ == "__main__":
    unittest.main()
