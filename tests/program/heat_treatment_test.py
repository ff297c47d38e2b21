"""The case of a heat treatment: what each stage does to the stress that the one before it left."""

import os
from pathlib import Path
import subprocess
import unittest

from program import SOURCES, ProgramTest


class HeatTreatment(ProgramTest):
    def test_the_furnace_relaxes_the_water_strains_and_ageing_takes_little(self):
        case = SOURCES / "cases/heat_treatment"
        self.done("run", str(case), "-o", "disc", timeout=600)
        printed = subprocess.run(["/usr/bin/python3", str(case / "after_stages.py"), str(Path(self.folder) / "disc")], text=True, check=True,
                                 capture_output=True, env={**os.environ, "PYTHONPATH": str(SOURCES / "python")}).stdout
        rows = {line.split()[0]: [float(word) for word in line.split()[1:]] for line in printed.splitlines()[1:]}
        self.assertEqual(list(rows), ["pour", "air", "solution", "quench", "ageing", "cold"])
        mean = {name: row[2] for name, row in rows.items()}
        self.assertAlmostEqual(rows["solution"][0], 540, delta=0.5)
        self.assertLess(mean["solution"], 0.2 * mean["air"])
        self.assertGreater(mean["quench"], 5 * mean["solution"])
        self.assertLess(mean["ageing"], mean["quench"])
        self.assertGreater(mean["ageing"], 0.8 * mean["quench"])


if __name__ == "__main__":
    unittest.main()
