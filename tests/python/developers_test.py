"""Code that the pages for developers show is the code of the files that they name."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "developers"
SHOWN = re.compile(r"\[`[^`]+`\]\(([^)]+)\) as\s+it\s+is\b.*?```cpp\n(.*?)```", re.DOTALL)
DIFF = re.compile(r"```diff\n(.*?)```", re.DOTALL)
CHANGED = re.compile(r"^ // (src/\S+)$|^-(.*)$", re.MULTILINE)


class DevelopersPages(unittest.TestCase):
    def test_files_that_are_shown_are_so(self):
        shown = 0
        for page in sorted(PAGES.glob("*.md")):
            for path, code in SHOWN.findall(page.read_text(encoding="utf-8")):
                with self.subTest(page=page.name, file=path):
                    self.assertIn(code.strip(), (PAGES / path).read_text(encoding="utf-8"))
                shown += 1
        self.assertGreaterEqual(shown, 3)

    def test_lines_that_a_shown_change_removes_are_there(self):
        removed, file = 0, None
        diff = DIFF.search((PAGES / "add_an_element.md").read_text(encoding="utf-8"))[1]
        for path, line in CHANGED.findall(diff):
            if path:
                file = ROOT / path
            else:
                self.assertIn(line, file.read_text(encoding="utf-8").splitlines())
                removed += 1
        self.assertEqual(removed, 2)


if __name__ == "__main__":
    unittest.main()
