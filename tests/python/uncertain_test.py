"""From runs to spreads: parts of an answer, what is run at its other end, what is moved together."""

import math
from pathlib import Path
import unittest

import numpy as np

from solidus_plots.answers import answers, bands
from solidus_plots.uncertain import usual_folder
from solidus_plots.uncertain_parameters import Parameter, merged, parameter_of
from solidus_plots.uncertain_result import evaluate, line, rounded, worth_the_other_side
from solidus_plots.uncertain_samples import points, summarised


def parameter(label, amount=0.1, kind="relative", group="casting", mechanical=False):
    return Parameter(label, group, mechanical, "", "estimate", "", kind, amount, [(f"vary.{label}", 1.0 if kind != "shift" else 0.0)])


class Parameters(unittest.TestCase):
    def test_ends_of_a_range_in_its_own_measure(self):
        self.assertEqual(parameter("x").changes(-1), ["vary.x=0.9"])
        self.assertEqual(parameter("x", 2.0, "factor").changes(-1), ["vary.x=0.5"])
        self.assertEqual(parameter("x", 0.9).changes(-1.5), ["vary.x=0.02"])
        self.assertEqual(parameter("x", 5.0, "shift").changes(0.5), ["vary.x=2.5 K"])
        entry = {"label": "conductivity of sand", "group": "mould", "mechanical": False, "spread": "10 %", "origin": "stated",
                 "source": "", "relative": 0.1, "places": [{"key": "a", "value": 2.0}, {"key": "b", "value": 1.0}]}
        self.assertEqual(parameter_of(entry).changes(1), ["a=2.2", "b=1.1"])

    def test_what_surrounds_the_casting_is_moved_together_first(self):
        of = [parameter("density of alloy"), parameter("latent heat of alloy"),
              parameter("conductivity of sand", 0.2, group="mould"), parameter("heat capacity per volume of sand", group="mould"),
              parameter("conductivity of chill", 0.02, group="mould"), parameter("heat capacity per volume of chill", 0.02, group="mould"),
              parameter("film coefficient of air", group="surroundings"), parameter("emissivity of air", group="surroundings"),
              parameter("strength of alloy", mechanical=True)]
        labels = lambda most: [one.label for one in merged(of, most)[0]]  # noqa: E731
        self.assertEqual(labels(9), [one.label for one in of])
        self.assertEqual(labels(8)[-2:], ["what surrounds the case, together", "strength of alloy"])
        # The chill is known better than the sand, so that less is lost.
        self.assertIn("conductivity and heat capacity of chill", labels(7))
        self.assertIn("conductivity of sand", labels(7))
        self.assertIn("conductivity and heat capacity of sand", labels(6))
        kept, left = merged(of, 4)
        self.assertEqual([one.label for one in left], ["strength of alloy"])
        everything = next(one for one in kept if "all moulds" in one.label)
        self.assertEqual(everything.changes(1), ["vary.conductivity of sand=1.2", "vary.heat capacity per volume of sand=1.1",
                                                 "vary.conductivity of chill=1.02", "vary.heat capacity per volume of chill=1.02"])


class Folders(unittest.TestCase):
    def test_cases_and_variants_have_folders_of_their_own(self):
        cases = Path(__file__).resolve().parents[2] / "cases"
        for case, folder in ((cases / "bracket", "bracket/uncertain"), (cases / "bracket/case.toml", "bracket/uncertain"),
                             (cases / "bracket/plate.toml", "bracket/uncertain_plate"),
                             (f"{cases / 'thick_cylinder'}:split", "thick_cylinder/uncertain_split")):
            self.assertEqual(usual_folder(str(case)), Path("results") / folder)


class Results(unittest.TestCase):
    def test_parts_are_two_standard_deviations_of_a_parabola(self):
        # y = 100 + 6 u + 4 u^2 + 3 v, u and v normal with a deviation of 1/2.
        found = evaluate({"t[s]": 100.0, "same[1]": 1.0}, {"t[s]": 2.0}, [parameter("u"), parameter("v")],
                         [{"t[s]": 110.0, "same[1]": 1.0}, {"t[s]": 103.0, "same[1]": 1.0}], [{"t[s]": 98.0}, None])
        self.assertEqual([answer.name for answer in found], ["t"])
        random = np.random.default_rng(1).normal(0, 0.5, 400000)
        self.assertAlmostEqual(found[0].parts[0].spread(), 2 * np.std(6 * random + 4 * random ** 2), delta=0.05)
        self.assertAlmostEqual(found[0].spread(), math.sqrt(36 + 8 + 9 + 4))
        self.assertEqual(line(found[0]), "100.0 s ± 7.5 (u 6.6, v 3.0, step and mesh 2.0)")
        self.assertEqual([part.label for part in found[0].bent_parts()], ["u"])
        self.assertEqual(found[0].incomplete, [])

    def test_bands_of_step_and_mesh_stand_beside_the_values_they_are_of(self):
        summary = {"answers": {"castings": {"part": {"last_melt_froze": {"value[s]": 165.0, "error[s]": 4.0}, "riser": False}},
                               "largest_gaps": {"wall": {"value[m]": 2e-4, "error[m]": 1e-5}},
                               "largest_distortion": {"value[m]": 1e-3}}}
        found = bands(summary)
        self.assertEqual(set(found), {"part: last melt froze[s]", "largest gap of wall[mm]"})
        self.assertEqual(found["part: last melt froze[s]"], 4.0)
        self.assertAlmostEqual(found["largest gap of wall[mm]"], 0.01)
        self.assertLessEqual(set(found), set(answers(summary)))

    def test_the_other_end_is_run_where_a_third_of_a_spread_is_made(self):
        parameters = [parameter("large"), parameter("small"), parameter("of another answer")]
        found = evaluate({"a[s]": 0.0, "b[s]": 0.0}, {}, parameters,
                         [{"a[s]": 9.0, "b[s]": 0.0}, {"a[s]": 1.0, "b[s]": 0.1}, {"a[s]": 1.0, "b[s]": 5.0}], [None] * 3)
        self.assertEqual(worth_the_other_side(found, parameters, 9), [2, 0])
        self.assertEqual(worth_the_other_side(found, parameters, 1), [2])

    def test_an_extreme_that_goes_from_node_to_node_is_known_by_it(self):
        of = [parameter(f"p{i}") for i in range(8)]
        ups = [{"jump[1]": 1.0 + 0.2 * (1 + 0.1 * i), "ranked[1]": 1.0 + 0.5 ** i} for i in range(8)]
        found = {answer.name: answer for answer in evaluate({"jump[1]": 1.0, "ranked[1]": 1.0}, {}, of, ups, [None] * 8)}
        self.assertTrue(found["jump"].jumps())
        self.assertFalse(found["ranked"].jumps())

    def test_a_run_without_an_answer_is_named(self):
        found = evaluate({"t[s]": 100.0}, {}, [parameter("u"), parameter("v")], [None, {"t[s]": 103.0}], [None, None])
        self.assertEqual(found[0].incomplete, ["u"])
        self.assertEqual([part.label for part in found[0].parts], ["v"])

    def test_numbers_have_two_figures_of_their_spread(self):
        self.assertEqual([rounded(165.43, 24.2), rounded(0.01234, 0.0031), rounded(16543.0, 2400.0), rounded(5.0, 0.0)],
                         ["165", "0.0123", "16543", "5"])


class Samples(unittest.TestCase):
    def test_a_latin_hypercube_is_normal_with_a_deviation_of_a_half(self):
        shares = points(3, 200, 1)
        self.assertEqual(shares.shape, (200, 3))
        np.testing.assert_allclose(shares.std(axis=0), 0.5, rtol=0.02)
        np.testing.assert_allclose(shares.mean(axis=0), 0.0, atol=0.005)
        self.assertLess(abs(np.corrcoef(shares.T) - np.eye(3)).max(), 0.2)
        values = np.column_stack([10 + 4 * shares[:, 0] - shares[:, 2], np.full(200, 3.0)])
        found = summarised(["a[mm]", "same[1]"], values, [parameter("x"), parameter("y"), parameter("z")], shares)
        self.assertEqual(len(found), 1)
        self.assertAlmostEqual(found[0]["plus_minus"], math.sqrt(17), delta=0.25)
        self.assertEqual(next(iter(found[0]["rank_correlations"])), "x")


if __name__ == "__main__":
    unittest.main()
