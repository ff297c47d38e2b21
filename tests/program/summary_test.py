"""The end of a run, in the words of a foundry engineer."""

import csv
import unittest

from program import SOURCES, ProgramTest, solidus

# A plate with a riser on it, a chill of the same metal next to it; the plate cools at its lower edge. The bodies share
# their nodes.
GEOMETRY = """
Point(1) = {0, 0, 0, 5}; Point(2) = {40, 0, 0, 5}; Point(3) = {40, 20, 0, 5}; Point(4) = {0, 20, 0, 5};
Point(5) = {0, 60, 0, 5}; Point(6) = {40, 60, 0, 5}; Point(7) = {60, 0, 0, 5}; Point(8) = {60, 20, 0, 5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {3, 6}; Line(6) = {6, 5}; Line(7) = {5, 4}; Line(8) = {2, 7}; Line(9) = {7, 8}; Line(10) = {8, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Curve Loop(3) = {8, 9, 10, -2}; Plane Surface(3) = {3};
Physical Surface("plate") = {1}; Physical Surface("top") = {2}; Physical Surface("chill") = {3};
Physical Curve("below") = {1}; Physical Curve("sides") = {4, 5, 7, 9};
"""
CASE = """
title = "Plate, riser and chill"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "plate.geo"
unit = "mm"
[time]
end = "{end} s"
step = "5 s"
[criteria]
feeders = ["{feeders}"]
[[body]]
name = "plate"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "riser"
group = "top"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "chill"
material = "aluminium_alsi7mg"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "below"
group = "below"
kind = "film"
coefficient = "1500 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "sides"
group = "sides"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "20 degC"
"""


class Decks(ProgramTest):
    def test_hold_no_number_of_which_calculix_reads_a_part(self):
        """It reads twenty characters of each (findings/calculix_reads_twenty_characters_of_a_number.sh)."""
        self.done("run", str(SOURCES / "cases/two_blocks"), "-o", "out", "--no-progress", "--set", "time.step=2 s", "--set", "time.end=4 s")
        for arguments in ((), ("--temperature-history",)):
            self.done("export", "out", "--calculix", "part.inp", *arguments)
            numbers, keyword = [], ""
            for line in (self.folder / "part.inp").read_text().splitlines():
                if line.startswith("*"):
                    keyword = line
                elif keyword != "*HEADING":
                    numbers += line.split(",")
            self.assertGreater(len(numbers), 1000)
            self.assertLessEqual(max(len(number.strip()) for number in numbers), 20)


class Summary(ProgramTest):
    def run_case(self, end, feeders="top", *arguments):
        self.write("plate.geo", GEOMETRY)
        self.write("case.toml", CASE.format(end=end, feeders=feeders))
        text = self.done("run", ".", "-o", "out", "--no-progress", *arguments)
        return text[text.index("finished after"):], self.summary(self.folder / "out")["answers"]

    def test_a_run_that_ends_before_all_is_solid_says_how_much_is_and_where_the_melt_is(self):
        text, answers = self.run_case(60)
        riser = answers["castings"]["riser"]
        self.assertLess(riser["solid_fraction"], 0.9)
        self.assertNotIn("last_melt_froze", riser)
        self.assertIn(f"{100 * riser['solid_fraction']:.1f} % solid 60 s after pouring; the melt is hottest", text)
        self.assertGreater(riser["hottest_melt"]["at[m]"][1], 0.02)  # in the riser, away from what cools
        self.assertNotIn("freezes last", text)

    def test_all_fields_are_gathered_in_one_file_where_the_case_asks_for_it(self):
        hdf5 = b"\x89HDF\r\n"
        self.run_case(20, "top", "--set", "output.vtkhdf=true", "--set", "output.every=10 s")
        gathered = (self.folder / "out/fields.vtkhdf").read_bytes()
        self.assertTrue(gathered.startswith(hdf5))
        said = self.done("export", "out", "--vtkhdf", "later.vtkhdf")
        self.assertIn(" fields at 3 times, ", said)
        self.assertEqual((self.folder / "later.vtkhdf").read_bytes(), gathered)
        result = solidus("export", "out", "--med", "later.med", cwd=self.folder)
        if "without the MED library" in result.stderr:
            self.assertEqual(result.returncode, 1)
        else:
            self.assertEqual(result.stdout.split(":")[1], said.split(":")[1])
            self.assertTrue((self.folder / "later.med").read_bytes().startswith(hdf5))
        both = solidus("export", "out", "--med", "a.med", "--vtkhdf", "b.vtkhdf", cwd=self.folder)
        self.assertEqual((both.returncode, (self.folder / "b.vtkhdf").exists()), (1, False))
        self.run_case(20)  # a new run takes the old file away
        self.assertFalse((self.folder / "out/fields.vtkhdf").exists())

    def test_a_chill_of_the_same_metal_is_no_casting(self):
        text, answers = self.run_case(20)
        self.assertEqual(set(answers["castings"]), {"plate", "riser"})
        self.assertNotIn("chill", text)
        # Nor is it in the solid fraction of the run, which begins with melt.
        with (self.folder / "out/history.csv").open(newline="") as file:
            solid = [float(row["solid_fraction[1]"]) for row in csv.DictReader(file)]
        self.assertLess(solid[0], 0.03)  # nodes that plate and chill share start between both; with the chill: 0.27
        plate, riser = (answers["castings"][name]["solid_fraction"] for name in ("plate", "riser"))
        self.assertAlmostEqual(solid[-1], (20 * plate + 40 * riser) / 60, places=9)  # by their heights

    def test_a_riser_that_outlives_the_part_is_told_from_one_that_does_not(self):
        text, answers = self.run_case(400)
        froze = {name: body["last_melt_froze"]["value[s]"] for name, body in answers["castings"].items()}
        self.assertIn(f"riser 'riser'                       outlived the part by {froze['riser'] - froze['plate']:.4g} ± ",
                      text)
        self.assertIn("yield                               33.3 % of what is poured is part", text)  # 40 of 60 mm are riser
        self.assertAlmostEqual(answers["yield"], 1 / 3, places=9)
        self.assertAlmostEqual(answers["castings"]["riser"]["mass[kg]"], 2 * answers["castings"]["plate"]["mass[kg]"], places=9)
        self.assertTrue(answers["castings"]["riser"]["riser"])
        text, answers = self.run_case(400, "plate")  # what the plate would feed is frozen later
        self.assertRegex(text, rf"froze {froze['riser'] - froze['plate']:.4g} ± \d+ s before the part: it could not feed to the end")

    def test_a_run_until_all_is_solid_ends_when_it_is_and_goes_on_only_where_asked(self):
        until = ("--set", 'time.until="solid"')
        text, answers = self.run_case(4000, "top", *until)
        last = max(body["last_melt_froze"]["value[s]"] for body in answers["castings"].values())
        ended = answers["time[s]"]
        self.assertTrue(last <= ended < last + 5, (last, ended))  # a step of five seconds
        self.assertEqual({body["solid_fraction"] for body in answers["castings"].values()}, {1})
        collection = (self.folder / "out/fields.pvd").read_text()
        self.assertIn(f'timestep="{ended:g}"', collection)
        again = solidus("run", ".", "-o", "out", "--no-progress", "--restart", *until, cwd=self.folder)
        self.assertEqual(again.returncode, 1)
        self.assertIn("all that was poured is solid", again.stderr)
        self.done("run", ".", "-o", "out", "--no-progress", "--restart", "--set", f'time.end="{ended + 10} s"')
        self.assertEqual(self.summary(self.folder / "out")["answers"]["time[s]"], ended + 10)

    def test_a_run_until_all_is_solid_needs_something_that_is_poured(self):
        self.write("plate.geo", GEOMETRY)
        self.write("case.toml", CASE.format(end=10, feeders="top").replace("700 degC", "20 degC"))
        result = solidus("check", ".", "--set", 'time.until="solid"', "--set", "criteria.feeders=[]", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("the run lasts until all is solid, but nothing is poured", result.stderr)
        result = solidus("check", ".", "--set", 'time.until="solid"', "--set", "time.steady=true", cwd=self.folder)
        self.assertIn("means nothing in a steady analysis", result.stderr)

    def test_places_and_temperatures_are_printed_in_the_units_of_the_user(self):
        units = ("--set", 'output.length_unit="inch"', "--set", 'output.temperature_unit="degF"')
        text, answers = self.run_case(60, "top", *units)
        riser = answers["castings"]["riser"]["hottest_melt"]
        fahrenheit = 1.8 * (riser["value[K]"] - 273.15) + 32
        x, y, _ = (metres / 0.0254 for metres in riser["at[m]"])
        self.assertIn(f"the melt is hottest, {fahrenheit:.4g} degF, at ({x:.4g}, {y:.4g}, 0) inch", text)
        result = solidus("check", ".", "--set", 'output.length_unit="degC"', cwd=self.folder)
        self.assertIn("'degC' is no unit for length_unit", result.stderr)

    def test_the_profile_of_the_solver_is_printed_where_it_is_asked_for(self):
        text, _ = self.run_case(10)
        self.assertNotIn("start of the program", text)
        text, _ = self.run_case(10, "top", "--profile")
        self.assertIn("start of the program", text)
        self.assertIn("start of the program", self.summary(self.folder / "out")["profile[s]"])


if __name__ == "__main__":
    unittest.main()
