"""plots.toml: what it may say, what it is told when it is wrong, and that pictures come out."""

from pathlib import Path
import tempfile
import unittest
import warnings

from matplotlib import image
import matplotlib.pyplot as plt
import numpy as np

from blocks import box
from solidus_plots import columns, sections, style, surfaces
from solidus_plots.cells import HEX, TET
from solidus_plots.moments import Moments
from solidus_plots.plots_file import read_spec
from solidus_plots.vtu import ResultError

SIZE = [0.06, 0.04, 0.03]


class Run(Moments):
    """Moments without files: a block that warms and moves, in two bodies that share nodes."""

    def __init__(self, kind):
        super().__init__(np.array([0.0, 3600.0, 7200.0]), ["", "", ""], ["part", "sand"],
                         {"T_1": np.array([0.02, 0.02, 0.015]), "T_2": np.array([0.05, 0.02, 0.0])})
        for index, time in enumerate(self._times):
            grid = box(kind, SIZE, (4, 3, 2), bodies=2)
            grid.time = time
            grid.point_data = {"temperature": 300.0 + time * grid.points[:, 0],
                               "displacement": 0.02 * grid.points}
            grid.cell_data["von_mises"] = 1e6 * np.arange(len(grid.cell_types), dtype=float)
            grid.cell_data["stress"] = np.tile(np.linspace(-1e6, 1e6, len(grid.cell_types))[:, None], 6)
            grid.units = {"temperature": "K", "displacement": "m", "von_mises": "Pa", "stress": "Pa"}
            self._grids[index] = grid


class Font(unittest.TestCase):
    def test_labels_of_columns_are_drawn_without_missing_characters(self):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("error")
            labels = [row["label"] for rows in columns._TABLES.values() for row in rows]
            self.assertIn("𝓛, tolerance", labels)
            figure, axes = plt.subplots()
            for label in labels:
                axes.plot([0, 1], label=label)
            axes.legend()
            self.assertEqual([file.name for file in style.save(figure, Path(folder), "labels", vector=False)], ["labels.png"])


class Wrong(unittest.TestCase):
    def message(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "plots.toml"
            file.write_text(text)
            spec, mistakes = read_spec(file)
        self.assertEqual([picture for pictures in spec.values() for picture in pictures], [])
        self.assertEqual(len(mistakes), 1)
        return mistakes[0]

    def test_unknown_keys_are_answered_with_those_that_there_are(self):
        text = self.message('[[sections]]\nfile = "a"\nfield = "temperature"\nplains = [{ z = 0 }]')
        self.assertIn("unknown key 'plains' in [[sections]]", text)
        self.assertIn("planes", text)

    def test_a_section_without_planes_is_told_so(self):
        self.assertIn("lacks its 'planes'", self.message('[[sections]]\nfile = "a"\nfield = "temperature"'))

    def test_keys_that_would_change_nothing_are_refused(self):
        text = self.message('[[surfaces]]\nfile = "a"\nfield = "temperature"\nclip_bodies = ["sand"]')
        self.assertIn("'clip_bodies' needs 'clip'", text)
        self.assertIn("'range' needs 'field'", self.message('[[surfaces]]\nfile = "a"\nrange = [0, 1]'))

    def test_values_of_the_wrong_kind_are_told_what_they_must_be(self):
        for line, text in (('view = [30]', "'view' must be two numbers, not [30]"),
                           ('times = "last"', "'times' must be a list of moments"),
                           ('times = [""]', "'times' must be a list of moments"),
                           ('bodies = "part"', "'bodies' must be a list of texts"),
                           ('range = [0, "a"]', "'range' must be two numbers"),
                           ('smooth = 1', "'smooth' must be true or false"),
                           ('bands = 2.5', "'bands' must be a whole number"),
                           ('levels = [3]', "'levels' must be a list of { value")):
            with self.subTest(line=line):
                self.assertIn(text, self.message(f'[[surfaces]]\nfile = "a"\nfield = "b"\n{line}'))

    def test_a_plane_is_one_axis_or_a_normal_and_a_point(self):
        for entry in ({}, {"w": 0}, {"z": "middle"}, {"z": 0, "y": 0}, {"normal": [0, 0, 1]},
                      {"normal": [0, 0, 0], "through": [0, 0, 0]}, {"normal": [0, 1], "through": [0, 0, 0]}):
            with self.subTest(entry=entry), self.assertRaisesRegex(ResultError, "is no plane"):
                sections.read_plane(entry)

    def test_pictures_that_cannot_be_drawn_say_why(self):
        run, spec = Run(HEX), {"file": "a", "field": "temperature", "planes": [{"z": 15}]}
        for wrong, text in (({"planes": [{"z": 31}]}, "z = 31 mm does not meet the bodies"),
                            ({"bodies": ["mould"]}, "no body mould; there are part, sand"),
                            ({"field": "niyama"}, "no field 'niyama' was written; there are temperature"),
                            ({"times": [5.0]}, "none of the moments"),
                            ({"probes": ["S_*"]}, "no probe 'S_\\*' at a point; there are T_1, T_2"),
                            ({"colours": "rainbows"}, "no colours 'rainbows'"),
                            ({"field": "stress", "component": 6}, "components 0 to 5"),
                            ({"unit": "MPa"}, "cannot show")):
            with self.subTest(wrong=wrong), self.assertRaisesRegex((ResultError, ValueError), text):
                sections.draw({**spec, **wrong}, run, Path("."))
        for wrong, text in (({"edges": "all"}, '"features", "mesh" or "none"'),
                            ({"clip": {"field": "temperature"}}, "is no clip"),
                            ({"clip": {"field": "von_mises", "above": 1}}, "one of nodes"),
                            ({"up": "w"}, 'up is "x", "y" or "z"'), ({"plain": ["mould"]}, "no body mould")):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(ResultError, text):
                surfaces.draw({"file": "a", **wrong}, run, Path("."))


class Drawn(unittest.TestCase):
    def setUp(self):
        style.setup()
        style.plt.rcParams["savefig.dpi"] = 60
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)

    def pixels(self, work, spec, kind=HEX):
        file, = work({"file": "a", **spec}, Run(kind), Path(self._folder.name))
        return image.imread(file)[..., :3]

    def test_sections_at_several_moments_are_drawn_in_the_colours_of_the_field(self):
        oblique = {"normal": [1, 1, 0], "through": [30, 20, 15]}
        for spec in ({"field": "temperature", "unit": "degC", "planes": [{"z": 15}, {"y": 0}],
                      "magnification": 5, "times": [0, "last"], "levels": [{"value": 100, "label": "liquidus"}]},
                     {"field": "von_mises", "unit": "MPa", "planes": [oblique], "bands": 5, "mesh": True,
                      "times": ["first", 3600, 7200]},
                     {"field": "von_mises", "planes": [{"z": 15}], "smooth": True, "probes": ["T_*"]}):
            found = self.pixels(sections.draw, spec)
            self.assertGreater((np.ptp(found, axis=2) > 0.2).mean(), 0.1)

    def test_a_body_left_out_is_not_drawn(self):
        spec = {"field": "temperature", "planes": [{"x": 50}]}
        with self.assertRaisesRegex(ResultError, "does not meet"):
            self.pixels(sections.draw, {**spec, "bodies": ["part"]})
        self.pixels(sections.draw, {**spec, "bodies": ["sand"]})

    def test_a_body_that_has_left_is_not_drawn_any_more(self):
        run = Run(HEX)
        last = run.at("last")
        there = last.cell_data["body"] == 0
        for name in ("cell_types", "offsets"):
            setattr(last, name, getattr(last, name)[:there.sum()])
        last.connectivity = last.connectivity.reshape(-1, 8)[there].ravel()
        last.cell_data = {name: values[there] for name, values in last.cell_data.items()}
        for work, spec in ((sections.draw, {"planes": [{"z": 15}]}), (surfaces.draw, {"clip": {"z": 15}})):
            shares = []
            for times in (["first", "first"], ["first", "last"]):
                file, = work({"file": "a", "field": "von_mises", "range": [-1, 1], "colours": "Reds", "columns": 2,
                              "bodies": ["sand"], "times": times, **spec}, run, Path(self._folder.name))
                picture = image.imread(file)[..., :3]
                panels = picture[:, :int(0.85 * picture.shape[1])]  # the colour bar is at the right
                shares.append((np.ptp(panels, axis=2) > 0.2).mean())
            self.assertAlmostEqual(shares[1] / shares[0], 0.5, delta=0.05)

    def test_where_a_field_has_no_value_it_is_grey(self):
        spec = {"field": "von_mises", "unit": "MPa", "planes": [{"z": 10}], "colours": "inferno"}
        found = self.pixels(sections.draw, {**spec, "above": 20})
        grey = (np.abs(found - style.NO_VALUE).max(axis=2) < 0.01).mean()
        self.assertGreater(grey, 0.1)  # the panel is a third of the figure, and 21 of 24 elements have none
        with self.assertRaisesRegex(ResultError, "no value above 30"):
            self.pixels(sections.draw, {**spec, "above": 30})

    def test_surfaces_are_drawn_with_and_without_a_field(self):
        coloured = self.pixels(surfaces.draw, {"field": "temperature", "plain": ["sand"], "clip": {"y": 20},
                                               "clip_bodies": ["sand"], "levels": [{"value": 400}]}, TET)
        self.assertGreater((np.ptp(coloured, axis=2) > 0.4).mean(), 0.05)
        self.pixels(surfaces.draw, {"field": "temperature", "ghost": ["part", "sand"], "bodies": ["sand"],
                                    "clip": {"field": "temperature", "above": 400}, "times": [0, "last"]}, TET)
        grey = self.pixels(surfaces.draw, {"edges": "mesh", "dimensions": True, "probes": ["T_2"],
                                           "up": "y", "view": [20, 30]})
        self.assertLess((np.ptp(grey, axis=2) > 0.4).mean(), 0.001)


if __name__ == "__main__":
    unittest.main()
