"""Records of decisions are of half a page, say their status, and have a row in the table of all."""

import pathlib
import re
import unittest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs" / "decisions"
RECORDS = sorted(path for path in FOLDER.glob("*.md") if path.name != "README.md")
ROW = re.compile(r"^\| \[(\d{4})\]\(([^)]+)\) \|[^|]+\| (.+) \|$", re.MULTILINE)
STATUS = re.compile(r"^\*\*Status\.\*\* (.+?)\n\n", re.MULTILINE | re.DOTALL)


class Decisions(unittest.TestCase):
    def test_numbers_differ_and_are_those_of_the_titles(self):
        numbers = [path.name[:4] for path in RECORDS]
        self.assertEqual(len(set(numbers)), len(numbers))
        for path in RECORDS:
            self.assertEqual(path.read_text(encoding="utf-8")[:7], f"# {path.name[:4]} ", path.name)

    def test_each_has_a_status_and_a_row_with_it(self):
        rows = {file: (number, status) for number, file, status in ROW.findall((FOLDER / "README.md").read_text(encoding="utf-8"))}
        self.assertEqual(sorted(rows), [path.name for path in RECORDS])
        for path in RECORDS:
            status = STATUS.search(path.read_text(encoding="utf-8"))
            self.assertIsNotNone(status, path.name)
            self.assertEqual(rows[path.name][0], path.name[:4])
            first = re.split(r"[ .;:]", rows[path.name][1])[0]
            self.assertEqual(re.split(r"[ .;:]", " ".join(status[1].split()))[0], first, path.name)

    def test_a_record_is_half_a_page(self):
        self.assertEqual([path.name for path in RECORDS if len(path.read_text(encoding="utf-8").splitlines()) > 55], [])


if __name__ == "__main__":
    unittest.main()
