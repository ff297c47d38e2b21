"""Meshes as other programs write them: which of their sets are bodies and surfaces, and what is reported of the rest."""

import itertools
import re
import tomllib
import unittest

from program import SOURCES, ProgramTest, solidus

ALLOY = ("--alloy", "aluminium_alsi7mg")


class Cells:
    """Cubes of `size` mm in a grid, numbered from one: corners as decks of Abaqus and .unv order them."""

    def __init__(self, cells, size):
        self.cells, self.size = cells, size
        nx, ny = cells[0] + 1, cells[1] + 1
        number = lambda i, j, k: 1 + i + nx * (j + ny * k)
        self.nodes = [(number(i, j, k), i * size, j * size, k * size)
                      for k, j, i in itertools.product(*(range(n + 1) for n in reversed(cells)))]
        ring = ((0, 0), (1, 0), (1, 1), (0, 1))
        self.elements = {
            (i, j, k): [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ring]
            for k, j, i in itertools.product(*map(range, reversed(cells)))
        }

    def abaqus_nodes(self):
        return "*NODE, NSET=Nall\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, x, y, z in self.nodes)


def lines(numbers):
    return "".join(f"{n},\n" for n in numbers)


class BlockOfTwoBodies(ProgramTest):
    """Eight cells of a casting next to eight of a mould."""

    def setUp(self):
        super().setUp()
        self.grid = Cells((4, 2, 2), 20)
        self.of_casting = [n for n, (i, _, _) in enumerate(self.grid.elements, 1) if i < 2]
        self.of_mould = [n for n, (i, _, _) in enumerate(self.grid.elements, 1) if i >= 2]

    def deck(self, elset, sets):
        """A deck whose elements are in `elset`, with further sets of numbers or names."""
        text = self.grid.abaqus_nodes() + f"*ELEMENT, TYPE=C3D8, ELSET={elset}\n"
        text += "".join(f"{n}, {', '.join(map(str, e))}\n" for n, e in enumerate(self.grid.elements.values(), 1))
        return text + "".join(f"*ELSET, ELSET={name}\n{lines(members)}" for name, members in sets.items())

    def gmsh_deck(self):
        """As Gmsh writes it: each volume, and each physical volume, in a set of its own."""
        text = self.grid.abaqus_nodes()
        for volume, numbers in (("Volume1", self.of_casting), ("Volume2", self.of_mould)):
            elements = list(self.grid.elements.values())
            text += f"*ELEMENT, type=C3D8, ELSET={volume}\n"
            text += "".join(f"{n}, {', '.join(map(str, elements[n - 1]))}\n" for n in numbers)
        return text + f"*ELSET,ELSET=casting\n{lines(self.of_casting)}*ELSET,ELSET=mould\n{lines(self.of_mould)}"

    def new(self, name, text, ending=".inp"):
        """What `solidus new` says, and the names of the bodies in the case that it writes."""
        self.write(name + ending, text)
        result = solidus("new", name + ending, "--unit", "mm", *ALLOY, "-o", name, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        case = tomllib.loads((self.folder / name / "case.toml").read_text())
        return result.stdout + result.stderr, sorted(body["name"] for body in case["body"])

    def refusal(self, *arguments):
        result = solidus(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout)
        return result.stderr


class SetsOfElements(BlockOfTwoBodies):
    def test_that_hold_what_others_hold_are_no_bodies_of_a_new_case(self):
        named = {"casting": self.of_casting, "mould": self.of_mould}
        for name, text in (("freecad", self.deck("Evolumes", {"Eall": ["Evolumes"], **named})),
                           ("gmsh", self.gmsh_deck()),
                           ("materials", self.deck("Eall", {**named, "Material_A": self.of_casting,
                                                            "Material_B": self.of_mould}))):
            with self.subTest(name):
                said, bodies = self.new(name, text)
                self.assertEqual(bodies, ["casting", "mould"])
                self.assertIn("is no body of its own", said)
                self.assertIn("64 cm3", re.sub(r"\s+", " ", said))

    def test_that_overlap_in_part_are_refused_by_new(self):
        self.write("part.inp", self.deck("one", {"casting": self.of_casting, "mould": [2, *self.of_mould]}))
        self.assertRegex(self.refusal("new", "part.inp", "--unit", "mm", *ALLOY),
                         "part.inp: the sets .* have elements in common")

    def test_a_small_set_for_output_is_left_out(self):
        said, bodies = self.new("output", self.deck("casting", {"watched": [1, 2]}))
        self.assertEqual(bodies, ["casting", "mould"])  # a mould is put around it
        self.assertIn("the set 'watched', 2 elements, lies in 'casting'", said)

    def test_two_bodies_of_a_case_that_share_elements_are_refused(self):
        self.write("shared.inp", self.deck("Eall", {"casting": self.of_casting}))
        self.write("case.toml", CASE.format(file="shared.inp", second="Eall", skin="Nall"))
        self.assertIn("the bodies 'casting' and 'Eall' have 8 elements in common", self.refusal("check", "case.toml"))


class SetsOfNodes(BlockOfTwoBodies):
    def test_serve_as_surfaces(self):
        left = [n for n, x, _, _ in self.grid.nodes if x == 0]
        text = self.deck("casting", {}) + f"*NSET, NSET=left\n{lines(left)}*NSET, NSET=edge\n1,\n2,\n"
        self.write("block.inp", text)
        self.write("case.toml", ONE_BODY.format(file="block.inp", skin="left"))
        said = solidus("check", "case.toml", cwd=self.folder)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("the set of 9 nodes 'left' serves as the surface of the 4 faces between them",
                      said.stdout + said.stderr)
        self.write("case.toml", ONE_BODY.format(file="block.inp", skin="edge"))
        self.assertIn("no face on the skin of the bodies has all of its corners in it",
                      self.refusal("check", "case.toml"))


class ValuesThatAreNotFinite(BlockOfTwoBodies):
    def test_of_a_text_of_vtk_do_not_hide_the_bodies_behind_them(self):
        """VTK's own reader loses what is behind the first of them (findings/vtk_writes_text_that_it_cannot_read.sh)."""
        cells = [f"8 {' '.join(str(n - 1) for n in element)}\n" for element in self.grid.elements.values()]
        bodies = [1 if n in self.of_casting else 2 for n in range(1, 17)]
        self.write("gaps.vtk", "# vtk DataFile Version 3.0\ngaps\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                   f"POINTS {len(self.grid.nodes)} double\n" + "".join(f"{x} {y} {z}\n" for _, x, y, z in self.grid.nodes)
                   + f"CELLS 16 {16 * 9}\n{''.join(cells)}CELL_TYPES 16\n{'12 ' * 16}\n"
                   f"CELL_DATA 16\nSCALARS gap double 1\nLOOKUP_TABLE default\n{'nan inf -inf 1 ' * 4}\n"
                   f"SCALARS body int 1\nLOOKUP_TABLE default\n{' '.join(map(str, bodies))}\n")
        said = solidus("mesh-info", "gaps.vtk", "--unit", "mm", cwd=self.folder)
        self.assertEqual(said.returncode, 0, said.stderr)
        for body in ("body_1", "body_2"):
            self.assertRegex(said.stdout, rf"{body} +body +27 +8 hex8 +64000 mm3")


class UnitsOfFiles(ProgramTest):
    UNITS = SOURCES / "tests/unit/mesh/units"

    def test_that_cad_names_are_said_and_another_one_is_refused(self):
        said = self.done("mesh-info", self.UNITS / "inch.step")
        self.assertIn("the file says that its lengths are in inch", said)
        self.assertIn("x 0 to 101.6", said)
        for verb in (("mesh-info",), ("new", *ALLOY)):
            result = solidus(verb[0], self.UNITS / "metre.step", *verb[1:], "--unit", "mm", cwd=self.folder)
            self.assertEqual(result.returncode, 1, result.stdout)
            self.assertIn("--unit: the unit 'mm' contradicts the file", result.stderr)

    def test_that_are_none_are_the_users_mistake(self):
        result = solidus("new", self.UNITS / "inch.step", *ALLOY, "--unit", "foo", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("'foo' is no unit of length", result.stderr)

    def test_of_a_new_case_are_those_of_the_file(self):
        said = self.done("new", self.UNITS / "inch.step", *ALLOY, "--unit", "inch", "--fineness", "0.5", "-o", "case")
        self.assertIn("101.6 x 50.8 x 25.4 mm", said)
        self.assertIn("inch, as the file says", said)
        self.assertNotIn("unit", tomllib.loads((self.folder / "case/case.toml").read_text())["mesh"])


class UnsoundMeshes(ProgramTest):
    """A block of two cells whose hot end has a film of 500 degC."""

    def check(self, mesh):
        self.write("mesh.msh", mesh)
        self.write("case.toml", ONE_BODY.format(file="mesh.msh", skin="hi"))
        result = solidus("check", "case.toml", cwd=self.folder)
        return result.returncode, result.stdout + result.stderr

    def mesh(self, second=(5, 6, 7, 8), hexahedra=1, faces=(((9, 10, 11, 12), 1),)):
        """Cubes of 10 mm along x as .msh 2.2: nodes 5 to 8 are the end of the first, 13 to 16 in the same place."""
        at = [(x, y, z) for x in (0, 10, 20, 10) for y, z in ((0, 0), (10, 0), (10, 10), (0, 10))]
        elements = [(5, 1, (1, 2, 3, 4, 5, 6, 7, 8))] + [(5, 1, (*second, 9, 10, 11, 12))] * hexahedra
        for nodes, times in faces:
            elements += [(3, 2, nodes)] * times
        return "\n".join([
            "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '3 1 "casting"', '2 2 "hi"',
            "$EndPhysicalNames", "$Nodes", str(len(at)), *(f"{n} {x} {y} {z}" for n, (x, y, z) in enumerate(at, 1)),
            "$EndNodes", "$Elements", str(len(elements)),
            *(f"{n} {kind} 2 {group} {group} {' '.join(map(str, nodes))}"
              for n, (kind, group, nodes) in enumerate(elements, 1)), "$EndElements", ""])

    def test_that_are_sound_are_taken_without_a_word(self):
        code, said = self.check(self.mesh())
        self.assertEqual(code, 0, said)
        self.assertNotRegex(said, "twice|inside of a body|coincide|pieces")

    def test_halves_that_are_not_merged_are_joined(self):
        code, said = self.check(self.mesh(second=(13, 14, 15, 16)))
        self.assertEqual(code, 0, said)
        self.assertIn("1 pairs of faces inside of the body 'casting' coincide, one of them at (10, 5, 5) mm", said)

    def test_nodes_that_hang_in_a_face_are_refused(self):
        whole = self.mesh(faces=(((9, 15, 16, 12), 1), ((15, 10, 11, 16), 1)))
        for node, place in ((13, "10 5 0"), (14, "10 5 10"), (15, "20 5 0"), (16, "20 5 10")):
            whole = re.sub(f"(?m)^{node} 10 [0-9]+ [0-9]+$", f"{node} {place}", whole)
        one = next(line for line in whole.splitlines() if line.endswith(" 5 6 7 8 9 10 11 12"))
        number = one.split()[0]
        halves = f"{number} 5 2 1 1 5 13 14 8 9 15 16 12\n99 5 2 1 1 13 6 7 14 15 10 11 16"
        code, said = self.check(whole.replace(one, halves).replace("$Elements\n4\n", "$Elements\n5\n"))
        self.assertEqual(code, 1, said)
        self.assertIn("2 nodes hang in faces of the body 'casting' without being their corners", said)

    def test_elements_and_faces_that_are_there_twice_count_once(self):
        _, said = self.check(self.mesh(hexahedra=2))
        self.assertIn("1 elements of the body 'casting' are in the mesh twice", said)
        _, said = self.check(self.mesh(faces=(((9, 10, 11, 12), 2),)))
        self.assertIn("1 faces of the surface 'hi' are in the mesh twice", said)

    def test_faces_inside_of_a_body_are_refused(self):
        code, said = self.check(self.mesh(faces=(((9, 10, 11, 12), 1), ((5, 6, 7, 8), 1))))
        self.assertEqual(code, 1, said)
        self.assertIn("1 of the 2 faces of 'hi' lie inside of a body, one of them at (10, 5, 5) mm", said)


ONE_BODY = """
title = "A mesh of another program"

[analysis]
kind = "solid"
physics = "heat"

[mesh]
file = "{file}"
unit = "mm"

[[body]]
name = "casting"
material = "aluminium_alsi7mg"
initial_temperature = "600 degC"

[[thermal_condition]]
name = "film"
kind = "film"
group = "{skin}"
coefficient = "1000 W/m2/K"
ambient = "20 degC"

[time]
end = "1 s"
step = "0.5 s"
"""
CASE = ONE_BODY.replace("[[thermal_condition]]", """[[body]]
name = "{second}"
material = "green_sand"
initial_temperature = "20 degC"

[[thermal_condition]]""")

if __name__ == "__main__":
    unittest.main()
