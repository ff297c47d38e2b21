"""The runner of the tests in Python: what it says of skipped tests, and its exit code."""

from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

RUNNER = Path(__file__).resolve().parents[1] / "unittest_with_reasons.py"
HEAD = "import unittest\nclass Sums(unittest.TestCase):\n"
PASSES = "    def test_sum(self):\n        self.assertEqual(1 + 1, 2)\n"
FAILS = "    def test_wrong(self):\n        self.assertEqual(1 + 1, 3)\n"
SKIPPED = "    def test_tool(self):\n        self.skipTest('there is no\\n tool')\n"
PARTS = ("    def test_parts(self):\n        for part in (1, 2):\n            with self.subTest(part=part):\n"
         "                if part == 2:\n                    self.skipTest('no part 2')\n")


class Runner(unittest.TestCase):
    def outcome(self, text):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "some_test.py").write_text(text)
            done = subprocess.run([sys.executable, RUNNER, "discover", "-s", folder, "-p", "some_test.py"], capture_output=True, text=True)
        return done.returncode, done.stdout.splitlines()

    def test_reasons_are_said_and_the_exit_code_tells_whether_anything_ran(self):
        whole_class = HEAD.replace("class", "@unittest.skip('not here')\nclass")
        whole_module = "import unittest\nraise unittest.SkipTest('no module')\n"
        for text, code, said in (
                (HEAD + PASSES, 0, []),
                (HEAD + FAILS, 1, []),
                (HEAD + PASSES + SKIPPED, 0, ["skipped: there is no tool"]),
                (HEAD + FAILS + SKIPPED, 1, ["skipped: there is no tool"]),
                (HEAD + PARTS, 0, ["skipped: no part 2"]),
                (HEAD + SKIPPED, 77, ["all of it is skipped: there is no tool"]),
                (whole_class + PASSES, 77, ["all of it is skipped: not here"]),
                (whole_module, 77, ["all of it is skipped: no module"]),
                ("", 1, [])):
            with self.subTest(text=text):
                self.assertEqual(self.outcome(text), (code, said))


if __name__ == "__main__":
    unittest.main()
