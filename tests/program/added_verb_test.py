"""A verb in one file of the tests, which no source, Python or page names, is wherever verbs are."""

import os
import subprocess
import unittest

from program import ProgramTest

CASE = """
title = "A steel block of 100 x 50 x 20 mm"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["100 mm", "50 mm", "20 mm"]
divisions = [2, 1, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "{material}"
initial_temperature = "20 degC"
"""
MATERIAL = """
title = "Steel"
[density]
value = "7800 kg/m3"
source = "test"
[conductivity]
value = "30 W/m/K"
source = "test"
[specific_heat]
value = "500 J/kg/K"
source = "test"
"""


class AddedVerb(ProgramTest):
    def solidus(self, *arguments):
        return subprocess.run([os.environ["SOLIDUS_WITH_ADDED_PARTS"], *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_runs_with_its_options(self):
        self.write("steel.toml", MATERIAL)
        self.write("case.toml", CASE.format(material="steel.toml"))
        self.assertEqual(self.solidus("weigh", "case.toml").stdout.splitlines()[-1], "block 0.78 kg")
        self.assertEqual(self.solidus("weigh", "case.toml", "--unit", "g").stdout.splitlines()[-1], "block 780 g")
        heavier = self.solidus("weigh", "case.toml", "--set", 'mesh.block.size=["100 mm", "50 mm", "40 mm"]')
        self.assertEqual(heavier.stdout.splitlines()[-1], "block 1.56 kg")

    def test_is_in_the_help_the_completion_and_the_manual(self):
        for words in (("--help",), ("man",), ("completion", "bash"), ("completion", "fish")):
            self.assertIn("weigh", self.solidus(*words).stdout, words)
        self.assertIn("g or kg; default kg", self.solidus("help", "weigh").stdout)

    def test_refuses_as_all_verbs_do(self):
        wrong = self.solidus("weigh", "case.toml", "--unit", "stone")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("`solidus help weigh` shows its options", wrong.stderr)
        self.assertIn("did you mean 'weigh'?", self.solidus("weihg", "case.toml").stderr)
        missing = self.solidus("weigh", "nowhere.toml")
        self.assertEqual(missing.returncode, 1)
        self.assertIn("nowhere.toml", missing.stderr)


if __name__ == "__main__":
    unittest.main()
