"""Files as Windows writes them: line ends, marks of UTF-8, decimal commas, blanks in names. What they say is what counts."""

import unittest

from program import SOURCES, ProgramTest, solidus

CASE = """\
title = "A block that cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "block.geo"
unit = "mm"
[time]
end = "4 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = { file = "warm.csv" }
[[thermal_condition]]
name = "air"
group = "top"
kind = "film"
ambient = "20 degC"
coefficient = { file = "film.csv" }
"""
GEO = """\
Point(1) = {0, 0, 0, 5}; Point(2) = {20, 0, 0, 5}; Point(3) = {20, 10, 0, 5}; Point(4) = {0, 10, 0, 5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Line("top") = {3};
"""
WARM = "x[mm],T[degC]\n0,200.5\n20,300.25\n"
FILM = "x[mm],h[W/m2/K]\n0,1000.5\n20.0,2000\n"


def german(text):
    return text.replace(",", ";").replace(".", ",")


class WindowsFiles(ProgramTest):
    def history_of(self, folder, encode, table):
        """history.csv of the case with files as `encode` writes texts, and `table` their tables."""
        place = self.folder / folder
        place.mkdir()
        for name, text in (("case.toml", CASE), ("block.geo", GEO), ("warm.csv", table(WARM)), ("film.csv", table(FILM))):
            (place / name).write_bytes(encode(text, name))
        self.done("run", str(place), "-o", str(place / "out"))
        return (place / "out/history.csv").read_text()

    def test_line_ends_marks_and_decimal_commas_change_nothing(self):
        def windows(text, name):
            return (b"" if name.endswith(".geo") else b"\xef\xbb\xbf") + text.replace("\n", "\r\n").encode()
        plain = self.history_of("plain", lambda text, _: text.encode(), str)
        self.assertEqual(self.history_of("Meine Gussteile äöü", windows, german), plain)
        self.assertEqual(self.history_of("tabs", windows, lambda text: german(text).replace(";", "\t")), plain)

    def test_a_decimal_comma_within_a_case_is_an_error_with_its_line(self):
        self.history_of("plain", lambda text, _: text.encode(), str)
        result = solidus("check", str(self.folder / "plain"), "--set", "time.step='0,5 s'", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("0,5 s", result.stderr)

    def test_a_template_and_a_scan_of_windows_are_in_the_examples(self):
        scan = (SOURCES / "examples/scan/scan.csv").read_bytes()
        self.assertIn(b";", scan)
        self.assertIn(b",", scan)
        self.assertIn(b"\r\n", scan)


if __name__ == "__main__":
    unittest.main()
