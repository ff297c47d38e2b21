"""`solidus new --fill` and `solidus fill` on fifteen parts with a gate chosen by the program, in 2500 cubes: the table of
docs/verification/filling.md."""

import json
import os
from pathlib import Path
import shutil
import subprocess
import unittest

ROOT = Path(__file__).resolve().parents[2]
PARTS = {"hook": "low_carbon_steel", "impeller": "tin_bronze", "grate": "aluminium_alsi7mg", "serpentine": "aluminium_alsi7mg",
         "bowl": "brass", "handwheel": "grey_iron", "finned_cylinder": "aluminium_alsi7mg", "stepped_plate": "aluminium_alsi7mg",
         "yoke": "low_carbon_steel", "flange": "aluminium_alsi7mg", "pump_housing": "grey_iron", "ribbed_cover": "magnesium_az91",
         "tee_flange": "aluminium_alsi10mg", "elbow": "nodular_iron", "cup_with_pin": "zinc_zamak5"}


def file_of(part):
    step = ROOT / f"tests/parts/{part}.step"
    return step if step.exists() else ROOT / f"tests/parts/filling/{part}.geo"


@unittest.skipUnless(shutil.which("icoReactingMultiphaseInterFoam"), "OpenFOAM is not installed (Debian's openfoam)")
class FillingParts(unittest.TestCase):
    def run_program(self, folder, *arguments):
        done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], *arguments], cwd=folder, capture_output=True, text=True, timeout=3600,
                              check=False)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stdout[-2000:]}{done.stderr}")

    def test_parts_fill_and_keep_volume_and_heat(self):
        folder = Path(os.environ["SOLIDUS_FOLDER"]) / "filling_parts"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for part, alloy in PARTS.items():
            with self.subTest(part=part):
                self.run_program(folder, "new", str(file_of(part)), "--alloy", alloy, "--fill", "-o", part)
                self.run_program(folder, "fill", part, "--set", "filling.cells=2500", "-o", f"{part}/filled")
                summary = json.loads((folder / part / "filled/filling.json").read_text())
                balance = summary["balance"]
                heat = (balance["lost"] - balance["walls"]) / balance["brought"]
                print(f"{part}: {100 * balance['corrected']:.2f} % corrected, heat {100 * heat:+.2f} %, {summary['answers'][1]}", flush=True)
                self.assertGreater(summary["full"], 0.989)
                self.assertAlmostEqual(balance["there"] / balance["came"], 1, delta=1e-5)
                self.assertLess(abs(heat), 0.008)
                self.assertLess(balance["corrected"], 0.02)
                self.assertLess(balance["returned"], 1e-4 * balance["brought"])


if __name__ == "__main__":
    unittest.main()
