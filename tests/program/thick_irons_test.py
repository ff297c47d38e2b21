"""`wall_movement` of [feeding]: the wall of the mould gives way to graphite by a length, so by a share that falls with the
size of a casting."""

import json
import unittest

from program import SOURCES, ProgramTest, solidus

CASE = str(SOURCES / "cases/riser_and_pipe")


class ThickIrons(ProgramTest):
    def share(self, name, *words):
        """Of what was cast, by which the wall gave way."""
        settings = [word for one in words for word in ("--set", one)]
        self.done("run", CASE, "--heat-only", "--no-progress", "--processes", "1", "-o", name, *settings)
        found = json.loads((self.folder / name / "summary.json").read_text())["criteria"]
        self.assertLess(abs(found["feeding_defect"]), 1e-12)
        return found["feeding_wall[m3]"] / found["feeding_room[m3]"]

    def test_a_wall_that_has_moved_by_its_length_holds(self):
        free, far = self.share("free"), self.share("far", 'feeding.wall_movement="10 mm"')
        self.assertAlmostEqual(far / free, 1, places=9)
        once, twice = (self.share(str(length), f'feeding.wall_movement="{length} mm"') for length in (0.05, 0.1))
        self.assertLess(once, 0.5 * free)
        self.assertAlmostEqual(twice / once, 2, delta=0.02)
        # Ten times as large, all times a hundred times as long.
        large = self.share("large", 'feeding.wall_movement="0.05 mm"', 'mesh.unit="cm"', 'time.end="200 h"', 'time.step="100 s"')
        self.assertAlmostEqual(large / once, 0.1, delta=0.002)

    def test_without_graphite_it_is_refused(self):
        result = solidus("check", CASE, "--heat-only", "--set", 'feeding.wall_movement="1 mm"', "--set",
                         'body.casting.material="low_carbon_steel"', "--set", 'body.riser.material="low_carbon_steel"',
                         cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("nothing that is cast has graphite", result.stderr)


if __name__ == "__main__":
    unittest.main()
