"""The case of a heat treatment: what each stage does to the stress that the one before it left, and that the answers tell it as the fields do."""

import csv
import unittest

import numpy as np

from program import SOURCES, ProgramTest
from solidus_plots.vtu import read_collection, read_fields


class HeatTreatment(ProgramTest):
    def test_the_furnace_relaxes_the_water_strains_and_ageing_takes_little(self):
        printed = self.done("run", str(SOURCES / "cases/heat_treatment"), "-o", "disc", timeout=600)
        stages = self.summary(self.folder / "disc")["answers"]["stages"]
        self.assertEqual([stage["name"] for stage in stages], ["pour", "air", "solution", "quench", "ageing", "cold"])
        self.assertEqual([stage["end[s]"] for stage in stages], [120, 2520, 13320, 13380, 27780, 31380])
        mean = {stage["name"]: stage["mean_von_mises[Pa]"] for stage in stages}
        self.assertAlmostEqual(stages[2]["highest_temperature[K]"], 540 + 273.15, delta=0.5)
        self.assertLess(mean["solution"], 0.2 * mean["air"])
        self.assertGreater(mean["quench"], 5 * mean["solution"])
        self.assertLess(mean["ageing"], mean["quench"])
        self.assertGreater(mean["ageing"], 0.8 * mean["quench"])
        self.compare_with_fields(stages)
        self.compare_with_table(stages)
        for stage in stages:
            self.assertIn(f"end of '{stage['name']}'", printed)

    def compare_with_fields(self, stages):
        """Temperatures, the largest stress and the largest distortion are those of the fields that the end of a stage writes."""
        times, files = read_collection(self.folder / "disc/fields.pvd")
        for stage in stages:
            at = int(np.argmin(np.abs(times - stage["end[s]"])))
            self.assertAlmostEqual(times[at], stage["end[s]"], delta=1e-6)
            grid = read_fields(files[at])
            temperature, stress = grid.point_data["temperature"], grid.cell_data["von_mises"]
            distortion = np.linalg.norm(grid.point_data["distortion"], axis=1).max()
            for name, value in (("lowest_temperature[K]", temperature.min()), ("highest_temperature[K]", temperature.max()),
                                ("largest_von_mises[Pa]", stress.max()), ("largest_distortion[m]", distortion)):
                self.assertAlmostEqual(stage[name] / value, 1, delta=1e-5, msg=(stage["name"], name))
            self.assertTrue(stress.min() < stage["mean_von_mises[Pa]"] < stress.max())

    def compare_with_table(self, stages):
        with (self.folder / "disc/stages.csv").open(newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([float(row["time[s]"]) for row in rows], [stage["end[s]"] for stage in stages])
        for row, stage in zip(rows, stages):
            self.assertEqual(float(row["mean_von_mises[Pa]"]), stage["mean_von_mises[Pa]"])
            self.assertAlmostEqual(float(row["highest_temperature[degC]"]), stage["highest_temperature[K]"] - 273.15, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
