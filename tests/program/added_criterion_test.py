"""A criterion of hot tearing after Rappaz, Drezet and Gremaud with its key of material cards, in one file of the tests that no source,
Python or page names, is wherever criteria and keys are."""

import base64
import csv
import json
import os
from pathlib import Path
import re
import unittest
import zlib

import program
from program import ProgramTest, solidus
from solidus_casting import Results
from solidus_plots import fields
from solidus_plots.vtu import read_collection, read_fields

NAME, LABEL = "feedable_strain_rate", "Strain rate that melt feeds"
KEY = "bridged_fraction"
CASE = """
title = "A plate of a freezing alloy on a chill"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "40 mm"]
lower_divisions = [4, 3]
upper = ["40 mm", "15 mm"]
upper_divisions = [6, 4]
[time]
end = "100 s"
step = "2 s"
[output]
every = "20 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "640 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "100 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "constant"
[[probe]]
name = "least"
kind = "minimum"
unit = "1/s"
field = "feedable_strain_rate"
group = "upper"
[[probe]]
name = "in the chill"
kind = "mean"
unit = "1/s"
field = "feedable_strain_rate"
group = "lower"
"""


class AddedCriterion(ProgramTest):
    """Probes, `check`, field files, summary, terminal, report with label and unit, pictures and `compare` have it."""

    @classmethod
    def setUpClass(cls):
        cls.own, program.PROGRAM = program.PROGRAM, os.environ["SOLIDUS_WITH_ADDED_PARTS"]

    @classmethod
    def tearDownClass(cls):
        program.PROGRAM = cls.own

    def setUp(self):
        super().setUp()
        self.write("case.toml", CASE)

    def run_to(self, folder, *arguments):
        text = self.done("run", ".", "-o", folder, "--no-progress", *arguments)
        return text, self.summary(self.folder / folder)

    def test_no_file_of_the_program_names_it(self):
        for part in ("src", "python", "web/report/src"):
            for file in (program.SOURCES / part).rglob("*.*"):
                if file.is_file() and file.suffix in (".cpp", ".hpp", ".py", ".ts", ".json"):
                    text = file.read_text(encoding="utf-8")
                    self.assertNotIn(NAME, text, file)
                    self.assertNotIn(KEY, text, file)

    def test_check_and_explain_know_it(self):
        self.assertIn(f"called {LABEL}, shown in 1/s", self.done("explain", "--fields", NAME))
        checked = solidus("check", ".", cwd=self.folder)
        self.assertEqual(checked.returncode, 0)
        self.assertIn(f"the probe 'in the chill' takes the {NAME} of 'lower', of 'steel_mould', which does not freeze",
                      checked.stderr)

    def of_card(self, value, folder="out"):
        """The least value where the card gives the key, or leaves it out."""
        given = f"{KEY} = {value}\n" if value else ""
        self.write("own.toml", f'like = "aluminium_alsi7mg"\n{given}')
        self.write("case.toml", CASE.replace('"aluminium_alsi7mg"', '"own.toml"'))
        return self.run_to(folder)[1]["criteria"][f"{NAME}_min[1/s]"]

    def test_a_card_gives_the_key_that_the_criterion_declares(self):
        left_out = self.of_card("")
        self.assertEqual(self.of_card('{ value = "0.98", source = "as it is left out" }'), left_out)
        self.assertGreater(self.of_card("0.4"), left_out)  # the eutectic, from 0.49 on, has no range
        self.assertIn("grains bridge", self.done("explain", "--material", KEY))

    def test_the_key_is_checked_as_any_other(self):
        self.of_card("0.9")
        for value in ("2", '"0.9 m"', '"soon"'):
            self.write("own.toml", f'like = "aluminium_alsi7mg"\n{KEY} = {value}\n')
            refused = solidus("check", ".", cwd=self.folder)
            self.assertEqual(refused.returncode, 1)
            self.assertRegex(refused.stderr, f"own.toml:2.*{KEY}")
        self.write("own.toml", f'like = "aluminium_alsi7mg"\n{KEY[:-1]} = 0.9\n')
        self.assertIn(f"'{KEY}'", solidus("check", ".", cwd=self.folder).stderr)

    def test_a_restart_with_another_value_is_noticed(self):
        self.of_card("0.9")
        self.write("own.toml", f'like = "aluminium_alsi7mg"\n{KEY} = 0.95\n')
        again = solidus("run", ".", "-o", "out", "--restart", "--no-progress", cwd=self.folder)
        self.assertEqual(again.returncode, 1)
        self.assertIn("material data", again.stderr)

    def test_probes_tables_fields_summary_and_terminal_have_it(self):
        text, summary = self.run_to("out")
        least = summary["criteria"][f"{NAME}_min[1/s]"]
        self.assertGreater(least, 0.0)
        self.assertEqual(len(summary["criteria"][f"{NAME}_min_at[m]"]), 3)
        self.assertEqual(summary["fields"][NAME]["label"], LABEL)
        self.assertEqual(Results(self.folder / "out").fields[NAME]["no_value"], -1)
        self.assertRegex(text, r"least strain rate that melt feeds +[\d.e-]+ 1/s at \(")
        with (self.folder / "out/history.csv").open() as file:
            self.assertIn("least[1/s]", next(csv.reader(file)))
            *_, last = csv.DictReader(file, ["time[s]", "least[1/s]", "in the chill[1/s]"])
        self.assertEqual(float(last["least[1/s]"]), least)
        grid = read_fields(read_collection(self.folder / "out/fields.pvd")[1][-1])
        self.assertEqual(grid.units[NAME], "1/s")
        values = grid.point_data[NAME]
        self.assertEqual(values[values >= 0].min(), least)

    def test_the_report_shows_it_with_its_label_and_unit(self):
        self.run_to("out", "--report")
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        packed = re.search(r'id="meta">([^<]*)<', page)[1]
        run, = json.loads(zlib.decompress(base64.b64decode(packed), -15))["runs"]
        row, = (row for row in run["quantities"] if row["name"] == NAME)
        self.assertEqual((row["label"], row["shown"]["text"], row["group"]), (LABEL, "1/s", "criteria"))
        column, = (column for column in run["fields"] if column["name"] == NAME)
        self.assertTrue(column["at_end"])

    def test_pictures_and_comparisons_have_it(self):
        self.run_to("one")
        self.run_to("other", "--set", 'contact.interface.heat.conductance="1000 W/m2/K"')
        self.done("plot", "one", timeout=300)
        self.assertTrue((self.folder / f"one/plots/overview_{NAME}.png").exists())
        summary = self.summary(self.folder / "one")
        self.assertIsNone(fields.find(NAME))  # Python knows it by the summary of the run alone
        fields.declare(summary)
        self.assertEqual((fields.label(NAME), fields.find(NAME).shown, fields.find(NAME).no_value), (LABEL, "1/s", -1))
        text = self.done("compare", "one", "other", "--output", "difference", timeout=300)
        self.assertRegex(text, r"least strain rate that melt feeds\[1/s\] +\S+ +\S+")
        with (self.folder / "difference/answers.csv").open() as file:
            told = {row["answer"]: float(row["A"]) for row in csv.DictReader(file) if row["A"]}
        self.assertEqual(told["least strain rate that melt feeds[1/s]"], summary["criteria"][f"{NAME}_min[1/s]"])
        with (self.folder / "difference/fields.csv").open() as file:
            units = {row["field"]: row["unit"] for row in csv.DictReader(file)}
        self.assertEqual(units[NAME], "1/s")
        self.assertTrue((self.folder / f"difference/difference_{NAME}.png").exists())


if __name__ == "__main__":
    unittest.main()
