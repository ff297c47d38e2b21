"""Values as TOML holds them: those of numpy are written as plain numbers, whatever its version."""

import unittest

import numpy as np

from solidus_casting.toml_text import value_text


class Values(unittest.TestCase):
    def test_numbers_of_numpy_are_plain(self):
        self.assertEqual(value_text(np.float64(23.5)), "23.5")
        self.assertEqual(value_text(np.float32(0.5)), "0.5")
        self.assertEqual(value_text(np.int64(3)), "3")
        self.assertEqual(value_text([np.float64(0.1), "1 mm", True]), '[0.1, "1 mm", true]')
        self.assertEqual(value_text(np.float64("inf")), "inf")


if __name__ == "__main__":
    unittest.main()
