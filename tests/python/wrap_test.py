"""The text of the pages is wrapped at 120 columns, and wrapping changes nothing of what a reader sees."""

import re
import unittest

from solidus_docs import links, wrap

LONG = " ".join(["word"] * 40)  # 199 columns


class Wrapped(unittest.TestCase):
    def test_every_page_is_wrapped(self):
        self.assertEqual([str(page.relative_to(links.ROOT)) for page in wrap.by_hand() if wrap.wrapped(page.read_text()) != page.read_text()],
                         [], "./dev format wraps them")

    def test_paragraphs_lists_and_quotations_keep_their_margin(self):
        text = f"{LONG}\n\n* {LONG}\n  {LONG}\n1. {LONG}\n\n   {LONG}\n\n> {LONG}\n"
        lines = wrap.wrapped(text).split("\n")
        self.assertLessEqual(max(map(len, lines)), wrap.WIDTH)
        self.assertEqual([line[:4] for line in lines],
                         ["word", "word", "", "* wo", "  wo", "  wo", "  wo", "1. w", "   w", "", "   w", "   w", "", "> wo", "> wo", ""])
        self.assertEqual(" ".join(wrap.wrapped(text).replace(">", "").split()), " ".join(text.replace(">", "").split()))

    def test_what_is_no_text_stays(self):
        for text in (f"# {LONG}\n", f"| {LONG} | a |\n|---|---|\n", f"```sh\n{LONG}\n```\n", f"$$\n{LONG}\n$$\n", f"$${LONG}$$\n",
                     f"---\ntitle: {LONG}\n---\n", f"    {LONG}\n", f"<p>{LONG}</p>\n"):
            self.assertEqual(wrap.wrapped(text), text)

    def test_code_formulas_and_targets_are_not_broken(self):
        for whole in ("`a b c d e f`", "$x + y + z = 0$", "[name](place.md \"a title\")"):
            for length in range(90, wrap.WIDTH):
                lines = wrap.wrapped("x" * length + f" {whole} end").split("\n")
                kept = whole[whole.find("]"):]
                self.assertTrue(any(kept in line for line in lines), lines)

    def test_no_line_begins_with_a_mark_of_markdown(self):
        for mark in ("-", "+", "*", "1.", "12)", "#", "=", ">"):
            for length in range(100, wrap.WIDTH):
                lines = wrap.wrapped("x" * length + f" {mark} end of it").split("\n")
                self.assertFalse(any(line.startswith(mark) for line in lines), lines)

    def test_line_breaks_stay(self):
        self.assertEqual(wrap.wrapped("one  \ntwo\nthree\\\nfour\n"), "one  \ntwo three\\\nfour\n")

    def test_a_row_of_a_table_is_one_line(self):
        rows = [(str(page.relative_to(links.ROOT)), line) for page in wrap.by_hand()
                for line in re.sub(r"```.*?```", "", page.read_text(), flags=re.S).split("\n") if re.match(r" {0,3}\|", line)]
        self.assertGreater(len(rows), 1000)
        self.assertEqual([row for row in rows if not row[1].rstrip().endswith("|")], [])

    def test_wrapping_twice_is_wrapping_once(self):
        for page in wrap.by_hand():
            once = wrap.wrapped(page.read_text())
            self.assertEqual(wrap.wrapped(once), once, page)


if __name__ == "__main__":
    unittest.main()
