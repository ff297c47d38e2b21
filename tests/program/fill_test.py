"""`solidus fill` and `solidus run` with [filling]: a cavity of some hundred cubes is filled by OpenFOAM and freezes then."""

import json
import os
import re
import shutil
import subprocess
import time
import tomllib
import unittest

from pages import blocks
from program import PROGRAM, SOURCES, ProgramTest, solidus

FOUND = shutil.which("icoReactingMultiphaseInterFoam")
MISSING = "OpenFOAM is not installed (Debian's openfoam)"

BAR = """
title = "A bar of steel on a die"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "hex8"
[mesh.two_blocks]
lower = ["120 mm", "12 mm", "10 mm"]
lower_divisions = [20, 2, 3]
upper = ["120 mm", "12 mm", "12 mm"]
upper_divisions = [20, 2, 2]
[time]
end = "10 s"
step = "0.5 s"
[[body]]
name = "casting"
group = "upper"
role = "casting"
material = "low_carbon_steel"
initial_temperature = "1560 degC"
[[body]]
name = "sand"
group = "lower"
role = "die"
material = "h13_tool_steel"
initial_temperature = "100 degC"
[[interface]]
bodies = "all"
[filling]
gate_at = ["0 mm", "6 mm", "16 mm"]
time = "6 s"
cells = 300
"""


class FillTest(ProgramTest):
    def setUp(self):
        super().setUp()
        page = (SOURCES / "docs/guide/filling.md").read_text()
        text = next(block.text for block in blocks(page) if block.text.startswith('title = "A plate on a die"'))
        (self.folder / "case.toml").write_text(text)

    def refusal(self, *arguments, **environment):
        result = subprocess.run([str(PROGRAM), "fill", "case.toml", "-o", "filled", *arguments], cwd=self.folder, capture_output=True,
                                text=True, stdin=subprocess.DEVNULL, env={**os.environ, **environment})
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        return result.stderr

    @unittest.skipUnless(FOUND, MISSING)
    def test_a_mould_is_filled_and_freezing_starts_from_it(self):
        text = self.done("fill", "case.toml", "-o", "filled", "--processes", "1", timeout=600)
        filled = self.folder / "filled"
        summary = json.loads((filled / "filling.json").read_text())
        self.assertIn("filled after", text)
        self.assertEqual((filled / "filling.gif").read_bytes()[:4], b"GIF8")
        self.assertGreater(summary["full"], 0.98)
        # Volume and heat: what came against what is there, what the metal has lost against what walls have taken.
        balance = summary["balance"]
        self.assertAlmostEqual(balance["there"] / balance["came"], 1, delta=1e-6)
        self.assertLess(balance["corrected"], 0.01)
        self.assertAlmostEqual(balance["lost"] / balance["brought"], balance["walls"] / balance["brought"], delta=2e-3)
        for line in (filled / "filling.csv").read_text().splitlines()[2:]:
            time, full = map(float, line.split(",")[:2])
            self.assertAlmostEqual(full / 100, time / 0.5, delta=2e-3)
        # The same again is not computed again, and the run starts with the heat of the filling.
        self.assertIn("is filled already", self.done("fill", "case.toml", "-o", "filled", timeout=100))
        run = solidus("run", "case.toml", "--set", "filling.result='filled'", "-o", "run", "--processes", "1", cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        taken = sum(float(row.split(",")[4]) for row in (filled / "mould_heat.csv").read_text().splitlines()[1:])
        self.assertAlmostEqual(taken, balance["lost"], delta=1e-9 * abs(taken))
        self.assertIn("from the metal while the mould filled", run.stderr)
        hottest = float(re.search(r"while the mould filled; it is \S+ to (\S+) degC hot", run.stderr).group(1))
        self.assertLess(hottest, 700)

    @unittest.skipUnless(FOUND, MISSING)
    def test_metal_that_freezes_on_its_way_keeps_its_heat(self):
        """A thin bar of steel on a cold die: without the heat that is given back, the solver loses 19 % of what came, and metal arrives with
        158 degC where the die has hardly cooled it."""
        self.write("case.toml", BAR)
        self.done("fill", "case.toml", "-o", "filled", "--processes", "1", timeout=600)
        summary = json.loads((self.folder / "filled/filling.json").read_text())
        balance = summary["balance"]
        self.assertAlmostEqual(balance["lost"] / balance["brought"], balance["walls"] / balance["brought"], delta=0.03)
        self.assertLess(balance["returned"], 0.01 * balance["brought"])
        coldest = float(re.search(r"coldest arrival (\S+) degC", "\n".join(summary["answers"])).group(1))
        self.assertGreater(coldest, 1200)

    @unittest.skipUnless(FOUND, MISSING)
    def test_the_end_of_a_batch_job_stops_the_flow_which_goes_on_later(self):
        command = [str(PROGRAM), "run", "case.toml", "-o", "run", "--processes", "1"]
        run = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
        state = self.folder / "run/filling/state.npz"
        while not state.exists() and run.poll() is None:
            time.sleep(0.05)
        run.terminate()
        _, said = run.communicate(timeout=100)
        self.assertEqual(run.returncode, 130, said)
        self.assertIn("--restart goes on", said)
        before = state.stat().st_mtime_ns
        # The solver has ended too: nothing is written any more.
        time.sleep(1)
        self.assertEqual(state.stat().st_mtime_ns, before)
        self.assertFalse((self.folder / "run/filling/filling.json").exists())

    def test_bad_input_is_refused_in_one_sentence(self):
        self.assertIn("the gate is given twice", self.refusal("--set", "filling.gate='upper_x_min'"))
        self.assertIn("more than once how fast", self.refusal("--set", "filling.rate='1 kg/s'"))
        self.assertIn("no group of faces 'nowhere'", self.refusal("--set", "filling.gate_at=[]", "--set", "filling.gate='nowhere'"))
        case = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text(case[:case.index("[filling]")])
        self.assertIn("does not say how the mould is filled", self.refusal())

    def test_what_drives_the_metal_is_said_once_and_over_rising_times(self):
        case = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text("".join(line for line in case.splitlines(True) if not line.startswith("time = ")))
        for words, *changes in (("more than once how fast", "head='0.1 m'", "rate='1 kg/s'"), ("direction of its axis", "times=['0 s']", "tilt=['0 degree']"),
                                ("'pressure' has 1 values", "times=['0 s','1 s']", "pressure=['1 kPa']"), ("begin with 0 s", "times=['1 s','2 s']"),
                                ("do not rise", "times=['0 s','0 s']"), ("zero at all times", "times=['0 s']", "speed=['0 m/s']"),
                                ("nothing is given", "times=['0 s']")):
            with self.subTest(words):
                self.assertIn(words, self.refusal(*(word for change in changes for word in ("--set", f"filling.{change}"))))

    def test_a_new_case_gets_a_gate(self):
        part = SOURCES / "tests/parts/dumbbell.step"
        self.done("new", str(part), "--alloy", "aluminium_alsi7mg", "--fineness", "0.3", "--gate", "-40, 0, 5 mm", "-o", "new", timeout=300)
        filling = tomllib.loads((self.folder / "new/case.toml").read_text())["filling"]
        self.assertEqual(filling["gate_at"], ["-40 mm", "0 mm", "5 mm"])
        for words, refused in ((("--gate", "1, 2 mm"), "is no place"), (("--fill", "--process", "high_pressure"), "the speed of a shot")):
            result = solidus("new", str(part), "--alloy", "aluminium_alsi9cu3", *words, "-o", "other", cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(refused, result.stderr)

    def test_without_openfoam_the_package_is_named(self):
        self.assertIn("openfoam, version 1912", self.refusal(PATH=str(self.folder)))


if __name__ == "__main__":
    unittest.main()
