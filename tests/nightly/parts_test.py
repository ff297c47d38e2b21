"""`solidus new` on every part of tests/parts, the bracket and the plate: cases that answer without editing, by heat alone in less than a
minute of processor time and coupled in less than ten."""

import json
import os
from pathlib import Path
import resource
import shutil
import subprocess
import unittest

ROOT = Path(__file__).resolve().parents[2]
MOST = {"--heat-only": 60, "--coupled": 600}  # seconds of one core
# File, alloy, process, and what `new` is told besides.
PARTS = [
    ("cases/bracket_from_step/bracket.step", "aluminium_alsi7mg", "sand"),
    ("cases/stepped_plate/plate.step", "aluminium_alsi7mg", "sand"),
    ("tests/parts/bearing_block.step", "tin_bronze", "sand"),
    ("tests/parts/cup_with_pin.step", "aluminium_alsi9cu3", "high_pressure"),
    ("tests/parts/dumbbell.step", "tin_bronze", "shell"),
    ("tests/parts/elbow.step", "low_carbon_steel", "shell"),
    ("tests/parts/fan.step", "aluminium_alsi9cu3", "high_pressure"),
    ("tests/parts/flange.step", "nodular_iron", "sand"),
    ("tests/parts/gear_case.step", "aluminium_alsi9cu3", "high_pressure"),
    ("tests/parts/handwheel.step", "grey_iron", "sand"),
    ("tests/parts/hook.step", "low_carbon_steel", "sand"),
    ("tests/parts/impeller.step", "tin_bronze", "sand", "--riser", "auto"),
    ("tests/parts/manifold.step", "grey_iron", "sand", "--as", "body_1=core"),
    ("tests/parts/pillow_block.step", "nodular_iron", "sand"),
    ("tests/parts/pump_housing.step", "grey_iron", "sand", "--as", "body_1=core"),
    ("tests/parts/ribbed_box.step", "aluminium_alsi9cu3", "high_pressure"),
    ("tests/parts/ribbed_cover.step", "aluminium_alsi9cu3", "high_pressure"),
    ("tests/parts/stepped_plate.step", "aluminium_alsi7mg", "sand", "--riser", "auto"),
    ("tests/parts/tee_flange.step", "aluminium_alsi7mg", "sand", "--symmetry", "y", "--riser", "auto"),
    ("tests/parts/valve.step", "brass", "gravity_die"),
]


class Parts(unittest.TestCase):
    def run_program(self, folder, *arguments):
        """Runs the program, which must end well.

        @returns seconds of processor time
        """
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], *arguments], cwd=folder, capture_output=True, text=True,
                              timeout=3600, check=False)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stdout[-2000:]}{done.stderr}")
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def check_estimates(self, summary):
        """The estimates of the times to freeze are known to a factor of two (docs/guide/findings.md)."""
        for pour in summary["understood"]["poured"]:
            frozen = summary["answers"]["castings"].get(pour["body"], {}).get("last_melt_froze")
            if frozen:
                ratio = pour["freezing_time[s]"] / frozen["value[s]"]
                print(f"  {pour['body']}: estimate {pour['freezing_time[s]']:.3g} s, {ratio:.2f} of the run", flush=True)
                self.assertGreater(ratio, 0.5, pour["body"])
                self.assertLess(ratio, 2, pour["body"])

    def test_every_part_answers_without_editing(self):
        for part, alloy, process, *more in PARTS:
            with self.subTest(part=Path(part).stem):
                folder = Path(os.environ["SOLIDUS_FOLDER"]) / "parts" / Path(part).stem
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir(parents=True)
                self.run_program(folder, "new", str(ROOT / part), "--alloy", alloy, "--process", process, *more, "-o", "case")
                for physics, most in MOST.items():
                    seconds = self.run_program(folder, "run", "case", physics, "--no-progress", "-o", f"out{physics}")
                    print(f"{Path(part).stem} {physics[2:]}: {seconds:.1f} s", flush=True)
                    self.assertLess(seconds, most, physics)
                    summary = json.loads((folder / f"out{physics}/summary.json").read_text())
                    answers = summary["answers"]
                    if physics == "--heat-only":
                        self.check_estimates(summary)
                    for name, casting in answers["castings"].items():
                        self.assertEqual(casting["solid_fraction"], 1, f"{name}, {physics}")

    def test_every_part_of_the_folder_is_in_the_list(self):
        self.assertEqual(sorted(path.name for path in (ROOT / "tests/parts").glob("*.step")),
                         sorted(Path(part).name for part, *_ in PARTS if part.startswith("tests/")))


if __name__ == "__main__":
    unittest.main()
