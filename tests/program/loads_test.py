"""Loads over place and time, bodies that turn and stress at the start, through the whole program."""

import csv
import math
import unittest

from program import ProgramTest, solidus

# A block 200 mm wide and 300 mm high that leans on its right side, x = 0, and stands on its foot. With the virtual displacement
# (x, 0) the mean of σ_xx over it is that of what acts on it times x, whatever the elements are.
BLOCK = """
title = "A loaded block"
[analysis]
kind = "plane_strain"
physics = "mechanics"
gravity = "9.81 m/s2"
[mesh]
shape = "block"
element = "{element}"
[mesh.block]
size = ["200 mm", "300 mm"]
origin = ["-200 mm", "0 mm"]
divisions = [4, 6]
[time]
end = "4 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "wall"
group = "x_max"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[probe]]
name = "mean"
kind = "mean"
field = "stress"
component = "xx"
group = "block"
unit = "Pa"
[[probe]]
name = "u"
field = "displacement"
component = "x"
point = ["-200 mm", "300 mm"]
unit = "mm"
[mechanics]
tolerance = 1e-11
linear_tolerance = 1e-13
[output]
checkpoint_every = 1
"""
MELT = """
[[mechanical_condition]]
name = "melt"
group = "x_min"
kind = "metallostatic"
density = "7000 kg/m3"
level = { of = "time", argument_unit = "s", unit = "mm", points = [[0, 0], [2, 250]] }
squeeze = { of = "time", argument_unit = "s", unit = "bar", points = [[2, 0], [4, 2]] }
"""
MOVING = """
[[mechanical_condition]]
name = "wandering"
group = "x_min"
kind = "pressure"
pressure = { formula = "1e6*(1 + sin(20*y))*min(t, 3)", moving = ["0 mm/s", "5 mm/s"] }
[[mechanical_condition]]
name = "stirred"
group = "block"
kind = "body_force"
force = [{ formula = "1e6*x*y*t" }, "0 N/m3"]
"""
RING = """
title = "A ring that turns"
[analysis]
kind = "axisymmetric"
physics = "mechanics"
[mesh]
shape = "block"
element = "quad8"
[mesh.block]
size = ["100 mm", "5 mm"]
origin = ["100 mm", "0 mm"]
divisions = [20, 1]
[time]
end = "2 s"
step = "1 s"
[rotation]
omega = { of = "time", argument_unit = "s", unit = "rpm", points = [[0, 0], [1, 3000], [2, 6000]] }
[[body]]
name = "ring"
group = "block"
material = "ring.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "top"
group = "y_max"
kind = "displacement"
uz = "0 mm"
[[probe]]
name = "u"
field = "displacement"
component = "r"
point = ["200 mm", "0 mm"]
unit = "m"
"""
ELASTIC = """
title = "An elastic metal"
density = "7800 kg/m3"
conductivity = "20 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-5 1/K"
"""
# A bar of triangles that bends as its upper half is warmer at the start than at the end.
WARPED = """
title = "A bar with residual stress"
[analysis]
kind = "plane_strain"
physics = "{physics}"
[mesh]
shape = "block"
element = "tri3"
[mesh.block]
size = ["100 mm", "20 mm"]
divisions = [20, 8]
[time]
end = "{end}"
step = "{step}"
[[body]]
name = "bar"
group = "block"
material = "ring.toml"
initial_temperature = {start}
{stress}
[[mechanical_condition]]
name = "end"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[mechanics]
simplices = "displacement"
tolerance = 1e-11
[[probe]]
name = "mises"
kind = "maximum"
field = "von_mises"
group = "block"
unit = "MPa"
[[probe]]
name = "u"
field = "displacement"
component = "x"
point = ["100 mm", "20 mm"]
unit = "mm"
"""


class Loads(ProgramTest):
    def history(self, name, text, *more, **options):
        file = self.write(f"{name}.toml", text)
        self.done("run", str(file), "-o", str(self.folder / name), "--no-progress", *more, **options)
        return self.rows(name)

    def rows(self, name):
        with (self.folder / name / "history.csv").open() as table:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]

    def test_a_melt_that_is_not_in_the_mesh_presses_by_its_depth_and_is_squeezed(self):
        for element in ("tri3", "quad4", "quad8"):
            rows = self.history(element, BLOCK.format(element=element) + MELT)
            for row in rows[1:]:
                time = row["time[s]"]
                # Once the level is at an edge of the mesh the rule is exact.
                if time < 2:
                    continue
                squeeze = 1e5 * (time - 2)
                force = 7000 * 9.81 * 0.25 ** 2 / 2 + squeeze * 0.25
                self.assertAlmostEqual(row["mean[Pa]"] / (-force / 0.3), 1, delta=1e-9, msg=f"{element} {time}")

    def test_a_pressure_that_wanders_and_a_force_in_the_volume_have_their_moments(self):
        rows = self.history("moving", BLOCK.format(element="quad8") + MOVING)
        for row in rows[1:]:
            t = row["time[s]"]
            shift = 5e-3 * t

            def primitive(y):
                return y - math.cos(20 * (y - shift)) / 20

            pressed = 1e6 * min(t, 3) * (primitive(0.3) - primitive(0))
            stirred = 1e6 * t * 0.2 ** 3 / 3 * 0.3 ** 2 / 2   # ∫ f x dV of f = c x y
            self.assertAlmostEqual(row["mean[Pa]"] * 0.06 / (-0.2 * pressed + stirred), 1, delta=1e-6, msg=str(t))

    def test_a_ring_that_turns_widens_as_the_closed_form_says(self):
        self.write("ring.toml", ELASTIC)
        rows = self.history("ring_case", RING)
        young, nu, density, a, b = 2e11, 0.3, 7800, 0.1, 0.2
        mu, lam = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
        for row, rpm in zip(rows[1:], (3000, 6000)):
            f = density * (rpm * 2 * math.pi / 60) ** 2
            k = f * (2 * lam + 3 * mu) / (4 * (lam + 2 * mu))
            u = (k * (a * a + b * b) / (2 * (lam + mu)) * b + k * a * a * b / (2 * mu)
                 - f * b ** 3 / (8 * (lam + 2 * mu)))
            self.assertAlmostEqual(row["u[m]"] / u, 1, delta=1e-5)

    def test_a_run_that_goes_on_and_one_on_two_processes_give_the_same(self):
        text = BLOCK.format(element="tri3") + MELT + MOVING
        whole = self.history("whole", text)
        file = str(self.folder / "whole.toml")
        self.done("run", file, "-o", "parts", "--no-progress", "--set", "time.end=2 s")
        self.done("run", file, "-o", "parts", "--no-progress", "--restart")
        self.assertEqual((self.folder / "parts/history.csv").read_text(), (self.folder / "whole/history.csv").read_text())
        two = self.history("two", text, env={"SOLIDUS_PROCESSES": "2"})
        for one, other in zip(whole, two):
            for column in ("mean[Pa]", "u[mm]"):
                self.assertAlmostEqual(one[column], other[column], delta=1e-9 * max(1, abs(one[column])))

    def test_a_stress_goes_over_into_another_run_and_stays(self):
        self.write("ring.toml", ELASTIC)
        first = self.history("first", WARPED.format(
            physics="thermomechanical", end="2 s", step="0.5 s", stress="",
            start='{ formula = "20 + 8e6*y^3", unit = "degC" }'))
        stressed = first[-1]["mises[MPa]"]
        self.assertGreater(stressed, 0.5)
        vtu = max((self.folder / "first/fields").glob("*.vtu"))
        second = WARPED.format(physics="mechanics", end="1 s", step="1 s", start='"20 degC"',
                               stress=f'[body.initial_stress]\nfile = "{vtu}"\nbody = 0\n')
        for processes in ("1", "2"):
            rows = self.history("second" + processes, second, env={"SOLIDUS_PROCESSES": processes})
            self.assertAlmostEqual(rows[-1]["mises[MPa]"] / stressed, 1, delta=1e-6)
            self.assertLess(abs(rows[-1]["u[mm]"]), 1e-9)

    def test_a_stress_that_is_linear_over_the_height_bends_a_bar_free_of_it(self):
        # σ_xx = c (y − h/2) belongs to a strain that fits together: the bar bends and keeps nothing, but that elements have one stress
        # each, which takes 1/n² of the moment with n of them over the height.
        self.write("ring.toml", ELASTIC)
        c, n = 5e9, 16
        text = WARPED.format(physics="mechanics", end="1 s", step="1 s", start='"20 degC"',
                             stress=f'[body.initial_stress]\nxx = {{ formula = "{c}*(y - 0.01)" }}\n')
        text = text.replace('"tri3"', '"quad4"').replace("[20, 8]", f"[20, {n}]").replace('group = "y_min"', 'group = "x_min"')
        rows = self.history("bent", text)
        bent = -1e3 * (1 - 0.3 ** 2) * c * 0.01 * 0.1 / 2e11 * (1 - 1 / n ** 2)
        self.assertAlmostEqual(rows[-1]["u[mm]"] / bent, 1, delta=0.03)

    def test_what_cannot_be_is_refused_with_its_line(self):
        self.write("ring.toml", ELASTIC)
        block, bar = BLOCK.format(element="quad4"), WARPED.format(
            physics="mechanics", end="1 s", step="1 s", start='"20 degC"', stress="{stress}")
        for name, text, said in (
                ("weightless", block.replace('gravity = "9.81 m/s2"', "") + MELT, "gravity is 0"),
                ("flat", block + MOVING.replace(', "0 N/m3"]', "]"), "the force 'stirred' has 1 components"),
                ("nowhere", block + MOVING.replace('group = "block"', 'group = "x_min"'), "is no body of the case"),
                ("unknown", block + MOVING.replace("sin(20*y)", "sin(20*z)"), "uses z, which this analysis does not have"),
                ("infinite", block + MOVING.replace("(1 + sin(20*y))", "1/(t - 2)"), "'pressure' is not finite at"),
                ("askew", RING.replace("[rotation]", "[rotation]\naxis = [1, 0, 0]"), "the axis of [rotation] is not that"),
                ("stranger", RING.replace("[rotation]", '[rotation]\nbodies = ["rim"]'), "the unknown body 'rim'"),
                ("both", bar.format(stress='[body.initial_stress]\nfile = "a.vtu"\nxx = "1 MPa"'), "both a file and components"),
                ("neither", bar.format(stress="[body.initial_stress]"), "neither a file nor a component"),
                ("missing", bar.format(stress='[body.initial_stress]\nfile = "a.vtu"'), "does not exist"),
                ("deep", bar.format(stress='[body.initial_stress]\nyz = "1 MPa"'), "yz and xz are zero")):
            file = self.write(f"{name}.toml", text)
            result = solidus("run", str(file), "-o", str(self.folder / name), "--no-progress")
            self.assertEqual(result.returncode, 1, f"{name}: {result.stdout[-500:]}{result.stderr}")
            self.assertIn(said, result.stderr + result.stdout, name)
            self.assertIn(f"{name}.toml:", result.stderr + result.stdout, name)


if __name__ == "__main__":
    unittest.main()
