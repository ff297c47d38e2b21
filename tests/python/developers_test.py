"""Code that the pages for developers show is the code of the files that they name."""

import pathlib
import re
import shutil
import tempfile
import unittest

from solidus_docs import page_changes

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "developers"
SHOWN = re.compile(r"\[`[^`]+`\]\(([^)]+)\) as\s+it\s+is\b.*?```cpp\n(.*?)```", re.DOTALL)


class DevelopersPages(unittest.TestCase):
    def test_files_that_are_shown_are_so(self):
        shown = 0
        for page in sorted(PAGES.glob("*.md")):
            for path, code in SHOWN.findall(page.read_text(encoding="utf-8")):
                with self.subTest(page=page.name, file=path):
                    self.assertIn(code.strip(), (PAGES / path).read_text(encoding="utf-8"))
                shown += 1
        self.assertGreaterEqual(shown, 3)

    def test_shown_changes_can_be_made(self):
        """That they do what the pages say is asserted by tests/nightly/nine_tasks_test.py."""
        made = []
        with tempfile.TemporaryDirectory() as folder:
            for part in ("src", "tests/laws"):
                shutil.copytree(ROOT / part, pathlib.Path(folder) / part)
            for page in sorted(PAGES.glob("*.md")):
                for change in page_changes.changes(page.read_text(encoding="utf-8")):
                    with self.subTest(page=page.name, file=change.file):
                        self.assertTrue(change.parts)
                        change.apply(folder)
                    made.append(change.file)
        self.assertGreaterEqual(len(made), 7)
        self.assertEqual(len(made), len(set(made)))

    def test_pages_of_first_tasks_say_which_file_a_change_is_of(self):
        for page in ("add_a_check_finding", "add_a_criterion", "add_a_format", "add_a_source", "add_an_element"):
            text = (PAGES / f"{page}.md").read_text(encoding="utf-8")
            blocks = page_changes.BLOCK.findall(text)
            self.assertTrue(blocks, page)
            for block in blocks:
                self.assertRegex(block.splitlines()[0], page_changes.FILE, page)
            self.assertNotIn("  ```diff", text, page)

    def test_a_change_that_does_not_fit_is_found(self):
        page = "```diff\n // a.txt\n one\n-two\n+three\n …\n+zero\n one\n```\n"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.txt"
            file.write_text("one\ntwo\n")
            change, = page_changes.changes(page)
            change.apply(folder)
            self.assertEqual(file.read_text(), "zero\none\nthree\n")
            self.assertRaises(ValueError, change.apply, folder)
            file.write_text("one\ntwo\none\ntwo\n")
            self.assertRaises(ValueError, change.apply, folder)


if __name__ == "__main__":
    unittest.main()
