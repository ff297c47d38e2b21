"""All pictures of a results folder, as ./dev run and ./dev plot draw them."""

import json
from pathlib import Path
import tempfile
import unittest
import unittest.mock

from field_files import write
from solidus_plots import curves, plot_case
from solidus_plots.moments import Moments
from solidus_plots.plot_case import draw


class Folders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        write(self.folder / "a.vtu", [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]],
              [1, 2, 3, 4], [300.0, 310, 320, 330])
        (self.folder / "fields.pvd").write_text(
            '<VTKFile><Collection><DataSet timestep="12.5" part="0" file="a.vtu"/></Collection></VTKFile>')
        (self.folder / "history.csv").write_text("time[s],T_a[degC]\n0,20\n12.5,30\n")
        summary = {"variant": "default", "mesh": {"bodies": {"part": 2}}}
        (self.folder / "summary.json").write_text(json.dumps(summary))

    def drawn(self, plots):
        file = self.folder / "plots.toml"
        file.write_text(plots)
        files, problems = draw(self.folder, file)
        self.assertTrue(all(path.exists() for path in files))
        return {path.name for path in files}, problems

    def test_pictures_that_can_be_drawn_are_drawn_and_the_others_named(self):
        names, problems = self.drawn('''
            [[maps]]
            file = "map"
            field = "temperature"
            times = [12.5, 20]
            [[sections]]
            file = "section"
            field = "temperature"
            planes = [{ z = 1 }]
            [[curves]]
            file = "curve"
            lines = [{ column = "T_b[degC]" }]''')
        self.assertLessEqual({"map.png", "history_degC.png"}, names)
        self.assertNotIn("section.png", names)
        for text in ("no fields were written at 20 s", "does not meet the bodies", "T_b[degC]"):
            self.assertTrue(any(text in problem for problem in problems), (text, problems))

    def test_a_moment_is_asked_for_by_the_name_of_the_stage_that_ends_there(self):
        summary = {"variant": "default", "mesh": {"bodies": {"part": 2}}, "answers": {"stages": [{"name": "quench", "end[s]": 12.5}]}}
        (self.folder / "summary.json").write_text(json.dumps(summary))
        names, problems = self.drawn('[[maps]]\nfile = "map"\nfield = "temperature"\ntimes = ["quench", "ageing"]\n')
        self.assertIn("map.png", names)
        self.assertEqual(problems, ["plots.toml: 'ageing' is no moment and no stage that is over; these are quench"])
        run = Moments([12.5], [None], [], stages={"quench": 12.5})
        self.assertEqual([run.heading(12.5), run.heading(3.0)], ["end of 'quench', 12.5 s", "3 s"])

    def test_without_semaphores_pictures_are_drawn_one_after_the_other(self):
        with unittest.mock.patch.object(plot_case, "ProcessPoolExecutor", side_effect=PermissionError(13, "Permission denied")):
            names, problems = self.drawn('[[maps]]\nfile = "map"\nfield = "temperature"\ntimes = [12.5]\n')
        self.assertIn("map.png", names)
        self.assertEqual(problems, [])

    def test_a_mistake_in_plots_toml_costs_the_picture_that_has_it(self):
        names, problems = self.drawn('''
            [[map]]
            file = "misspelt"
            [[maps]]
            file = "wrong"
            field = "temperature"
            times = "last"
            [[maps]]
            file = "right"
            field = "temperature"
            [automatic]
            niyama = "low"''')
        self.assertIn("right.png", names)
        self.assertIn("overview_temperature.png", names)
        self.assertFalse({"misspelt.png", "wrong.png"} & names)
        for text in ("unknown section 'map'", "'times' must be a list of moments", "'niyama' must be a number"):
            self.assertTrue(any(text in problem for problem in problems), (text, problems))
        names, problems = self.drawn("[[maps]\n")
        self.assertIn("overview_temperature.png", names)
        self.assertIn("plots.toml", problems[0])

    def test_curves_end_where_they_are_told_to(self):
        (self.folder / "history.csv").write_text("time[s],T_a[degC]\n0,20\n12.5,30\n100,30\n")
        for until, last in (("", 100.0), ("until = 50\n", 12.5)):
            with unittest.mock.patch.object(curves.style, "save", side_effect=self.keep):
                self.drawn(f'[[curves]]\nfile = "curve"\nlines = [{{ column = "T_a[degC]" }}]\n{until}')
            self.assertEqual(self.kept["curve"], last)
        _, problems = self.drawn('[[curves]]\nfile = "curve"\nlines = [{ column = "T_a[degC]" }]\nuntil = "end"')
        self.assertTrue(any("'until' must be a number" in problem for problem in problems), problems)

    def keep(self, figure, folder, name, **_):
        """Notes the last moment of a figure's first line in place of writing it."""
        self.kept = getattr(self, "kept", {}) | {name: figure.axes[0].get_lines()[0].get_xdata()[-1]}
        curves.plt.close(figure)
        return []

    def test_the_pictures_that_every_run_gets_can_be_left_out(self):
        names, problems = self.drawn("[automatic]\ndraw = false")
        self.assertFalse([name for name in names if name.startswith("overview")])
        self.assertEqual(problems, [])

    def test_pictures_of_other_variants_are_left_out(self):
        names, problems = self.drawn('''
            [[maps]]
            file = "map"
            only = ["fine"]
            field = "temperature"''')
        self.assertNotIn("map.png", names)
        self.assertEqual(problems, [])


if __name__ == "__main__":
    unittest.main()
