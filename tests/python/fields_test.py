"""Fields are declared once: no list of their names is left in the sources, in Python and in the page."""

import json
from pathlib import Path
import re
import unittest

import numpy as np

from solidus_plots import fields, style

ROOT = Path(__file__).resolve().parents[2]
NAMES = [row["name"] for row in json.loads((ROOT / "python/solidus_plots/fields.json").read_text(encoding="utf-8"))["fields"]]
# Where the same words mean something else than a field.
OTHERS = {
    "cases/": "keys of a case", "material/": "keys and columns of material cards", "input/": "arguments of tables",
    "point/": "columns of the tables of a material point", "python/": "members of Python's dictionaries",
    "results/tables/step_columns.cpp": "columns of history.csv", "results/tables/pool_table.cpp": "columns of pools.csv",
    "results/checkpoint/checkpoint": "arrays of a checkpoint", "results/answers/answers_json.cpp": "members of summary.json",
    "results/formats/temperature_history.cpp": "data of a structural deck", "app/material_tables.cpp": "columns of material tables",
    "setup/friction_input.cpp": "keys of friction", "criteria/strain_criteria.cpp": "the name of its record", "contact/laws/": "keys of laws", "check/uncertain_parameters.cpp": "keys of a case",
    "coupling/add_scheme.hpp": "words of a key", "linear/": "names of blocks", "setup/field_mapping.cpp": "the field of another run",
    "check/findings/partly_in_contact.cpp": "a word of a key", "run/filling_input.cpp": "members of what a flow is asked",
    "setup/case_checks.cpp": "keys of a filling", "criteria/life_quantities.hpp": "rows of fields, apart from the others", "criteria/kinds/": "rows of fields in the file of their criterion", "criteria/die_quantities.hpp": "rows of fields of dies",
}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
QUOTED = re.compile(r"""["'`]([a-z_0-9]+)["'`]""")
# Texts with nothing but commas, colons and brackets between them are members of one list.
BETWEEN = re.compile(r"^[\s,\[\](){}]*$")


def lists_of_names(text):
    """Pairs of names of fields that are next to each other in a list."""
    found = [match for match in QUOTED.finditer(text) if match[1] in NAMES]
    return [(a[1], b[1]) for a, b in zip(found, found[1:]) if "," in text[a.end():b.start()] and BETWEEN.match(text[a.end():b.start()])]


class OneRow(unittest.TestCase):
    def test_no_source_names_a_field_but_by_its_declaration(self):
        for file in sorted((ROOT / "src").rglob("*.[ch]pp")):
            path = file.relative_to(ROOT / "src").as_posix()
            if path.endswith("/quantities.hpp") or path.startswith(tuple(OTHERS)):
                continue
            literals = set(QUOTED.findall(COMMENT.sub("", file.read_text(encoding="utf-8"))))
            self.assertEqual(literals & set(NAMES), set(), path)

    def test_every_place_with_other_meanings_of_the_words_is_there(self):
        paths = [file.relative_to(ROOT / "src").as_posix() for file in (ROOT / "src").rglob("*.[ch]pp")]
        for place in OTHERS:
            self.assertTrue(any(path.startswith(place) for path in paths), place)

    def test_a_list_is_found(self):
        self.assertEqual(lists_of_names('x = {"niyama", ("von_mises")}'), [("niyama", "von_mises")])
        self.assertEqual(lists_of_names('draw("niyama"); find("von_mises")'), [])

    def test_neither_the_page_nor_the_pictures_have_a_list_of_names(self):
        files = [file for folder in ("web/report/src", "web/workbench/src", "python") for suffix in ("ts", "py")
                 for file in sorted((ROOT / folder).rglob(f"*.{suffix}"))]
        self.assertGreater(len(files), 100)
        own_tables = {"point.py", "constitutive.py", "fitting.py"}  # columns of a material point, arguments of a law
        keys = re.compile(rf"^\s*[\"']?({'|'.join(name for name in NAMES if '_' in name and name != 'solid_fraction')})[\"']?\s*:", re.MULTILINE)
        for file in files:
            if file.name in own_tables:
                continue
            with self.subTest(file=file.name):
                text = file.read_text(encoding="utf-8")
                self.assertEqual(lists_of_names(text), [])
                self.assertEqual(keys.findall(text), [])


class Pictures(unittest.TestCase):
    ROW = {"name": "tearing", "unit": "1/s", "label": "Tearing", "group": "criteria", "rank": "scalar", "place": "node",
           "no_value": -1.0, "written": "always", "worst": "least", "answer": "least tearing", "colours": "sequential",
           "compared": True, "pictured": True, "shown": {"unit": "1/ms", "text": "1/ms", "factor": 1e-3, "offset": 0.0}}

    def tearDown(self):
        fields._known.pop("tearing", None)

    def test_a_field_that_only_the_run_declares_has_label_unit_and_answer(self):
        self.assertEqual(fields.label("tearing"), "Tearing")  # as any unknown name reads
        self.assertIsNone(fields.find("tearing"))
        fields.declare({"fields": {"tearing": self.ROW}})
        field = fields.find("tearing")
        self.assertEqual(field.finding, "tearing_min[1/s]")
        np.testing.assert_equal(field.with_value(np.array([-1.0, 0.0, 2.0])), [np.nan, 0.0, 2.0])
        self.assertEqual(style.convert(2000.0, "1/s", "1/ms"), 2.0)

    def test_niyama_is_shown_in_the_unit_of_its_declaration(self):
        field = fields.find("niyama")
        self.assertEqual((fields.unit("niyama", "1"), field.shown, field.no_value), ("K0.5 s0.5/m", "K0.5 s0.5/mm", 0.0))
        self.assertEqual(style.convert(1000.0, "K0.5 s0.5/m", "K0.5 s0.5/mm"), 1.0)

    def test_colours_are_those_of_the_declaration(self):
        self.assertEqual(fields.colour_map("temperature", None, 300, 900), "inferno")
        self.assertEqual(fields.colour_map("pressure", None, -1, 1), "RdBu_r")
        self.assertEqual(fields.colour_map("von_mises", None, 0, 1), "viridis")
        self.assertEqual(fields.colour_map("displacement", "x", -1, 1), "RdBu_r")


if __name__ == "__main__":
    unittest.main()
