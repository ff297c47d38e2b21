"""docs/guide/troubleshooting.md: every mistake is seeded into the page's case as the page shows it, and the program says what
stands there."""

import re
import subprocess
import unittest

from pages import blocks
from program import SOURCES, ProgramTest, solidus

PAGE = SOURCES / "docs/guide/troubleshooting.md"
SHOWN_FOLDER = "/home/you/plate"  # what the page has for the folder of the case


def seeded(case, change):
    """The case with a change applied: lines in the form of `diff -u`, one place."""
    lines = change.splitlines()
    old = "".join(line[1:] + "\n" for line in lines if line[:1] != "+")
    new = "".join(line[1:] + "\n" for line in lines if line[:1] != "-")
    if case.count(old) != 1:
        raise AssertionError(f"these lines stand {case.count(old)} times in the page's case:\n{old}")
    return case.replace(old, new)


def says(shown, said):
    """Whether a line is what stands on the page, which may cut it short by ' …' at its end."""
    return said.startswith(shown[:-1].rstrip()) if shown.endswith("…") else said == shown


class Troubleshooting(ProgramTest):
    def test_every_mistake_gives_the_message_that_the_page_shows(self):
        head, *sections = re.split(r"^### ", PAGE.read_text(), flags=re.M)
        case, = (block.text for block in blocks(head) if block.language == "toml")
        self.write("case.toml", case)
        sound = solidus("check", "case.toml", cwd=self.folder)
        self.assertEqual((sound.returncode, sound.stderr), (0, ""), "the page's case has no finding of its own")
        self.assertGreaterEqual(len(sections), 30)
        for number, section in enumerate(sections, start=1):
            title, _, text = section.partition("\n")
            with self.subTest(title):
                self.assertTrue(title.startswith(f"{number}. "))
                found = {block.language: block.text for block in blocks(text)}
                self.assertIn("*Cause.*", text)
                self.assertIn("*Cure.*", text)
                for left in self.folder.glob("plate.*"):
                    left.unlink()
                if "sh" in found:
                    subprocess.run(found["sh"], shell=True, cwd=self.folder, check=True)
                self.write("case.toml", seeded(case, found["diff"]))
                result = solidus("check", "case.toml", cwd=self.folder)
                said = [line for line in result.stderr.replace(str(self.folder), SHOWN_FOLDER).splitlines() if line.strip()]
                shown = found["text"].splitlines()
                self.assertEqual(len(shown), len(said), result.stderr)
                for line, answer in zip(shown, said):
                    self.assertTrue(says(line, answer), f"the page: {line}\nthe program: {answer}")
                self.assertEqual(result.returncode, 0 if shown[0].startswith(("warning", "info")) else 1)


if __name__ == "__main__":
    unittest.main()
