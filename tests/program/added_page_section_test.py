"""A section of the report in one file of the tests, which no source, Python or page names, is in every report."""

import base64
import csv
import json
import os
import re
import subprocess
import tempfile
import unittest
import zlib

import program
from program import ProgramTest, SOURCES

from solidus_plots.chromium import find_browser

NAME, TITLE = "thermometers", "Thermometers"
CASE = """
title = "A plate that cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
divisions = [4, 2]
[time]
end = "20 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "300 degC"
[[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "20 degC"
"""
PROBE = """
[[probe]]
name = "inside"
kind = "point"
point = ["2 mm", "5 mm"]
field = "temperature"
unit = "degC"
"""


class AddedPageSection(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.own, program.PROGRAM = program.PROGRAM, os.environ["SOLIDUS_WITH_ADDED_PARTS"]

    @classmethod
    def tearDownClass(cls):
        program.PROGRAM = cls.own

    def page(self, case):
        self.write("case.toml", case)
        self.done("run", ".", "-o", "out", "--no-progress", "--report")
        return self.folder / "out/report.html"

    def sections(self, page):
        packed = re.search(r'id="meta">([^<]*)<', page.read_text(encoding="utf-8"))[1]
        run, = json.loads(zlib.decompress(base64.b64decode(packed), -15))["runs"]
        return run["sections"]

    def test_no_file_of_the_program_names_it(self):
        for part in ("src", "python", "web/report/src"):
            for file in (SOURCES / part).rglob("*.*"):
                if file.suffix in (".cpp", ".hpp", ".py", ".ts", ".json"):
                    self.assertNotIn(TITLE, file.read_text(encoding="utf-8"), file)

    def test_a_report_has_its_numbers(self):
        page = self.page(CASE + PROBE)
        section, = self.sections(page)
        self.assertEqual((section["id"], section["title"]), (NAME, TITLE))
        with (self.folder / "out/history.csv").open() as file:
            rows = [(float(row["time[s]"]), float(row["inside[degC]"])) for row in csv.DictReader(file)]
        falls = [(b - a) / (t - s) for (s, a), (t, b) in zip(rows, rows[1:])]
        said, table, curves = section["blocks"]
        name, highest, last, steepest = table["table"]["rows"][0]
        self.assertEqual((name, highest, last), ("inside", 300.0, rows[-1][1]))
        self.assertAlmostEqual(steepest, -min(falls), places=9)
        line, = curves["chart"]["lines"]
        for given, fall in zip(line["values"][1:], falls):
            self.assertAlmostEqual(given, fall, places=9)

    def test_a_run_without_such_probes_has_no_such_section(self):
        self.assertEqual(self.sections(self.page(CASE)), [])

    def test_a_browser_shows_it_in_its_place(self):
        browser = find_browser()
        if browser is None:
            self.skipTest("no browser is installed")
        page = self.page(CASE + PROBE)
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            command = [browser, "--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", f"--user-data-dir={profile}",
                       "--virtual-time-budget=20000", "--dump-dom", page.resolve().as_uri()]
            if os.geteuid() == 0:
                command.insert(1, "--no-sandbox")
            shown = subprocess.run(command, capture_output=True, text=True, timeout=program.PATIENCE * 240, stdin=subprocess.DEVNULL).stdout
        found = re.findall(r'<section id="(\w+)"><h2>([^<]*)</h2>', shown)
        self.assertIn((NAME, TITLE), found)
        names = [name for name, _ in found]
        self.assertLess(names.index("curves"), names.index(NAME))
        self.assertLess(names.index(NAME), names.index("energy"))
        self.assertIn("Steepest fall [K/s]", shown)
        self.assertIn("Rates are those between two steps.", shown)


if __name__ == "__main__":
    unittest.main()
