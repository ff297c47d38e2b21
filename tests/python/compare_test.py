"""Fields brought from one mesh to another, studies as files, ranks."""

from pathlib import Path
import tempfile
import unittest

from blocks import box, everything
import numpy as np

from solidus_plots.cells import HEX, TET, TET_2
from solidus_plots.compare import as_text
from solidus_plots.mapping import Mapper, same_mesh
from solidus_plots.study_file import read_study
from solidus_plots.study_plots import rank_correlation
from solidus_plots.vtu import ResultError, read_fields
from solidus_plots.vtu_writer import write_grid

SIZE = (0.04, 0.02, 0.02)


def linear(points):
    return 300.0 + points @ [1e3, -2e3, 5e2]


class Mapping(unittest.TestCase):
    def test_a_linear_field_is_the_same_on_every_mesh(self):
        target = box(TET, SIZE, (7, 5, 3))
        for kind in (TET, HEX, TET_2):
            source = box(kind, SIZE, (4, 3, 2))
            found = Mapper(source, everything(source)).at(target.points)
            self.assertTrue(found.inside.all())
            np.testing.assert_allclose(found.of(linear(source.points)), linear(target.points), atol=1e-9)
            vectors = found.of(np.stack([linear(source.points)] * 3, axis=1))
            np.testing.assert_allclose(vectors[:, 2], linear(target.points), atol=1e-9)

    def test_places_that_the_other_body_does_not_have_have_no_value(self):
        source = box(TET, SIZE, (4, 3, 2))
        found = Mapper(source, everything(source)).at(np.array([[0.0401, 0.01, 0.01], [0.05, 0.01, 0.01], [0.02, 0.5, 0]]))
        self.assertEqual(found.inside.tolist(), [True, False, False])  # just outside: a curved skin that is cut straight
        values = found.of(linear(source.points))
        self.assertAlmostEqual(values[0], 300 + 40.1 - 20 + 5, places=6)
        self.assertTrue(np.isnan(values[1:]).all())

    def test_meshes_are_the_same_by_nodes_and_cells(self):
        one, other, moved = box(TET, SIZE, (2, 2, 2)), box(TET, SIZE, (2, 2, 2)), box(TET, SIZE, (2, 2, 2))
        moved.points = moved.points + 1e-6
        self.assertTrue(same_mesh(one, other))
        self.assertFalse(same_mesh(one, moved))
        self.assertFalse(same_mesh(one, box(HEX, SIZE, (2, 2, 2))))

    def test_what_is_written_for_paraview_is_read_back(self):
        grid = box(HEX, SIZE, (2, 1, 1))
        grid.point_data, grid.units, grid.time = {"temperature": linear(grid.points)}, {"temperature": "K"}, 12.5
        with tempfile.TemporaryDirectory() as folder:
            write_grid(Path(folder) / "a.vtu", grid)
            read = read_fields(Path(folder) / "a.vtu")
            np.testing.assert_array_equal(read.point_data["temperature"], grid.point_data["temperature"])
            np.testing.assert_array_equal(read.connectivity, grid.connectivity)
            self.assertEqual((read.time, read.units["temperature"]), (12.5, "K"))


class Tables(unittest.TestCase):
    def test_the_unit_of_niyama_is_printed_as_a_run_prints_it(self):
        text = as_text(["answer", "A"], [["least Niyama[K0.5 s0.5/mm]", 0.5], ["steps[1]", None]])
        self.assertEqual(text.splitlines()[1:], ["  least Niyama[sqrt(K s)/mm]  0.5", "  steps[1]                      -"])


class Studies(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "study.toml"
            file.write_text('case = "case.toml"\n' + text)
            return read_study(file)

    def test_a_grid_has_every_combination_in_the_units_of_the_file(self):
        study = self.read('[[parameter]]\nkey = "a"\nfrom = 1\nto = 100\nunit = "mm"\nsteps = 3\nscale = "logarithmic"\n'
                          '[[parameter]]\nkey = "b"\nvalues = ["x", 2]\n')
        self.assertEqual(study.runs, [["1 mm", "x"], ["1 mm", 2], ["10 mm", "x"], ["10 mm", 2], ["100 mm", "x"],
                                      ["100 mm", 2]])

    def test_a_latin_hypercube_meets_every_part_of_every_range_once(self):
        text = 'method = "latin_hypercube"\nsamples = 16\nseed = 3\n[[parameter]]\nkey = "a"\nfrom = 0\nto = 16\n' \
               '[[parameter]]\nkey = "b"\nfrom = 1\nto = 10\nscale = "logarithmic"\n'
        study = self.read(text)
        for column, part in ((0, lambda v: v), (1, lambda v: 16 * np.log10(v))):
            self.assertEqual(sorted(int(part(run[column])) for run in study.runs), list(range(16)))
        self.assertEqual(study.runs, self.read(text).runs)
        self.assertNotEqual(study.runs, self.read(text.replace("seed = 3", "seed = 4")).runs)

    def test_mistakes_say_what_is_allowed(self):
        for text, said in (('metod = "grid"', "unknown key 'metod'"), ("", "nothing would differ"),
                           ('method = "random"\n[[parameter]]\nkey = "a"\nvalues = [1]', "'method' is one of grid"),
                           ('samples = 3\n[[parameter]]\nkey = "a"\nvalues = [1]', 'belongs to method = "latin_hypercube"'),
                           ('[[parameter]]\nkey = "a"\nfrom = 3\nto = 1', "the first one smaller"),
                           ('[[parameter]]\nkey = "a"\nfrom = 0\nto = 1\nscale = "logarithmic"', "begins above zero"),
                           ('limit = "10"\n[[parameter]]\nkey = "a"\nvalues = [1]', 'a time such as "10 min"')):
            with self.subTest(text=text), self.assertRaisesRegex(ResultError, said):
                self.read(text)

    def test_ranks_follow_any_rise_and_share_equal_values(self):
        self.assertAlmostEqual(rank_correlation(np.array([1, 2, 3, 4]), np.array([1, 10, 100, 1000])), 1)
        self.assertAlmostEqual(rank_correlation(np.array([1, 2, 3]), np.array([3, 2, 1])), -1)
        self.assertAlmostEqual(rank_correlation(np.array([1, 2, 3, 4]), np.array([1, 1, 2, 2])), 0.894427191)
        self.assertTrue(np.isnan(rank_correlation(np.array([1, 1, 1]), np.array([1, 2, 3]))))


if __name__ == "__main__":
    unittest.main()
