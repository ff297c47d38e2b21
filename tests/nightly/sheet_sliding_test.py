"""Monograph 7.2: all sixteen variants of cases/sheet_sliding, whole, against the closed form and the strip."""

import unittest

from whole_cases import numbers, reference, run

STEELS, FORCES, LAWS = ("ga", "eg"), (3920, 2940, 1960, 980), {"": "a", "_work": "b"}
UNIT = {"a": "kN/mm", "b": "kN/cm"}
PLATEAU = (12.5, 22.5)  # [mm]
PASSES = 20


class SheetSliding(unittest.TestCase):
    def slide(self, steel, force, suffix):
        law = LAWS[suffix]
        code, said, folder = run(f"sheet_sliding:{steel}_{force}{suffix}")
        self.assertEqual(code, 0, said)
        history, wear = numbers(folder / "history.csv"), numbers(folder / "wear_profile.csv")

        closed = [(float(row["zeta"]), float(row["ratio"]))
                  for row in reference("sheet_sliding_closed_form.csv", (steel, law, force))]
        plateau = [zeta for x, zeta in zip(wear["x[mm]"], wear[f"zeta_c[{UNIT[law]}]"])
                   if PLATEAU[0] - 1e-6 < x < PLATEAU[1] + 1e-6]
        self.assertEqual(len(plateau), 21)
        exact = closed[PASSES - 1][0]
        self.assertLess(abs(sum(plateau) / len(plateau) - exact), 0.015 * exact, "mean on the plateau")
        # Steps of 1 mm leave a ripple of that period, two nodes, on the plateau; where the sheet yields and its wear
        # by the work of friction stiffens itself, it grows.
        yields = (steel, force, suffix) == ("eg", 3920, "_work")
        for zeta in plateau:
            self.assertLess(abs(zeta - exact), (0.03 if yields else 0.015) * exact, "at a node of the plateau")
        for one, other in zip(plateau, plateau[1:]):
            self.assertLess(abs(0.5 * (one + other) - exact), (0.02 if yields else 0.01) * exact, "mean over the ripple")

        rows = list(zip(history["pass"], history["tool_displacement[mm]"], history["tangential_force[N]"],
                        history["normal_force[N]"]))
        ratios = {int(n): tangential / normal for n, way, tangential, normal in rows
                  if abs(way - 10) < 1e-6 and normal > 0.98 * force}
        self.assertEqual(sorted(ratios), list(range(1, PASSES + 1)))
        strip = {int(row["pass"]): float(row["ratio"]) for row in reference("sheet_sliding_strip.csv", (steel, law, force))
                 if abs(float(row["tool_displacement[mm]"]) - 10) < 1e-6}
        for n, ratio in ratios.items():
            self.assertLess(abs(ratio / closed[n - 1][1] - 1), 0.006, f"pass {n} against the closed form")
            self.assertLess(abs(ratio / strip[n] - 1), 0.0035, f"pass {n} against the strip")

        dissipated = history["interface_friction_dissipation[J]"]
        self.assertEqual(dissipated, sorted(dissipated), "friction takes nothing back")

        steps = numbers(folder / "steps.csv")
        self.assertEqual(len(steps["step[1]"]), 640)
        self.assertEqual(sum(steps["rejected[1]"]), 0)


def add(steel, force, suffix):
    name = f"{steel}_{force}{suffix}"
    setattr(SheetSliding, f"test_{name}_wears_and_rubs_as_the_closed_form", lambda self: self.slide(steel, force, suffix))


for a_steel in STEELS:
    for a_force in FORCES:
        for a_suffix in LAWS:
            add(a_steel, a_force, a_suffix)

if __name__ == "__main__":
    unittest.main()
