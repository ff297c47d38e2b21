"""A format of meshes in one file of the tests, which no source, Python or page names, is wherever formats are."""

import os
import subprocess
import unittest

from program import ProgramTest

SQUARES = """NDIME= 2
NELEM= 2
9 0 1 4 3 0
9 1 2 5 4 1
NPOIN= 6
0 0 0
10 0 1
20 0 2
0 10 3
10 10 4
20 10 5
NMARK= 1
MARKER_TAG= left
MARKER_ELEMS= 1
3 3 0
"""
CASE = """
title = "A block that cools at its left"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "squares.su2"
unit = "mm"
[time]
end = "20 s"
step = "5 s"
[[body]]
name = "body"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "air"
group = "left"
kind = "film"
coefficient = "500 W/m2/K"
ambient = "20 degC"
"""


class AddedMeshFormat(ProgramTest):
    def solidus(self, *arguments):
        return subprocess.run([os.environ["SOLIDUS_WITH_ADDED_PARTS"], *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_a_case_reads_it(self):
        self.write("squares.su2", SQUARES)
        self.write("case.toml", CASE)
        checked = self.solidus("check", "case.toml")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("6 nodes, 2 quad4", checked.stdout)
        self.assertIn("left (body)", checked.stdout)
        run = self.solidus("run", "case.toml", "-o", "out", "--no-progress")
        self.assertEqual(run.returncode, 0, run.stderr)
        shown = self.solidus("mesh-info", "squares.su2", "--unit", "mm")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("left", shown.stdout)

    def test_what_is_wrong_with_a_file_is_said_as_of_all_formats(self):
        for name, content, said in (("a.su2", "$MeshFormat\n", "the file is not what its name says: a .su2 file begins with 'NDIME='"),
                                    ("b.su2", SQUARES.replace("9 0 1 4 3 0", "9 0 1 9 3 0"), "'body' has the node 9, which is not there"),
                                    ("c.su2", SQUARES.replace("9 0", "13 0"), "elements of type 13 are not read"),
                                    ("d.xyz", SQUARES, ".bdf, .nas, .su2, .mesh")):
            self.write(name, content)
            refused = self.solidus("mesh-info", name)
            self.assertEqual(refused.returncode, 1, refused.stdout)
            self.assertIn(said, refused.stderr)


if __name__ == "__main__":
    unittest.main()
