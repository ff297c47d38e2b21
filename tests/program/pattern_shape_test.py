"""`solidus pattern` of an eighth of a ball that cools from 620 to 20 degC without a mould, whose inverse is known: larger by
1/(1 − 0.012), expansion 2e-5 1/K; and `solidus compare-shape` of what came out."""

import json
import struct
import unittest

from program import SOURCES, ProgramTest, solidus

CONTRACTION = 0.012
CASE = """
title = "A ball that shrinks"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
file = "octant.geo"
unit = "mm"
[time]
end = "{end} s"
step = "1 s"
[[body]]
name = "ball"
material = "metal.toml"
initial_temperature = "620 degC"
[[thermal_condition]]
name = "cold"
group = "ball"
kind = "temperature"
temperature = "20 degC"
"""
PLANE = """
[[mesh.group]]
name = "{axis}0"
owner = "ball"
normal = {normal}
[[mechanical_condition]]
name = "held_{axis}"
group = "{axis}0"
kind = "displacement"
u{axis} = "0 mm"
"""
OCTANT = """
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 40, 0, Pi/2, Pi/2};
Mesh.CharacteristicLengthMin = 12; Mesh.CharacteristicLengthMax = 12;
Physical Volume("ball") = {1};
"""
METAL = {"density": '"2700 kg/m3"', "conductivity": '"150 W/m/K"', "specific_heat": '"900 J/kg/K"', "young_modulus": '"70 GPa"',
         "poisson_ratio": "0.33", "expansion": '"2e-5 1/K"'}


def points_of_msh(path):
    lines = path.read_text().split("$Nodes\n")[1].split("$EndNodes")[0].splitlines()[1:]
    return [[float(word) for word in line.split()[1:]] for line in lines]


def points_of_stl(path):
    data = path.read_bytes()
    return [struct.unpack_from("<9f", data, 84 + 50 * i + 12) for i in range(int.from_bytes(data[80:84], "little"))]


class Pattern(ProgramTest):
    def write_case(self, end=5):
        planes = "".join(PLANE.format(axis=axis, normal=[-float(k == i) for k in range(3)]) for i, axis in enumerate("xyz"))
        self.write("case.toml", CASE.format(end=end) + planes)
        self.write("octant.geo", OCTANT)
        self.write("metal.toml", 'title = "Constant"\n' + "".join(f'[{key}]\nvalue = {value}\nsource = "chosen"\n' for key, value in METAL.items()))

    def test_the_pattern_of_a_ball_is_larger_by_the_inverse_of_its_contraction(self):
        self.write_case()
        said = self.done("pattern", "case.toml", "-o", "out", "--tolerance", "1e-6 mm")
        found = json.loads((self.folder / "out/pattern.json").read_text())
        drawn, made = (points_of_msh(self.folder / "out" / name) for name in ("drawing.msh", "pattern.msh"))
        for before, after in zip(drawn, made, strict=True):
            for x, y in zip(before, after):
                self.assertAlmostEqual(y, x / (1 - CONTRACTION), delta=2e-9)
        for axis in "xyz":
            self.assertAlmostEqual(found["contraction[%]"][axis], 100 * CONTRACTION, delta=1e-6)
        self.assertIn("contraction from pattern to casting: x 1.2 %, y 1.2 %, z 1.2 %", said)
        largest = max(max(map(abs, corners)) for corners in points_of_stl(self.folder / "out/pattern_ball.stl"))
        self.assertAlmostEqual(largest, 1e3 * max(max(point) for point in made), delta=1e-5)
        # The pattern compared with the drawing deviates by its allowance, the casting of it does not.
        self.done("compare-shape", "out/pattern_ball.stl", "out/run_1", "--nominal", "--as-placed", "-o", "larger")
        larger = json.loads((self.folder / "larger/shape.json").read_text())
        self.assertAlmostEqual(larger["largest[m]"], found["largest_allowance[m]"], delta=0.03 * found["largest_allowance[m]"])

    def test_what_cannot_be_is_told(self):
        self.write_case(end=1)
        for arguments, words, code in ((["pattern", "case.toml", "--tolerance", "5"], "a length above zero", 1),
                                       (["pattern", "case.toml", "--set", "analysis.physics='heat'"], "no mechanics in this analysis", 1),
                                       (["pattern", "case.toml", "--body", "none"], "there is no body 'none'; there are ball", 1),
                                       (["pattern", "case.toml", "--runs", "1", "--tolerance", "1 um"], "is not met after 1 runs", 2),
                                       (["compare-shape", "none.stl", str(SOURCES / "nowhere")], "neither a folder of results nor an STL", 1)):
            with self.subTest(arguments=arguments):
                result = solidus(*arguments, *(["-o", "bad"] if arguments[0] == "pattern" else []), cwd=self.folder)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main()
