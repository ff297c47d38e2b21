"""The table of the verification's pictures, and how they are drawn from the tables of the tests."""

from pathlib import Path
import re
import tempfile
import unittest

import numpy as np

from solidus_plots.style import plt
from solidus_plots.verification import Tables, draw, draw_lines, draw_order, read_pictures

PAGES = Path(__file__).resolve().parents[2] / "docs/verification"


class List(unittest.TestCase):
    def test_every_picture_is_on_a_page_and_every_page_has_its_pictures(self):
        linked = set()
        for page in PAGES.glob("*.md"):
            linked.update(re.findall(r"\(images/(\w+)\.png\)", page.read_text()))
        self.assertEqual({picture["name"] for picture in read_pictures()} - linked, set())
        self.assertEqual({path.stem for path in (PAGES / "images").glob("*.png")}, linked)

    def test_a_key_or_kind_that_means_nothing_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "pictures.toml"
            for text, problem in (('titel = "a"', "titel"), ('kind = "pie"', "pie"),
                                  ('title = "a"\nx = "b"', "needs y")):
                file.write_text(f"[a]\n{text}\n")
                with self.assertRaisesRegex(ValueError, problem):
                    read_pictures(file)


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "a.csv").write_text("kind,step[s],T[K],u: x,exact_T[K]\n"
                                           "slow,1,2,30,1\nslow,0.5,0.5,20,2\nfast,0.25,7,10,3\n")
        (self.folder / "b.csv").write_text("step[s],T[K]\n1,4\n2,5\n")
        self.tables = Tables(self.folder)
        _, self.axes = plt.subplots()
        self.addCleanup(plt.close, "all")

    def lines(self, picture):
        draw_lines(self.axes, {"name": "a", "x_column": "step"} | picture, self.tables)
        return {line.get_label(): line for line in self.axes.lines}

    def test_columns_come_from_this_table_or_another_all_rows_or_some(self):
        for column, values in (("T", [2, 0.5, 7]), ("u: x", [30, 20, 10]), ("b:T", [4, 5]),
                               ("T where kind = slow", [2, 0.5])):
            np.testing.assert_array_equal(self.tables.values("a", "step", column)[1], values)

    def test_a_closed_form_is_a_line_in_the_colour_of_what_is_computed(self):
        drawn = self.lines({"curves": [["T", "computed", "exact_T"]]})
        computed = drawn.pop("computed")
        exact, = drawn.values()
        self.assertEqual(computed.get_color(), exact.get_color())
        self.assertEqual((computed.get_linestyle(), exact.get_linestyle()), ("None", "-"))

    def test_values_are_scaled_and_raised_as_the_table_says(self):
        drawn = self.lines({"curves": [["T", "T"]], "relative": True, "factor": 8, "powers": {"x": -1}})
        np.testing.assert_allclose(drawn["T"].get_ydata(), [8, 2, 28])
        np.testing.assert_allclose(drawn["T"].get_xdata(), [0.1, 10**-0.5, 10**-0.25])

    def test_the_order_is_that_of_the_last_two_points(self):
        draw_order(self.axes, {"name": "a", "x_column": "step", "curves": [["T where kind = slow", "T"]]}, self.tables)
        self.assertEqual(self.axes.lines[0].get_label(), "T: 2.00")

    def test_a_table_that_is_not_whole_is_named(self):
        (self.folder / "c.csv").write_text("step[s],T[K]\n")
        picture = {"name": "c", "title": "c", "x": "x", "y": "y", "curves": [["T", "T"]]}
        with self.assertRaisesRegex(ValueError, "c.csv"):
            draw(picture, self.tables, self.folder)


if __name__ == "__main__":
    unittest.main()
