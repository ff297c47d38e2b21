"""docs/guide/troubleshooting.md: every mistake is seeded into the page's case as the page shows it, and the program says what
is there: `check` where it sees the mistake, else `run`, which ends with exit code 2."""

import re
import subprocess
import unittest

from pages import blocks
from program import SOURCES, ProgramTest, solidus

PAGE = SOURCES / "docs/guide/troubleshooting.md"
SHOWN_FOLDER = "/home/you/plate"  # what the page has for the folder of the case
STOPPED = "## When a run stops"  # from there on mistakes are run


def seeded(case, change):
    """The case with a change applied: lines in the form of `diff -u`, one place."""
    lines = change.splitlines()
    old = "".join(line[1:] + "\n" for line in lines if line[:1] != "+")
    new = "".join(line[1:] + "\n" for line in lines if line[:1] != "-")
    if case.count(old) != 1:
        raise AssertionError(f"these lines are {case.count(old)} times in the page's case:\n{old}")
    return case.replace(old, new)


def says(shown, said):
    """Whether a line is what is on the page, which leaves out by '…' what differs from machine to machine, or is long."""
    return re.fullmatch(".*".join(re.escape(part.strip(" ")) for part in shown.split("…")), said.strip(" ")) is not None


class Troubleshooting(ProgramTest):
    def test_every_mistake_gives_the_message_that_the_page_shows(self):
        page, stopped = PAGE.read_text().split(STOPPED)
        head, *sections = re.split(r"^### ", page, flags=re.M)
        case, = (block.text for block in blocks(head) if block.language == "toml")
        self.write("case.toml", case)
        sound = solidus("check", "case.toml", cwd=self.folder)
        self.assertEqual((sound.returncode, sound.stderr), (0, ""), "the page's case has no finding of its own")
        self.assertGreaterEqual(len(sections), 30)
        self.runs_end_as_shown(case, stopped, len(sections))
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

    def runs_end_as_shown(self, case, page, before):
        _, *sections = re.split(r"^### ", page.split("\n## ")[0], flags=re.M)
        self.assertGreaterEqual(len(sections), 5)
        for number, section in enumerate(sections, start=before + 1):
            title, _, text = section.partition("\n")
            with self.subTest(title):
                self.assertTrue(title.startswith(f"{number}. "))
                self.assertIn("*Cause.*", text)
                self.assertIn("*Cure.*", text)
                found = {block.language: block.text for block in blocks(text)}
                self.write("case.toml", seeded(case, found["diff"]))
                result = solidus("run", "case.toml", "-o", f"out_{number}", cwd=self.folder)
                self.assertEqual(result.returncode, 2, result.stderr)
                said = result.stderr.replace(str(self.folder), SHOWN_FOLDER).splitlines()
                for line in found["text"].splitlines():
                    self.assertTrue(any(says(line, answer) for answer in said), f"the page: {line}\nthe program: {result.stderr}")


if __name__ == "__main__":
    unittest.main()
