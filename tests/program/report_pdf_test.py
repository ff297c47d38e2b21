"""`solidus report --pdf`: four pages by a browser where there is one, the same page without, mistakes in words."""

import re
import shutil
import unittest

from program import SOURCES, ProgramTest, solidus

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


class ReportAsPdf(ProgramTest):
    def test_four_pages_of_a_run_with_and_without_a_browser(self):
        self.done("run", str(SOURCES / "cases/bracket"), "--heat-only", "-o", "run", "--set", "time.end='2 s'")
        template = self.write("customer.toml", 'company = "Example Foundry"\ncustomer = "Pump Works"\n')
        said = self.done("report", "run", "--pdf", "--template", str(template), "-o", "printed.pdf", env={"SOLIDUS_BROWSER": ""})
        self.assertRegex(said, r"No PDF: no Chromium.* printed\.print\.html")
        page = (self.folder / "printed.print.html").read_text()
        for words in ("Example Foundry", "Pump Works", "A bracket in sand", "ASM Handbook 2 (1990)", "conductance 1000 W/m2/K",
                      "how the metal flows in was not computed", "Stress, distortion and gaps that open were not computed"):
            self.assertIn(words, page)
        self.assertGreaterEqual(page.count("data:image/png"), 1)
        if BROWSER is None:
            self.skipTest("chromium is not installed (./dev test installs it)")
        self.done("report", "run", "--pdf", "--template", str(template))
        pdf = (self.folder / "run/report.pdf").read_bytes()
        self.assertEqual(re.findall(rb"/Count (\d+)", pdf), [b"4"])
        self.assertFalse((self.folder / "run/report.print.html").exists())

    def test_mistakes(self):
        (self.folder / "empty").mkdir()
        for arguments, words in ((["empty", "--pdf"], "no case.toml"), (["a", "b", "--pdf"], "of one run"),
                                 (["empty", "--template", "x"], "--pdf")):
            with self.subTest(arguments=arguments):
                result = solidus("report", *arguments, cwd=self.folder)
                self.assertEqual((result.returncode, words in result.stderr), (1, True), result.stderr)


if __name__ == "__main__":
    unittest.main()
