"""Radiation between surfaces through the whole program: the first law, restart, processes, what `check` says and what is refused."""

import csv
import math
import unittest

from program import ProgramTest, solidus

# Two slabs of steel face to face across 10 mm, insulated but for the faces that see each other and, past each other, a room.
SLABS = """
title = "Two slabs that see each other"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "10 mm"]
lower_divisions = [12, 3]
upper = ["60 mm", "10 mm"]
upper_divisions = [15, 3]
gap = "10 mm"
[time]
end = "5 min"
adaptive = true
step = "5 s"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "900 degC"
[[body]]
name = "upper"
material = "steel_mould"
initial_temperature = "200 degC"
[[probe]]
name = "lower"
kind = "mean"
field = "temperature"
group = "lower"
unit = "degC"
[[probe]]
name = "upper"
kind = "mean"
field = "temperature"
group = "upper"
unit = "degC"
[output]
checkpoint_every = 1
"""


def radiation(name, group, keys='radiation = "enclosure"'):
    return f'[[thermal_condition]]\nname = "{name}"\ngroup = "{group}"\nkind = "radiation"\nemissivity = 0.8\nambient = "20 degC"\n{keys}\n'


BOTH = radiation("below", "lower_top") + radiation("above", "upper_bottom")


class EnclosureTest(ProgramTest):
    def rows(self, folder):
        with open(self.folder / folder / "history.csv", encoding="utf-8") as table:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]

    def run_case(self, name, text, *arguments):
        self.write(f"{name}.toml", text)
        return self.done("run", f"{name}.toml", "-o", name, "--no-progress", *arguments, env={"SOLIDUS_PROCESSES": "1"})

    def test_slabs_keep_the_first_law_and_go_on_after_a_stop_with_the_same_digits(self):
        self.run_case("whole", SLABS + BOTH)
        rows = self.rows("whole")
        last = rows[-1]
        self.assertLess(abs(last["energy_defect[J]"]), 1e-10 * last["heat_exchanged[J]"])
        # The upper slab is warmed by the lower one alone; both lose heat to the room through the ends.
        self.assertGreater(last["upper[degC]"], 350)
        self.assertLess(last["lower[degC]"] + last["upper[degC]"], 1100)
        # Fixed steps, since adaptive ones would end elsewhere where the run is cut.
        fixed = SLABS.replace("adaptive = true\n", "") + BOTH
        self.run_case("straight", fixed)
        self.run_case("parts", fixed, "--set", "time.end=2 min")
        self.write("parts.toml", fixed)
        self.done("run", "parts.toml", "-o", "parts", "--restart", "--no-progress", env={"SOLIDUS_PROCESSES": "1"})
        self.assertEqual((self.folder / "parts/history.csv").read_text(), (self.folder / "straight/history.csv").read_text())

    def test_two_processes_find_the_temperatures_of_one(self):
        self.run_case("one", SLABS + BOTH)
        self.write("two.toml", SLABS + BOTH)
        self.done("run", "two.toml", "-o", "two", "--no-progress", env={"SOLIDUS_PROCESSES": "2"})
        for key in ("lower[degC]", "upper[degC]"):
            self.assertAlmostEqual(self.rows("one")[-1][key], self.rows("two")[-1][key], delta=1e-3)

    def test_check_names_a_skin_that_sees_itself(self):
        ambient = radiation("below", "lower_top", "") + radiation("above", "upper_bottom", "")
        self.write("ambient.toml", SLABS + ambient)
        # In a plane faces of 60 mm across 10 mm see sqrt(1 + 1/36) − 1/6 of each other.
        share = round(100 * (math.sqrt(1 + 1 / 36) - 1 / 6))
        said = solidus("check", "ambient.toml", cwd=self.folder)
        self.assertRegex(said.stdout + said.stderr, f"({share - 1}|{share}|{share + 1}) % of what the surfaces of 'below', 'above' see is these")
        for name, text in {"enclosed": SLABS + BOTH, "apart": SLABS.replace('gap = "10 mm"', 'gap = "1 m"') + ambient}.items():
            self.write(f"{name}.toml", text)
            said = solidus("check", f"{name}.toml", cwd=self.folder)
            self.assertNotIn("see is these surfaces", said.stdout + said.stderr)

    def test_what_cannot_be_is_refused_with_its_place(self):
        one = radiation("below", "lower_top")
        for name, text, expected in (
                ("place", one.replace("0.8", '{ formula = "0.5 + x" }'), "'emissivity' of 'below' is a function of place"),
                ("twice", one + radiation("again", "lower_top"), "the surface 'lower_top' is in the enclosure twice"),
                ("open", one + '[heat]\nintegration = "open"\n', "'below' is in an enclosure, which the open rule has not"),
                ("word", one.replace('"enclosure"', '"enclosed"'), "enclosure"),
                ("film", one.replace('kind = "radiation"\nemissivity = 0.8', 'kind = "film"\ncoefficient = "20 W/m2/K"'), "radiation")):
            with self.subTest(name):
                self.write(f"{name}.toml", SLABS + text)
                result = solidus("check", f"{name}.toml", cwd=self.folder)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(f"{name}.toml:", result.stderr)
                self.assertIn(expected, result.stderr)


if __name__ == "__main__":
    unittest.main()
