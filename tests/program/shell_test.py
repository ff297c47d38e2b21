"""Investment shells: coats that follow the skin of what is cast."""

import math
import re
import unittest

from program import SOURCES, ProgramTest, solidus

# A ball of 40 mm in its shell, by its cross-section: an axisymmetric mesh of its own.
SECTION = """
R = 20; D = 8; h = 0.5;
Point(1) = {0, 0, 0, h}; Point(2) = {R, 0, 0, h}; Point(3) = {0, R, 0, h}; Point(4) = {R + D, 0, 0, h};
Point(5) = {0, R + D, 0, h};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Line(4) = {2, 4}; Circle(5) = {4, 1, 5}; Line(6) = {5, 3};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, -2}; Plane Surface(2) = {2};
Physical Surface("casting") = {1}; Physical Surface("shell") = {2}; Physical Curve("outside") = {5};
"""
CASE_OF_SECTION = """
title = "A ball in its shell"
[analysis]
kind = "axisymmetric"
physics = "heat"
[mesh]
file = "section.geo"
unit = "mm"
[time]
until = "solid"
end = "900 s"
step = "0.1 s"
adaptive = true
[[body]]
name = "casting"
material = "low_carbon_steel"
initial_temperature = "1605 degC"
[[body]]
name = "shell"
role = "mould"
material = "ceramic_shell"
initial_temperature = "900 degC"
[[interface]]
bodies = "all"
[[thermal_condition]]
name = "air"
group = "outside"
kind = "film"
coefficient = "10 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "radiation"
group = "outside"
kind = "radiation"
emissivity = 0.8
ambient = "20 degC"
"""
STEEL = ("--alloy", "low_carbon_steel", "--process", "shell")


def ball_stl(radius, n=24):
    """A ball of triangles by latitude and longitude."""
    def point(i, k):
        polar, round_ = math.pi * i / n, 2 * math.pi * k / (2 * n)
        return tuple(radius * c for c in (math.sin(polar) * math.cos(round_), math.sin(polar) * math.sin(round_),
                                          math.cos(polar)))
    triangles = []
    for i in range(n):
        for k in range(2 * n):
            a, b, c, d = point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)
            if i < n - 1:
                triangles.append((a, b, c))
            if i > 0:
                triangles.append((a, c, d))
    text = "solid ball\n"
    for triangle in triangles:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*p) for p in triangle)
        text += "endloop\nendfacet\n"
    return text + "endsolid ball\n"


def box_stl(size):
    """A box from the origin on."""
    def corner(c):
        return tuple(size[i] if c >> i & 1 else 0 for i in range(3))
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    text = "solid box\n"
    for a, b, c, d in faces:
        for triangle in ((a, b, c), (a, c, d)):
            text += "facet normal 0 0 0\nouter loop\n"
            text += "".join("vertex {} {} {}\n".format(*corner(p)) for p in triangle)
            text += "endloop\nendfacet\n"
    return text + "endsolid box\n"


class Shell(ProgramTest):
    def volume(self, text, body):
        """Of a body in the table of `check` [cm3]."""
        return float(re.search(rf"body +{body} .*? ([\d.]+) cm3", text)[1])

    def test_a_ball_freezes_as_in_its_cross_section(self):
        self.write("ball.stl", ball_stl(20))
        made = self.done("new", "ball.stl", *STEEL, "--fineness", "0.8", "-o", "case")
        self.assertIn("shell       8 mm thick, on all of the skin", made)
        case = (self.folder / "case/case.toml").read_text()
        self.assertIn('kind = "radiation"', case)
        self.assertIn('initial_temperature = "900 degC"   # poured hot', case)
        checked = self.done("check", "case")
        offset = 4 / 3 * math.pi * (2.8**3 - 2.0**3)
        self.assertAlmostEqual(self.volume(checked, "shell") / offset, 1, delta=0.04)
        self.assertIn("The case is in order", checked)
        self.done("run", "--heat-only", "case", "-o", "out", "--no-progress")
        self.write("section.geo", SECTION)
        self.write("section.toml", CASE_OF_SECTION)
        self.done("run", "section.toml", "-o", "section", "--no-progress")
        def frozen(folder):
            answers, = self.summary(self.folder / folder)["answers"]["castings"].values()
            return answers["last_melt_froze"]["value[s]"]
        self.assertAlmostEqual(frozen("out") / frozen("section"), 1, delta=0.025)

    def test_thickness_is_asked_for_as_length_or_coats(self):
        self.write("box.stl", box_stl((40, 30, 20)))
        a, b, c, d = 4.0, 3.0, 2.0, 0.55  # cm; five coats
        self.done("new", "box.stl", *STEEL, "--coats", "5", "-o", "case")
        offset = 2 * (a * b + b * c + c * a) * d + math.pi * d**2 * (a + b + c) + 4 / 3 * math.pi * d**3
        self.assertAlmostEqual(self.volume(self.done("check", "case"), "shell") / offset, 1, delta=0.03)
        self.done("new", "box.stl", *STEEL, "--shell", "0.7 cm", "--fineness", "0.5", "-o", "other")
        self.assertIn('thickness = "7 mm"', (self.folder / "other/case.toml").read_text())

    def test_a_cup_is_open_and_coats_are_bodies(self):
        case = self.write("tree/case.toml", (SOURCES / "cases/turbine_tree/case.toml").read_text().replace(
            '[[mesh.coat]]', '[[mesh.coat]]\nname = "face_coat"\nthickness = "1.5 mm"\n[[mesh.coat]]', 1).replace(
            'thickness = "8 mm"', 'thickness = "6.5 mm"').replace(
            '[[body]]\nname = "shell"', '[[body]]\nname = "face_coat"\nrole = "mould"\nmaterial = "zircon_sand"\n'
            'initial_temperature = "850 degC"\n\n[[body]]\nname = "shell"').replace("shell_to_", "face_coat_to_").replace(
            'body = "shell"', 'body = "face_coat"').replace(
            "number = 4", "number = 2").replace('"4.4 mm"', '"7 mm"').replace('"2.7 mm"', '"5 mm"').replace("0.89 mm", "0.3 mm"))
        (self.folder / "tree/turbine_tree.step").write_bytes((SOURCES / "cases/turbine_tree/turbine_tree.step").read_bytes())
        text = self.done("check", str(case))
        self.assertRegex(text, "face_coat_shell .*shell_to_face_coat")
        self.assertRegex(text, r"air_on_gating +gating_free")
        self.assertAlmostEqual(self.volume(text, "face_coat") + self.volume(text, "shell"), 296.8, delta=9)

    def test_what_cannot_be_a_shell_is_refused(self):
        def refused(*arguments):
            result = solidus(*arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
            return result.stderr
        self.write("box.stl", box_stl((40, 30, 20)))
        new = ("new", "box.stl", *STEEL, "--fineness", "0.4", "-o", "case")
        self.assertIn("--shell: a number without unit", refused(*new, "--shell", "8"))
        self.assertIn("a shell of 300 mm", refused(*new, "--shell", "30 cm"))
        self.assertIn("--coats: --shell says how thick", refused(*new, "--shell", "8 mm", "--coats", "3"))
        self.assertIn("the process 'sand' has no shell",
                      refused("new", "box.stl", "--alloy", "tin_bronze", "--coats", "3"))
        self.done(*new)
        text = (self.folder / "case/case.toml").read_text()
        for old, new_text, said in (
                ('walls = "10 mm"', 'walls = "7 mm"', "no room for coats that are 8 mm thick"),
                ('thickness = "8 mm"', 'thickness = "0 mm"', "thickness"),
                ('name = "shell"\nthickness', 'name = "box"\nthickness', "has the name of a group of the geometry")):
            with self.subTest(said):
                self.assertIn(old, text)
                (self.folder / "case/case.toml").write_text(text.replace(old, new_text, 1))
                self.assertIn(said, refused("check", "case"))


if __name__ == "__main__":
    unittest.main()
