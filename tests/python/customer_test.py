"""The printed report: digits by the error, texts of strangers, what a template may say, a browser that is not there."""

from pathlib import Path
import stat
import tempfile
import unittest

from solidus_plots import chromium
from solidus_plots.customer import Report, answers_of, chosen, contacts_of, materials_of
from solidus_plots.customer_page import error_text, number_text, page_of
from solidus_plots.customer_template import WORDS, Template, find_template, read_template
from solidus_plots.vtu import ResultError


class Numbers(unittest.TestCase):
    def test_a_value_has_the_digits_that_two_of_its_error_have(self):
        for value, error, shown, of_error in ((169.26502, 12.9197, "169", "13"), (0.48744, 0.05587, "0.487", "0.056"),
                                              (1.1492, 0.0423, "1.149", "0.042"), (1234567.0, 23456.0, "1235000", "23000"),
                                              (19.55, 8.0, "19.6", "8.0"), (-0.01234, 0.00012, "-0.01234", "0.00012")):
            with self.subTest(value=value):
                self.assertEqual((number_text(value, error), error_text(error)), (shown, of_error))

    def test_a_value_without_error_has_four_digits(self):
        self.assertEqual(number_text(53.96123), "53.96")
        self.assertEqual(number_text(5.0, 0.0), "5")


def report(**changes):
    return Report(**{"title": "A <b>part</b>", "date": "2026-01-02", "program": "Solidus", "outcome": "finished", "answers": [], **changes})


class Pages(unittest.TestCase):
    def test_texts_of_a_case_and_a_template_are_texts_on_the_page(self):
        evil = '"></style><script>alert(1)</script>'
        page = page_of(Template({"company": evil, "footer": evil, "remarks": evil}), report(title=evil, warnings=[evil]))
        self.assertNotIn("<script", page)
        self.assertEqual(page.count("</style>"), 1)
        self.assertIn("default-src 'none'", page)

    def test_it_has_four_sections_and_the_words_of_the_template(self):
        page = page_of(Template(words={**WORDS, "answers": "Antworten"}), report())
        self.assertEqual(page.count("<section"), 4)
        self.assertIn("<h2>Antworten</h2>", page)

    def test_every_source_of_every_material_is_there_once_for_all_its_bodies(self):
        card = {"title": "Alloy", "sources": [{"property": "plasticity.flow_stress", "source": "a book"}, {"property": "density", "source": ""}]}
        found = materials_of([{"body": "part", "material": "alloy", "card": card}, {"body": "riser", "material": "alloy", "card": card},
                              {"body": "mould", "material": "sand", "missing": "no such file"}])
        self.assertEqual([(m.title, m.bodies) for m in found], [("Alloy", ["part", "riser"]), ("sand", ["mould"])])
        self.assertEqual(found[0].sources, [("plasticity, flow stress", "a book"), ("density", "no source given")])
        self.assertEqual(found[1].sources, [("", "no such file")])

    def test_answers_with_an_error_come_first(self):
        rows = answers_of({"answers": {"yield": 0.5, "castings": {"part": {"last_melt_froze": {"value[s]": 10.0, "error[s]": 1.0}}}}})
        self.assertEqual([(row.name, row.value, row.unit, row.error) for row in rows],
                         [("part: last melt froze", 10.0, "s", 1.0), ("Yield", 50.0, "%", None)])

    def test_answers_of_the_part_come_before_those_of_a_riser_and_its_niyama_is_its_own(self):
        froze = {"solid_fraction": 1, "last_melt_froze": {"value[s]": 10.0, "error[s]": 1.0}}
        niyama = {"value[K^0.5 s^0.5/m]": 400.0, "error[K^0.5 s^0.5/m]": 60.0}
        rows = answers_of({
            "answers": {"castings": {"riser": {**froze, "riser": True, "least_niyama": {"value[K^0.5 s^0.5/m]": 40.0}},
                                     "part": {**froze, "riser": False, "least_niyama": niyama}}},
            "criteria": {"least_niyama[K^0.5 s^0.5/m]": 40.0, "tensile_strength_in_part_min[Pa]": 1.8e8, "tensile_strength_in_part_mean[Pa]": 1.9e8,
                         "elongation_in_part_min": 0.04, "elongation_in_part_mean": 0.05, "tensile_strength_in_riser_min[Pa]": 1e8}})
        self.assertEqual([(row.name, round(row.value, 9), row.unit, row.error) for row in rows][:3],
                         [("part: last melt froze", 10.0, "s", 1.0), ("Least Niyama", 0.4, "√(K s)/mm", 0.06), ("riser: last melt froze", 10.0, "s", 1.0)])
        self.assertEqual([(row.name, round(row.value, 9), row.unit) for row in rows if "strength" in row.name or "elong" in row.name],
                         [("part: least tensile strength", 180.0, "MPa"), ("part: mean tensile strength", 190.0, "MPa"),
                          ("part: least elongation", 4.0, "%"), ("part: mean elongation", 5.0, "%")])
        self.assertEqual([row.name for row in rows][-2:], ["part: solid fraction", "riser: solid fraction"])

    def test_contacts_tell_what_was_assumed(self):
        self.assertEqual(contacts_of({"contact": [{"name": "wall", "slave": "a", "master": "b", "heat": {
            "conductance": "1 W/m2/K", "gap_law": "gas", "slave_emissivity": 0.0}}]}), ["wall: a on b; conductance 1 W/m2/K, gap law gas"])

    def test_pictures_are_those_asked_for_or_the_telling_ones(self):
        sheets = [{"field": "temperature", "telling": 8}, {"field": "niyama"}, {"field": "solidified_at", "telling": 1},
                  {"field": "von_mises", "telling": 6}, {"field": "pore_fraction", "telling": 2}]
        self.assertEqual([s["field"] for s in chosen(sheets, [])], ["solidified_at", "pore_fraction", "von_mises"])
        self.assertEqual([s["field"] for s in chosen(sheets, ["temperature"])], ["temperature"])
        with self.assertRaisesRegex(ResultError, "there is no picture of 'gap' of this run; there are temperature"):
            chosen(sheets, ["gap"])


class Templates(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)

    def read(self, text):
        file = self.folder / "customer.toml"
        file.write_bytes(text.encode())
        return read_template(file)

    def test_the_example_can_be_read(self):
        template = read_template(Path(__file__).resolve().parents[2] / "examples/customer/customer.toml")
        self.assertTrue(template.logo.startswith("data:image/svg+xml;base64,"))

    def test_line_ends_and_mark_of_windows_are_read(self):
        self.assertEqual(self.read('\ufeffcompany = "A"\r\n[words]\r\npage = "Seite"\r\n').words["page"], "Seite")

    def test_mistakes_are_named_with_what_is_allowed(self):
        (self.folder / "logo.png").write_bytes(b"0" * 2_000_001)
        for text, words in (('firm = "A"', "unknown key 'firm'; there are title"), ("[words]\nfoo = 'a'", "unknown word in \\[words\\] 'foo'"),
                            ("company = 3", "'company' must be a text, not 3"), ('colour = "red"', "must be like"),
                            ('logo = "none.png"', "is not there"), ('logo = "logo.exe"', "must be an image"),
                            ('logo = "logo.png"', "2 MB are allowed"), ("pictures = [1]", "list of names of fields"),
                            ("words = 3", "must be a section"), (f"introduction = '{'a' * 901}'", "900 are allowed"), ("a = ", "customer.toml: ")):
            with self.subTest(text=text[:30]), self.assertRaisesRegex(ResultError, words):
                self.read(text)

    def test_one_beside_the_case_is_found_and_a_named_one_must_be_there(self):
        self.assertIsNone(find_template(None, self.folder / "case.toml"))
        self.read("")
        self.assertEqual(find_template(None, self.folder / "case.toml"), self.folder / "customer.toml")
        with self.assertRaisesRegex(ResultError, "no such file"):
            find_template(str(self.folder / "other.toml"), None)


class Browser(unittest.TestCase):
    def test_one_that_fails_or_is_missing_is_told_and_leaves_an_older_pdf(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            pdf, browser = folder / "a.pdf", folder / "browser"
            pdf.write_text("older")
            browser.write_text("#!/bin/sh\necho no display >&2\nexit 1\n")
            browser.chmod(browser.stat().st_mode | stat.S_IXUSR)
            self.assertRegex(chromium.print_page(str(browser), folder / "a.html", pdf), "wrote no PDF: no display")
            self.assertRegex(chromium.print_page(str(folder / "none"), folder / "a.html", pdf), "cannot be started")
            self.assertEqual(pdf.read_text(), "older")


if __name__ == "__main__":
    unittest.main()
