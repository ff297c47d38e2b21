"""The index of the monograph's equations: what counts as a citation, and whether the page is up to date."""

import re
import unittest

from solidus_docs import equations


class Citations(unittest.TestCase):
    def test_numbers_in_parentheses_and_after_a_word_are_equations(self):
        self.assertEqual(equations.cited("/// W = ½ k tr²   (2.49a)"), ["2.49a"])
        self.assertEqual(equations.cited("// those of t_n in every scheme (4.81)."), ["4.81"])
        self.assertEqual(equations.cited("/// solves the first row of 4.97 and 2.24 of both"), ["4.97", "2.24"])

    def test_ranges_are_spelled_out(self):
        self.assertEqual(equations.cited("(monograph 4.2.3, 4.36, 4.46–4.49)"), ["4.46", "4.47", "4.48", "4.49", "4.36"])
        self.assertEqual(equations.cited("(3.9a–3.9c)"), ["3.9a", "3.9b", "3.9c"])

    def test_quantities_and_sections_are_none(self):
        for text in ("a factor of 2.5", "it takes 4.97 s", "(2.5 times as long)", "section 4.2.3", "below 3.9 %",
                     "(4 to 2.4e-3)", "by 7.10"):
            self.assertEqual(equations.cited(text), [], text)


class Page(unittest.TestCase):
    def test_says_what_the_sources_say(self):
        """But for the numbers of lines, which move; ./dev docs makes the page anew."""
        without_lines = lambda text: re.sub(r":\d+\]|#L\d+", "", text)  # noqa: E731
        self.assertEqual(without_lines(equations.PAGE.read_text(encoding="utf-8")),
                         without_lines(equations.page(equations.places())), "run ./dev docs")

    def test_has_the_equations_that_the_method_stands_on(self):
        found = equations.places()
        for number in ("2.24", "2.40", "2.48", "2.49a", "2.49b", "2.49c", "2.49d", "2.50", "2.52b", "2.64", "2.104",
                       "2.112", "2.127a", "2.127b", "3.43", "3.50", "3.58", "4.39", "4.40", "4.43a", "4.48a", "4.81", "4.97",
                       "4.138", "5.19", "5.30", "6.14"):
            self.assertIn(number, found)
            self.assertTrue(any(path.startswith("src/") for path, _ in found[number]), number)


if __name__ == "__main__":
    unittest.main()
