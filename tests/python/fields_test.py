"""Fields are declared once: no list of their names is left in the sources, in Python and in the page."""

import json
from pathlib import Path
import re
import unittest

import numpy as np

from solidus_plots import columns, fields, style

ROOT = Path(__file__).resolve().parents[2]
NAMES = [row["name"] for row in json.loads((ROOT / "python/solidus_plots/fields.json").read_text(encoding="utf-8"))["fields"]]
# Where the same words mean something else than a field.
OTHERS = {
    "cases/": "keys of a case", "material/": "keys and columns of material cards", "input/": "arguments of tables",
    "point/": "columns of the tables of a material point", "python/": "members of Python's dictionaries",
    "coupling/columns.hpp": "columns of tables", "coupling/step_columns.cpp": "columns of tables", "coupling/history_columns.cpp": "columns of tables",
    "criteria/columns.cpp": "columns of pools.csv", "results/answers/answer_rows.hpp": "answers of summary.json",
    "results/checkpoint/checkpoint": "arrays of a checkpoint", "results/answers/answers_json.cpp": "members of summary.json",
    "results/formats/temperature_history.cpp": "data of a structural deck", "app/material_tables.cpp": "columns of material tables",
    "setup/friction_input.cpp": "keys of friction", "criteria/strain_criteria.cpp": "the name of its record", "contact/laws/": "keys of laws", "check/uncertain_parameters.cpp": "keys of a case",
    "coupling/add_scheme.hpp": "words of a key", "linear/": "names of blocks", "setup/field_mapping.cpp": "the field of another run",
    "check/findings/partly_in_contact.cpp": "a word of a key", "run/filling_input.cpp": "members of what a flow is asked",
    "setup/case_checks.cpp": "keys of a filling", "criteria/life_quantities.hpp": "rows of fields, apart from the others", "criteria/kinds/": "rows of fields in the file of their criterion", "criteria/die_quantities.hpp": "rows of fields of dies",
}
DECLARED = json.loads((ROOT / "python/solidus_plots/tables.json").read_text(encoding="utf-8"))
# Words of one part, "work" or "gas", mean many things; names that begin with "_" are those of contacts and channels.
COLUMNS = sorted({row["name"] for rows in [*DECLARED["tables"].values(), DECLARED["answers"]] for row in rows if "_" in row["name"]} - set(NAMES))
# The files that declare them, and those where the same words mean something else.
DECLARING = ("coupling/columns.hpp", "coupling/step_columns.cpp", "coupling/history_columns.cpp", "coupling/contact_columns.cpp",
             "coupling/shot_columns.cpp", "heat/columns.hpp", "heat/channel_columns.cpp", "criteria/columns.cpp", "results/answers/answer_rows.hpp",
             "results/answers/stage_table.cpp")
OTHER_COLUMNS = {
    "cases/time_keys.cpp": "keys of a case", "cases/physics_switch.cpp": "keys of a case", "setup/time_input.cpp": "keys of a case",
    "point/record.cpp": "columns of the tables of a material point", "python/": "members of Python's dictionaries",
    "results/recorder.cpp": "seconds of summary.json",
}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
HEADER = re.compile(r"""["'`]([a-zA-Z_0-9]+)(?:\[[^\]"'`]*\])?["'`]""")  # with its unit or without
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


class Columns(unittest.TestCase):
    def test_no_source_names_a_column_but_by_its_declaration(self):
        self.assertGreater(len(COLUMNS), 60)
        for file in sorted((ROOT / "src").rglob("*.[ch]pp")):
            path = file.relative_to(ROOT / "src").as_posix()
            if path in DECLARING or path.startswith(tuple(OTHER_COLUMNS)) or path.endswith("/quantities.hpp"):
                continue
            literals = set(HEADER.findall(COMMENT.sub("", file.read_text(encoding="utf-8"))))
            self.assertEqual(literals & set(COLUMNS), set(), path)

    def test_files_that_declare_columns_are_there(self):
        for path in [*DECLARING, *(place for place in OTHER_COLUMNS if not place.endswith("/"))]:
            self.assertTrue((ROOT / "src" / path).is_file(), path)

    def test_neither_the_page_nor_the_pictures_give_a_column_a_label_or_a_group(self):
        """They may take a column for what they show; then its label and unit are those of the declaration."""
        names = "|".join(name for name in COLUMNS if not name.startswith("_"))
        paired = re.compile(rf"""["'`]({names})(?:\[[^\]"'`]*\])?["'`]\s*[:,]\s*["'`][A-Z][a-z]""")
        sets = re.compile(rf"""(?:Set\(|frozenset|[{{(\[])\s*["'`]({names})["'`],\s*["'`]({names})["'`]""")
        own_tables = {"point.py", "constitutive.py", "fitting.py", "tools.py"}
        for folder, suffix in (("web/report/src", "ts"), ("web/workbench/src", "ts"), ("python", "py")):
            for file in sorted((ROOT / folder).rglob(f"*.{suffix}")):
                if file.name in own_tables:
                    continue
                with self.subTest(file=file.name):
                    text = file.read_text(encoding="utf-8")
                    self.assertEqual(paired.findall(text), [])
                    self.assertEqual(sets.findall(text), [])

    def test_lists_of_an_older_page_would_be_found(self):
        old = 'new Set(["stored_heat", "heat_in"]); [["heat_iterations", "Heat, it."]]'
        names = "|".join(COLUMNS)
        self.assertRegex(old, rf'["\'`]({names})["\'`]\s*[:,]\s*["\'`][A-Z][a-z]')
        self.assertRegex(old, rf'[(\[]\s*["\'`]({names})["\'`],\s*["\'`]({names})["\'`]')

    def test_rows_are_whole_and_differ(self):
        for table, rows in DECLARED["tables"].items():
            heads = [(row["name"], row["unit"], row["label"]) for row in rows if row["name"] != "_force_z"]  # of two kinds of analysis
            self.assertEqual(len(heads), len(set(heads)), table)
            for row in rows:
                self.assertTrue(row["label"], row)
                self.assertTrue(row.get("chart") is None or row["chart"] in DECLARED["charts"], row)
                if row["unit"] not in ("", "1"):
                    self.assertNotEqual(fields.measure(row["unit"]), "Value", row)

    def test_labels_are_those_of_the_declarations(self):
        self.assertEqual(columns.label("stored_heat[J]"), "Stored heat")
        self.assertEqual(columns.label("stored_heat[kJ]"), "stored heat")  # a probe with a unit of its own
        self.assertEqual(columns.label("wheel_normal_force[N]"), "wheel: normal force")
        self.assertEqual(columns.label("T_center[degC]"), "T center")
        self.assertEqual(columns.label("dt[s]", "steps"), "Step")
        self.assertEqual((fields.unit_text("m2"), fields.unit_text("degC"), fields.unit_text("1"), fields.measure("J")), ("m²", "°C", "1", "Energy"))


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
