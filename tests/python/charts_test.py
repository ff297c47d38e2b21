"""The charts of the benchmarks are drawn from one table, and the page shows each of them once."""

import importlib.util
import pathlib
import re
import tempfile
import unittest

from solidus_docs.links import ROOT

specification = importlib.util.spec_from_file_location("charts", ROOT / "bench/charts.py")
charts = importlib.util.module_from_spec(specification)
specification.loader.exec_module(charts)


class Charts(unittest.TestCase):
    def test_every_chart_has_data_and_stands_on_the_page_once(self):
        shown = re.findall(r"\(images/benchmark_(\w+)\.png\)", (ROOT / "docs/benchmarks.md").read_text())
        self.assertEqual(sorted(shown), sorted(charts.CHARTS))
        self.assertEqual(set(charts.read()), set(charts.CHARTS))
        self.assertEqual({file.stem for file in (ROOT / "docs/images").glob("benchmark_*.png")}, {f"benchmark_{name}" for name in shown})

    def test_bars_and_lines_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("laws", "contact"):
                self.assertGreater(charts.draw(name, charts.read()[name], pathlib.Path(folder)).stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
