"""The index of the monograph's equations: what counts as a citation, and whether the page is up to date."""

import pathlib
import re
import tempfile
import unittest

from solidus_docs import equations


class Citations(unittest.TestCase):
    def test_numbers_in_parentheses_and_after_a_word_are_equations(self):
        self.assertEqual(equations.cited("/// W = ½ k tr²   (2.49a)"), ["2.49a"])
        self.assertEqual(equations.cited("// those of t_n in every scheme (4.81)."), ["4.81"])
        self.assertEqual(equations.cited("/// solves the first row of 4.97 and 2.24 of both"), ["4.97", "2.24"])

    def test_numbers_alone_in_a_line_and_with_letters_are_equations(self):
        self.assertEqual(equations.cited("4.131b"), ["4.131b"])
        self.assertEqual(equations.cited("4.146a, 4.145"), ["4.146a", "4.145"])
        self.assertEqual(equations.cited("Plastic flow makes entropy (2.119, 4.43b, see there)"), ["2.119", "4.43b"])
        self.assertEqual(equations.cited("in q (Fourier's law, monograph 2.61)"), ["2.61"])

    def test_ranges_are_spelled_out(self):
        self.assertEqual(equations.cited("(monograph 4.2.3, 4.36, 4.46–4.49)"), ["4.36", "4.46", "4.47", "4.48", "4.49"])
        self.assertEqual(equations.cited("(3.9a–3.9c)"), ["3.9a", "3.9b", "3.9c"])

    def test_quantities_and_sections_are_none(self):
        for text in ("a factor of 2.5", "it takes 4.97 s", "(2.5 times as long)", "section 4.2.3", "below 3.9 %",
                     "(4 to 2.4e-3)", "by 7.10"):
            self.assertEqual(equations.cited(text), [], text)


class Paragraphs(unittest.TestCase):
    def citations(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.write_text(text, encoding="utf-8")
            return list(equations.citations(path))

    def test_a_sentence_goes_on_in_the_next_line(self):
        self.assertEqual(self.citations("a.hpp", "/// one has added it, and\n/// 5.64 takes it off\nint x = 3.67;\n"), [(2, "5.64")])
        self.assertEqual(self.citations("a.md", "At fixed entropy (2.119,\n4.43) it is\n"), [(1, "2.119"), (2, "4.43")])

    def test_tables_cite_in_their_column_of_equations(self):
        table = "| equation | size |\n|---|---|\n| 5.64 | 5.10 |\n| 3.65b | of 2.5 mm |\n"
        self.assertEqual(self.citations("a.md", table), [(3, "5.64"), (4, "3.65b")])


class Page(unittest.TestCase):
    def test_says_what_the_sources_say(self):
        """But for the numbers of lines, which move; ./dev docs makes the page again."""
        without_lines = lambda text: re.sub(r":\d+\]|#L\d+", "", text)  # noqa: E731
        self.assertEqual(without_lines(equations.PAGE.read_text(encoding="utf-8")),
                         without_lines(equations.page(equations.places())), "run ./dev docs")

    def test_has_the_equations_of_every_chapter_to_its_last(self):
        found = equations.places()
        for number in ("2.61", "2.148", "2.149", "2.150", "2.151", "4.150", "4.151", "4.152", "5.9a", "5.9b", "5.10", "5.11",
                       "5.12", "5.13a", "5.13b", "5.14", "5.15", "5.64", "6.5", "6.6", "6.7", "6.8", "6.9"):
            self.assertIn(number, found)

    def test_has_the_equations_that_the_method_stands_on(self):
        found = equations.places()
        for number in ("2.24", "2.40", "2.48", "2.49a", "2.49b", "2.49c", "2.49d", "2.50", "2.52b", "2.64", "2.104",
                       "2.112", "2.127a", "2.127b", "3.43", "3.50", "3.58", "4.39", "4.40", "4.43a", "4.48a", "4.81", "4.97",
                       "4.138", "5.19", "5.30", "6.14"):
            self.assertIn(number, found)
            self.assertTrue(any(path.startswith("src/") for path, _ in found[number]), number)

    def test_laws_of_the_interface_are_found_by_their_equations(self):
        found = equations.places()
        for number, law in (("3.47", "spots_contact"), ("3.48", "spots_contact"), ("3.49", "power_contact")):
            self.assertIn(f"src/contact/laws/{law}.hpp", {path for path, _ in found[number]}, number)


if __name__ == "__main__":
    unittest.main()
