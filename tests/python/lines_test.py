"""Files stay short, and a fifth of what one reads is documentation: comments of the sources and pages written by hand."""

import pathlib
import statistics
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GENERATED = {"docs/reference/case_file.md", "docs/reference/material_file.md", "docs/reference/point_file.md", "docs/reference/fields.md",
             "docs/reference/findings.md", "docs/reference/tables.md", "docs/reference/python.md", "docs/theory/equations.md"}


def lines(file):
    return file.read_text(encoding="utf-8").splitlines()


def sources(folder):
    return {file.relative_to(ROOT).as_posix(): lines(file) for file in sorted((ROOT / folder).rglob("*.[ch]pp"))}


def documents(line):
    """A line that is a comment, or says next to a member what it means."""
    return line.lstrip().startswith("//") or "///<" in line


class Lines(unittest.TestCase):
    def test_files_are_short(self):
        for folder in ("src", "tests"):
            files = sources(folder)
            self.assertGreater(len(files), 300)
            self.assertLessEqual(statistics.median(len(text) for text in files.values()), 150, folder)
            self.assertEqual([file for file, text in files.items() if len(text) > 450], [])
        for folder, pattern in (("web/report/src", "*.ts"), ("tests/report", "*.mjs"), ("python", "*.py"), ("bench", "*.py")):
            lengths = {file: len(lines(file)) for file in (ROOT / folder).rglob(pattern)}
            self.assertGreater(len(lengths), 0, folder)
            self.assertEqual([file for file, length in lengths.items() if length > 450], [])

    def test_a_fifth_is_documentation(self):
        code = [line for text in sources("src").values() for line in text if line.strip()]
        pages = [line for file in (ROOT / "docs").rglob("*.md") if file.relative_to(ROOT).as_posix() not in GENERATED
                 for line in lines(file) if line.strip()]
        documentation = sum(map(documents, code)) + len(pages)
        self.assertGreaterEqual(documentation / (len(code) + len(pages)), 0.2)


if __name__ == "__main__":
    unittest.main()
