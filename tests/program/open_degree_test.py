"""The open rule of heat with more points in an element (monograph 6.3.2, figure 6.2): a bar freezes from one end over
10 elements, in a range of 4 K of which a few points of an element know at a time."""

import csv

from program import ProgramTest

METAL = """
density = "2700 kg/m3"
conductivity = "100 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "freezing"
solidification = true
latent_heat = "400 kJ/kg"
[phase_change.fraction]
kind = "linear"
solidus = "598 degC"
liquidus = "602 degC"
"""
CASE = """
title = "A bar freezes from one end"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["100 mm", "5 mm"]
divisions = [10, 1]
[time]
end = "200 s"
step = "0.5 s"
[[body]]
name = "block"
material = "metal.toml"
initial_temperature = "610 degC"
[[thermal_condition]]
name = "chill"
group = "x_min"
kind = "temperature"
temperature = "500 degC"
[heat]
integration = "open"
"""


class OpenDegree(ProgramTest):
    def solid(self, name, *settings):
        """The solid fraction after every step."""
        self.done("run", "case.toml", "-o", name, *(part for s in settings for part in ("--set", s)))
        with (self.folder / name / "history.csv").open(newline="") as file:
            return [float(row["solid_fraction[1]"]) for row in csv.DictReader(file)]

    def test_more_points_follow_the_front_through_an_element(self):
        self.write("metal.toml", METAL)
        self.write("case.toml", CASE)
        largest = {}  # of what freezes in a step, behind the first ten seconds
        for degree in (1, 3, 5, 9):
            solid = self.solid(f"degree_{degree}", f"heat.open_degree={degree}")
            largest[degree] = max(b - a for a, b in zip(solid[20:], solid[21:]))
        self.assertEqual(self.solid("default"), self.solid("degree_3", "heat.open_degree=3"))
        closed = self.solid("closed", 'heat.integration="closed"')
        largest["closed"] = max(b - a for a, b in zip(closed[20:], closed[21:]))
        # A point of four, of ten elements, is a fortieth of the bar or more: it freezes within a step.
        self.assertGreater(largest[1], 0.06)
        self.assertLess(largest[5], 0.5 * largest[3])
        self.assertLess(largest[9], 0.5 * largest[5])
        self.assertLess(largest["closed"], 0.6 * largest[9])
