"""The table of what bare_debian.sh has measured."""

from pathlib import Path
import sys
import tempfile
import unittest

NIGHTLY = Path(__file__).resolve().parents[1] / "nightly"
sys.path.insert(0, str(NIGHTLY))
from bare_debian_table import table  # noqa: E402


class BareDebianTable(unittest.TestCase):
    def test_a_column_holds_what_one_release_said_and_failed_steps_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            places = [Path(folder) / name for name in ("twelve", "thirteen")]
            for place, facts, steps in zip(
                    places, ("system\tDebian 12\npackages\t500\n", "system\tDebian 13\npackages\t600\ntests passed\t149\n"),
                    ("debootstrap\t9.0 s\t20.1 s\n", "debootstrap\t9.0 s\t20.1 s\n./dev run\tfailed\t\n")):
                (place / "walk").mkdir(parents=True)
                (place / "walk/facts").write_text(facts)
                (place / "walk/steps").write_text(steps)
            self.assertEqual(table(places).splitlines(), [
                "|  | Debian 12 | Debian 13 |",
                "| --- | --- | --- |",
                "| packages after the first command | 500 | 600 |",
                "| tests passed |  | 149 |",
                "| steps that went well | 1 of 1 | 1 of 2 (failed: ./dev run) |"])


if __name__ == "__main__":
    unittest.main()
