"""Cooling channels and the life of a die through the whole program: the first law, restart, processes, shots, what `check` says."""

import csv
import json
import unittest

from program import ProgramTest, solidus

# A hot slab on a cold one; a bore cools the lower one.
SLABS = """
title = "A slab cooled by a bore"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "30 mm"]
lower_divisions = [12, 6]
upper = ["60 mm", "10 mm"]
upper_divisions = [12, 2]
[time]
end = "60 s"
step = "5 s"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "300 degC"
[[body]]
name = "upper"
material = "steel_mould"
initial_temperature = "300 degC"
[[contact]]
name = "joint"
slave = "upper_bottom"
master = "lower_top"
heat.conductance = "5000 W/m2/K"
heat.gap_law = "gas"
heat.gas_conductivity = "0.05 W/m/K"
[output]
checkpoint_every = 1
"""
BORE = """
[[channel]]
name = "bore"
body = "lower"
path = { x = "31 mm", y = "14 mm" }
diameter = "8 mm"
flow = { of = "time", argument_unit = "s", unit = "l/min", points = [[0, 10], [30, 10], [31, 6]] }
inlet_temperature = "20 degC"
pressure = "1 bar"
"""


class ChannelsTest(ProgramTest):
    def rows(self, folder):
        with open(self.folder / folder / "history.csv", encoding="utf-8") as table:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]

    def run_case(self, name, text, *arguments, processes=1):
        self.write(f"{name}.toml", text)
        result = solidus("run", f"{name}.toml", "-o", name, "--no-progress", *arguments, cwd=self.folder,
                         env={"SOLIDUS_PROCESSES": str(processes)})
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout + result.stderr

    def test_water_takes_what_the_slabs_lose_and_a_run_goes_on_with_the_same_digits(self):
        said = self.run_case("straight", SLABS + BORE)
        last = self.rows("straight")[-1]
        self.assertLess(abs(last["energy_defect[J]"]), 1e-10 * last["heat_exchanged[J]"])
        # Nothing else cools: the water has what the slabs have lost.
        self.assertAlmostEqual(last["heat_to_channels[J]"] / -last["stored_heat[J]"], 1, delta=1e-8)
        self.assertGreater(last["bore_film[W/m2/K]"], 5000)
        self.assertGreater(last["bore_reynolds[1]"], 10000)
        # The flow falls at half time, and with it the Reynolds number.
        self.assertLess(last["bore_reynolds[1]"], 0.8 * self.rows("straight")[4]["bore_reynolds[1]"])
        self.assertLess(20, last["bore_outlet[degC]"])
        self.assertGreater(last["bore_wall[degC]"], last["bore_outlet[degC]"])
        self.assertRegex(said, "channel 'bore': its wall is .* water of 1 bar boils from 100 degC on")
        self.run_case("parts", SLABS + BORE, "--set", "time.end=25 s")
        self.write("parts.toml", SLABS + BORE)
        self.done("run", "parts.toml", "-o", "parts", "--restart", "--no-progress", env={"SOLIDUS_PROCESSES": "1"})
        self.assertEqual((self.folder / "parts/history.csv").read_text(), (self.folder / "straight/history.csv").read_text())
        self.run_case("two", SLABS + BORE, processes=2)
        for key in ("heat_to_channels[J]", "bore_wall[degC]"):
            self.assertAlmostEqual(self.rows("two")[-1][key] / last[key], 1, delta=1e-6)
        adaptive = SLABS.replace('step = "5 s"', 'step = "1 s"\nadaptive = true')
        self.run_case("adaptive", adaptive + BORE)
        end = self.rows("adaptive")[-1]
        self.assertAlmostEqual(end["heat_to_channels[J]"] / -end["stored_heat[J]"], 1, delta=1e-8)
        self.assertAlmostEqual(end["heat_to_channels[J]"] / last["heat_to_channels[J]"], 1, delta=0.02)

    def test_findings_and_refusals_have_their_place(self):
        for name, text, expected in (
                ("outside", BORE.replace("14 mm", "45 mm"), "lies outside of 'lower'"),
                ("body", BORE.replace('body = "lower"', 'body = "die"'), "the channel 'bore' is in no body 'die'"),
                ("two", BORE.replace("pressure", 'mass_flow = "0.1 kg/s"\npressure'), "has a flow and a mass_flow"),
                ("none", BORE.replace('inlet_temperature = "20 degC"\n', ""), "has no inlet_temperature"),
                ("after", BORE + 'after = "other"\n', "has a flow or an inlet temperature of its own"),
                ("z", BORE.replace('y = "14 mm"', 'y = "14 mm", z = "1 mm"'), "has a z"),
                ("path", BORE.replace('path = { x = "31 mm", y = "14 mm" }\n', ""), "has no path"),
                ("open", BORE + '[heat]\nintegration = "open"\n', "which the open rule has not"),
                ("fluid", BORE + 'fluid = "oil"\n', "given"),
                ("life", BORE + '[[die_life]]\nbody = "lower"\nlaw = "table"\ncycles = "7"\n', "no two ranges of strain")):
            with self.subTest(name):
                self.write(f"{name}.toml", SLABS + text)
                result = solidus("check", f"{name}.toml", cwd=self.folder)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(f"{name}.toml:", result.stderr)
                self.assertIn(expected, result.stderr)
        for name, text, expected in (
                ("edge", BORE.replace("14 mm", "2 mm"), "of the wall of the channel 'bore' lies outside of 'lower'"),
                ("laminar", BORE.replace('flow = {', '#').replace("inlet", 'flow = "0.2 l/min"\ninlet'), "laminar, Re = 5"),
                ("warm", BORE.replace('flow = {', '#').replace("inlet", 'flow = "0.2 l/min"\ninlet'), "changes its temperature by up to")):
            with self.subTest(name):
                self.write(f"{name}.toml", SLABS + text)
                result = solidus("check", f"{name}.toml", cwd=self.folder)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(expected, result.stdout + result.stderr)

    def test_a_die_tells_how_many_shots_it_bears(self):
        shots = SLABS.replace('"300 degC"\n[[contact]]', '"650 degC"\nstages = "fill"\n[[contact]]').replace(
            '[time]\nend = "60 s"\nstep = "5 s"\n', '[time]\nstep = "2 s"\n').replace(
            'name = "upper"\nmaterial = "steel_mould"', 'name = "upper"\nmaterial = "aluminium_alsi7mg"') + """
[[stage]]
name = "fill"
duration = "20 s"
[[stage]]
name = "spray"
duration = "10 s"
[[cycle]]
name = "shots"
stages = ["fill", "spray"]
repeat = 3
[[die_life]]
body = "lower"
law = "table"
cycles = { of = "strain", argument_unit = "1", unit = "1", points = [[0.001, 1e6], [0.01, 1e3]] }
source = "a table of this test"
"""
        said = self.run_case("shots", shots + BORE)
        self.assertIn("constants of a table of this test", said)
        summary = json.loads((self.folder / "shots/summary.json").read_text())
        found = summary["criteria"]
        strain, life = found["shot_strain_range_max"], found["shots_until_crack_min"]
        self.assertGreater(strain, 0.0005)
        self.assertAlmostEqual(life * (strain / 0.001) ** 3 / 1e6, 1, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
