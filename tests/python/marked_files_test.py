"""Files of users that an editor of Windows has marked as UTF-8 by their first three bytes are read as others are."""

from pathlib import Path
import tempfile
import unittest

import solidus_casting as sc
from solidus_plots import study_file

CASE = """title = "marked"
[analysis]
kind = "plane_strain"
physics = "heat"
[time]
end = "3 s"
step = "1 s"
"""


class MarkedFiles(unittest.TestCase):
    def test_a_case_with_a_mark_is_the_case(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "case.toml"
            file.write_bytes(b"\xef\xbb\xbf" + CASE.replace("\n", "\r\n").encode())
            self.assertEqual(sc.Case.load(file).time.end, "3 s")

    def test_of_a_study_with_a_mark_only_its_content_is_judged(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "study.toml"
            file.write_bytes("\ufeff[nonsense]\nx = 1\n".encode())
            with self.assertRaisesRegex(Exception, "nonsense"):
                study_file.read_study(file)


if __name__ == "__main__":
    unittest.main()
