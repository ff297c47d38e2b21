"""`solidus new` from skins of triangles and from meshes. (From solids: tests/cases/step_test.cpp.)"""

import itertools
import math
import re
import tomllib
import unittest

from program import NIGHTLY, SOURCES, ProgramTest, solidus

ALLOY = ("--alloy", "aluminium_alsi7mg")


def box(low, high):
    """The twelve triangles of a box."""
    corner = [tuple((high if c >> i & 1 else low)[i] for i in range(3)) for c in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [[corner[f[i]] for i in ends] for f in faces for ends in ((0, 1, 2), (0, 2, 3))]


def stl(name, triangles):
    lines = [f"solid {name}"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x} {y} {z}" for x, y, z in corners), "endloop",
                  "endfacet"]
    return "\n".join([*lines, f"endsolid {name}", ""])


def grid(cells, size, group_of):
    """A mesh of cubes as .msh 2.2; group_of(i, j, k) names the group of a cell, or nothing."""
    names, elements = [], []
    number = lambda i, j, k: 1 + i + (cells[0] + 1) * (j + (cells[1] + 1) * k)
    for i, j, k in itertools.product(*map(range, cells)):
        group = group_of(i, j, k)
        if group is None:
            continue
        if group not in names:
            names.append(group)
        corners = [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        elements.append((names.index(group) + 1, corners))
    used = {node for _, corners in elements for node in corners}
    nodes = [(number(i, j, k), i * size, j * size, k * size)
             for k, j, i in itertools.product(*(range(n + 1) for n in reversed(cells))) if number(i, j, k) in used]
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)),
         *(f'3 {n + 1} "{name}"' for n, name in enumerate(names)), "$EndPhysicalNames", "$Nodes", str(len(nodes)),
         *(" ".join(map(str, node)) for node in nodes), "$EndNodes", "$Elements", str(len(elements)),
         *(f"{n + 1} 5 2 {group} {group} " + " ".join(map(str, corners)) for n, (group, corners) in enumerate(elements)),
         "$EndElements", ""])


class NewCase(ProgramTest):
    def new(self, file, *arguments):
        text = self.done("new", file, *ALLOY, *arguments, "-o", "case")
        return text, tomllib.loads((self.folder / "case/case.toml").read_text())

    def refusal(self, file, *arguments):
        result = solidus("new", file, *ALLOY, *arguments, "-o", "refused", cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertFalse((self.folder / "refused/case.toml").exists())
        return result.stderr

    def test_of_a_hollow_stl_has_a_mould_and_a_core_and_freezes(self):
        self.write("pump.stl", stl("pump housing", box((0, 0, 0), (60, 40, 40)) + box((10, 10, 10), (30, 30, 30))))
        text, case = self.new("pump.stl", "--fineness", "0.5")
        roles = {body["group"] if "group" in body else body["name"]: body["role"] for body in case["body"]}
        self.assertEqual(roles, {"pump_housing": "casting", "mould": "mould", "core": "core"})
        self.assertEqual(case["time"]["until"], "solid")
        self.done("run", "case", "--heat-only", "-o", "out", "--no-progress")
        summary = self.summary(self.folder / "out")
        self.assertEqual(summary["answers"]["castings"]["pump_housing"]["solid_fraction"], 1)
        self.assertLess(summary["answers"]["time[s]"], float(case["time"]["end"].split()[0]))
        volumes = {body["name"]: body["volume[m3]"] for body in summary["understood"]["bodies"]}
        self.assertAlmostEqual(volumes["pump_housing"], 88e-6, delta=1e-11)
        self.assertAlmostEqual(volumes["core"], 8e-6, delta=1e-12)

    def test_of_parts_around_hot_steel_expects_the_time_of_the_run(self):
        # Runs of these parts, nothing set, heat alone [s]; the steel between blades and in bores gets hot.
        for part, run in (("fan", 7.9), ("cup_with_pin", 6.0))[0 if NIGHTLY else 1:]:
            text = self.done("new", str(SOURCES / f"tests/parts/{part}.step"), "--alloy", "aluminium_alsi9cu3",
                             "--process", "high_pressure", "--fineness", "0.7", "-o", part)
            expected = float(re.search(r"freezes +in about ([\d.]+) s", text)[1])
            self.assertTrue(0.6 < expected / run < 1.6, f"{part}: {expected} s")

    @unittest.skipUnless(NIGHTLY, "by night: the assembly of a valve")
    def test_of_an_assembly_takes_roles_from_names_and_says_which_body_is_which(self):
        text = self.done("new", str(SOURCES / "tests/parts/valve.step"), "--alloy", "brass", "--fineness", "0.8", "-o", "case")
        case = tomllib.loads((self.folder / "case/case.toml").read_text())
        roles = {body.get("group", body["name"]): body["role"] for body in case["body"]}
        self.assertEqual(roles, {"valve_body": "casting", "core": "core", "mould": "mould"})
        # Without friction nothing holds a casting that has left its walls.
        self.assertEqual([law["friction"]["coefficient"] for law in case["interface"]], [0.3] * len(case["interface"]))
        self.assertRegex(text, r"casting +valve_body of brass, \d+ degC, 9\d\.\d cm3 in a box of 100 x 5\d(\.\d+)? x 71(\.\d+)? mm")
        self.numbered_faces("case", "valve_body")

    def test_faces_of_a_geometry_are_numbered_in_pictures(self):
        self.numbered_faces(str(SOURCES / "cases/bracket"), "part")

    def numbered_faces(self, case, body):
        pictures = self.folder / "faces"
        table = self.done("mesh-info", case, "--pictures", "faces")
        numbers = [int(line.split()[0]) for line in table.splitlines() if line.split()[1:2] == [body]]
        self.assertTrue((pictures / f"faces_{min(numbers)}_to_{max(numbers)}.png").stat().st_size > 20000)
        self.assertIn("SCALARS face int 1", (pictures / "faces.vtk").read_text())

    def test_of_a_part_of_millimetres_does_not_spend_its_nodes_on_the_mould(self):
        self.write("chip.stl", stl("chip", box((0, 0, 0), (3, 2, 1))))
        text, _ = self.new("chip.stl", "--process", "gravity_die")
        self.assertIn("3 mm large, for lengths of the file in mm: --unit takes another unit", text)
        nodes = int(re.search(r"mesh +(\d+) nodes", text)[1])
        self.assertLess(nodes, 30000)
        checked = solidus("check", "case", "--heat-only", cwd=self.folder)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        # The interface of all bodies has nothing left besides that of casting and die: no reason to warn.
        self.assertNotIn("no two bodies face each other", checked.stderr)

    def test_of_shots_the_castings_freeze_in_their_die_and_the_die_stays_as_warm_as_it_was(self):
        self.write("block.stl", stl("block", box((0, 0, 0), (80, 50, 20))))
        text, case = self.new("block.stl", "--process", "gravity_die", "--shots", "5", "--fineness", "0.4")
        self.assertRegex(text, r"cooling +\d+ W/m2/K outside the die")
        self.assertIn("cooling_of_die", [condition["name"] for condition in case["thermal_condition"]])
        said = self.done("run", "case", "--heat-only", "-o", "out", "--no-progress")
        shots = re.findall(r"^shot \d+: solid [\d.]+ s after pouring; the die had ([\d.]+) degC in the mean", said, re.M)
        self.assertEqual(len(shots), 5, said[-3000:])
        for mean in map(float, shots):
            self.assertLess(abs(mean - 250), 30)  # what is left is what the estimate does not know

    def riser(self, case):
        """Foot, diameter and height of the riser [mm]."""
        mm = lambda text: float(text.split()[0])
        riser, = case["mesh"]["riser"]
        return [mm(x) for x in riser["foot"]], mm(riser["diameter"]), mm(riser["height"])

    def volumes(self):
        self.done("run", "case", "--heat-only", "--set", "time.until=end", "--set", 'time.end="1 s"', "--set",
                  'time.step="1 s"', "-o", "out", "--no-progress")
        return {body["name"]: body["volume[m3]"] for body in self.summary(self.folder / "out")["understood"]["bodies"]}

    def test_a_plane_of_symmetry_goes_through_the_middle_of_curved_bodies(self):
        # Facets of a ball reach less far on one side than on the other: 0.003 and 0.008 mm here.
        for axis in "xyz" if NIGHTLY else "x":
            text = self.done("new", str(SOURCES / "tests/parts/dumbbell.step"), *ALLOY, "--symmetry", axis, "--fineness", "0.4", "-o",
                             f"half_{axis}")
            self.assertIn(f"symmetry    the half below {axis} = 0 mm is computed", text)

    def test_a_riser_stands_on_the_plane_of_symmetry_which_halves_it(self):
        part = str(SOURCES / "tests/parts/stepped_plate.step")  # `./dev nightly` runs one of the tee_flange
        text, case = self.new(part, "--symmetry", "y", "--riser", "auto", "--fineness", "0.5")
        self.assertIn("symmetry    the half below y = 30 mm is computed", text)
        self.assertIn("high, halved by the plane of symmetry on which it stands", text)
        foot, diameter, height = self.riser(case)
        self.assertAlmostEqual(foot[1], 30, places=6)
        # Half a cylinder, but for its foot in the part and the sides of the polygon that elements make of it.
        half = 1e-9 * math.pi / 8 * diameter**2 * height
        self.assertTrue(0.85 * half < self.volumes()["riser"] < half)
        result = solidus("new", part, *ALLOY, "--symmetry", "z", "--riser", "auto", "-o", "refused", cwd=self.folder)
        self.assertIn("with a riser or a sprue on top nothing is symmetric in z", result.stderr)

    def test_a_riser_is_cooled_by_the_mould_whose_surface_it_shares_with_its_casting(self):
        self.new(str(SOURCES / "cases/bracket_from_step/bracket.step"), "--riser", "auto", "--fineness", "0.7")
        checked = solidus("check", "case", cwd=self.folder)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertNotIn("nothing cools", checked.stderr)
        self.assertIn("gap 0 mm in the mean, 0 mm at most", checked.stdout + checked.stderr)
        self.assertRegex(checked.stdout, r"freezes +riser: in about")

    def test_of_an_assembly_with_riser_sleeve_and_chill_estimates_the_riser_with_the_sand_behind_its_sleeve(self):
        text = self.done("new", str(SOURCES / "tests/parts/bearing_block.step"), "--alloy", "tin_bronze", "--fineness", "0.7", "-o", "case")
        case = tomllib.loads((self.folder / "case/case.toml").read_text())
        roles = {body.get("group", body["name"]): body["role"] for body in case["body"]}
        self.assertEqual(roles, {"bearing_block": "casting", "riser": "riser", "sleeve": "sleeve", "chill": "chill", "mould": "mould"})
        # The riser is the highest of all: the sand is open over it.
        self.assertEqual(case["mesh"]["mould"]["walls"][5], "0 mm")
        self.assertIn("open at the top, where the metal ends", text)
        # By heat alone the riser is solid after 675 s.
        estimate = float(re.search(r"freezes +in about ([\d.e+]+) s", text)[1])
        self.assertTrue(340 < estimate < 1350, text)
        self.assertIn("(metal_on_chill: 1000 to 25000 W/m2/K)", self.done("check", "case", "--heat-only"))

    def test_bodies_that_nothing_tells_apart_are_named_and_what_is_said_of_them_counts(self):
        self.write("pump.stl", stl("first", box((0, 0, 0), (40, 40, 40))) + stl("second", box((60, 0, 0), (80, 20, 20))))
        text, case = self.new("pump.stl", "--fineness", "0.5")
        self.assertEqual([body["role"] for body in case["body"]], ["casting", "casting", "mould"])
        self.assertIn("no name says what these are, so they are poured: first, second; else, for example: --as second=core", text)
        self.assertRegex(text, r"freezes +in about \d+ s .* at \d+ s at the latest")  # no 1.4e+02
        text = self.done("new", "pump.stl", *ALLOY, "--fineness", "0.5", "--as", "second=core", "-o", "said")
        self.assertNotIn("no name says", text)

    def test_a_casting_that_others_enclose_does_not_stretch_the_estimate(self):
        def cell(i, j, k, plug):
            if not (2 <= i < 8 and 2 <= j < 8 and 2 <= k < 6):
                return "mould"
            return plug if 4 <= i < 6 and 4 <= j < 6 and k >= 3 else "casting"
        times = []
        for plug in ("casting", "plug"):
            self.write("block.msh", grid((10, 10, 8), 0.01, lambda i, j, k: cell(i, j, k, plug)))
            text = self.done("new", "block.msh", *ALLOY, "--unit", "m", "-o", plug)
            times.append(float(re.search(r"freezes +in about ([\d.e+]+) s", text)[1]))
        self.assertLess(times[1], 2.5 * times[0])

    def test_skins_that_cross_each_other_are_united_and_freeze_as_one(self):
        self.write("plate.stl", stl("plate", box((0, 0, 0), (60, 40, 10)) + box((20, 10, 5), (40, 30, 30))))
        text, case = self.new("plate.stl", "--fineness", "0.5")
        self.assertIn("2 closed skins that cross or touch each other", text)
        self.assertIn("in common", text)
        self.assertEqual([b["name"] for b in case["body"]], ["plate", "mould"])
        self.assertIn("32 cm3", text)  # 24 of the plate, 10 of the boss, less the 2 that they share

    def test_a_unit_that_is_none_is_the_users_mistake(self):
        self.write("block.stl", stl("block", box((0, 0, 0), (80, 50, 20))))
        self.assertIn("--unit: 'foo' is no unit of length", self.refusal("block.stl", "--unit", "foo"))

    def test_what_stl_files_cannot_is_said(self):
        closed = box((0, 0, 0), (60, 40, 40))
        self.write("open.stl", stl("open", closed[:-1]))
        self.assertIn("the skin is not closed: 3 edges belong to one triangle alone", self.refusal("open.stl"))
        self.write("part.stl", stl("part", closed))
        self.assertIn("a riser can be joined to solids of a CAD program only", self.refusal("part.stl", "--riser", "auto"))
        self.assertIn("only solids of a CAD program can be cut", self.refusal("part.stl", "--symmetry", "y"))
        self.assertIn("there is no such file", self.refusal("absent.stl"))

    def test_of_a_mesh_with_its_mould_takes_the_elements_as_they_are(self):
        inside = lambda i, j, k: all(2 <= n < 4 for n in (i, j, k))
        self.write("whole.msh", grid((6, 6, 6), 10, lambda i, j, k: "bell" if inside(i, j, k) else "sand"))
        text, case = self.new("whole.msh")
        self.assertNotIn("size", case["mesh"])
        self.assertEqual({body["name"]: body["role"] for body in case["body"]}, {"bell": "casting", "sand": "mould"})
        self.assertIn("elements as the file has them", text)

    def test_of_a_mesh_of_the_casting_alone_puts_a_mould_around(self):
        self.write("bell.msh", grid((3, 2, 2), 10, lambda i, j, k: "bell"))
        text, case = self.new("bell.msh", "--fineness", "0.5")
        self.assertEqual({body["name"]: body["role"] for body in case["body"]}, {"bell": "casting", "mould": "mould"})
        self.assertIn("casting     bell of aluminium_alsi7mg", text)
        self.assertNotIn("--unit", text)
        self.write("two.msh", grid((2, 1, 1), 10, lambda i, j, k: f"part_{i}"))
        self.assertIn("bodies touch there", self.refusal("two.msh"))


if __name__ == "__main__":
    unittest.main()
