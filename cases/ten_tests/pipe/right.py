#!/usr/bin/env python3
"""The pipe of a cylinder that freezes from its side.

A cylinder of melt, radius R = 50 mm, height H = 100 mm, open at its top, freezes from its side; top and bottom are insulated.
The metal loses b = 5 % of its volume as it freezes (at one temperature) and none otherwise.

Derivation. All over its height the shell has the same thickness, so what is left of the melt is a cylinder of radius r
with its surface at the height h. When the shell grows by -dr, the solid 2 pi r h (-dr) is laid down, for which the volume
2 pi r h (-dr)/(1 - b) of melt is used up: d(pi r^2 h) = 2 pi r h dr/(1 - b), thus dh/h = 2 b/(1 - b) dr/r and

    h = H (r/R)^(2 b/(1 - b)).

The shell that froze at r stands up to h(r): this is the profile of the pipe, a funnel that reaches to the bottom in the axis.
Its volume is b pi R^2 H, as the integral of H - h over the area says too. It does not depend on how fast the side takes heat.
"""
from math import pi
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

RADIUS, HEIGHT, SHRINKAGE = 0.05, 0.1, 0.05
POWER = 2 * SHRINKAGE / (1 - SHRINKAGE)


def height(r):
    return HEIGHT * (r / RADIUS)**POWER


if __name__ == "__main__":
    deepest = HEIGHT - height(0.01)
    rows = [table.row(f"height_{mm}mm", "column_height", (mm / 1000, 0), 0, height(mm / 1000) * 1e3, "mm", deepest * 1e3)
            for mm in (10, 20, 30, 40)]
    volume = SHRINKAGE * pi * RADIUS**2 * HEIGHT * 1e6
    table.write(__file__, rows + [table.row("volume", "pipe_volume", (0, 0), 0, volume, "cm3", volume)])
