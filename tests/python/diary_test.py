"""Pages say what holds: when something was measured, from which seed and under which load is written in docs/log."""

import unittest

from solidus_docs import diary


class Diary(unittest.TestCase):
    def test_no_page_outside_the_log_tells_dates_seeds_or_loads(self):
        self.assertEqual(diary.mistakes(), [])

    def test_dates_seeds_and_loads_are_found_also_across_lines(self):
        for text in ("of 2026-11-23", "in random case 571326,", "cases 581269 and 540130", "on 27\nNovember 2026", "in November 2026", "(seeds 100316 and 20563)", "Seed 550303", "load 3 to 5", "a load of 2",
                     "on a busy machine", "beside other work", "(added later)"):
            self.assertEqual(len(diary.history(text)), 1, text)

    def test_code_loads_of_bodies_and_seeds_that_are_letters_are_none(self):
        for text in ("version `2025-11-25`", "a load of 200 N", "load 5 MPa", "`--seed 7`", "the seed S", "25 novembers"):
            self.assertEqual(diary.history(text), [], text)


if __name__ == "__main__":
    unittest.main()
