#!/usr/bin/env python3
"""Writes the freezing cube of linear.toml for CalculiX: the same tetrahedra, films, conductivity and heat content.

usage: calculix_input.py DIVISIONS FOLDER

FOLDER/heat.inp: *HEAT TRANSFER over 40 s with automatic increments of 2 s at most. CalculiX 2.20 has no keyword for latent heat (it
warns and goes on without it), so it is part of the specific heat, evenly between solidus and liquidus but for 5 K at both ends: with
sharper ends, or with equal increments of 2 to 0.02 s, its iteration diverges.
"""
import sys
from pathlib import Path

SIDE, END = 0.1, 40.0  # m, s
SOLIDUS, LIQUIDUS, LATENT, EDGE = 577.0, 614.0, 389e3, 5.0  # degC, J/kg; the specific heat rises within EDGE
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
# Each cell as six tetrahedra around the diagonal 0-6, as Solidus splits it; CalculiX's faces.
CELL = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]


def specific_heat():
    """Table of J/(kg K) with the latent heat as an evenly high stretch."""
    more = LATENT / (LIQUIDUS - SOLIDUS - EDGE)
    points = [(963, 100), (1160, SOLIDUS), (1160 + more, SOLIDUS + EDGE), (1160 + more, LIQUIDUS - EDGE), (1160, LIQUIDUS)]
    return "".join(f"{value:.9g},{at}\n" for value, at in points)


def main():
    n, folder = int(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)

    def node(p):
        return 1 + p[0] + (n + 1) * (p[1] + (n + 1) * p[2])

    films = []
    with open(folder / "heat.inp", "w") as f:
        f.write("*NODE, NSET=ALL\n")
        for k in range(n + 1):
            for j in range(n + 1):
                f.writelines(f"{node((i, j, k))},{SIDE * i / n:.9g},{SIDE * j / n:.9g},{SIDE * k / n:.9g}\n" for i in range(n + 1))
        f.write("*ELEMENT, TYPE=C3D4, ELSET=BLOCK\n")
        e = 0
        for k in range(n):
            for j in range(n):
                for i in range(n):
                    cell = [(i + a, j + b, k + c) for a, b, c in CORNERS]
                    for corners in CELL:
                        e += 1
                        f.write(f"{e}," + ",".join(str(node(cell[a])) for a in corners) + "\n")
                        for number, face in enumerate(FACES, 1):
                            if any(all(cell[corners[a]][axis] == n for a in face) for axis in (0, 1)):
                                films.append((e, number))
        f.write(f"*NSET, NSET=PROBES\n{node((0, 0, 0))}\n{node((n, n, n // 2))}\n")
        f.write("*MATERIAL, NAME=ALLOY\n*CONDUCTIVITY\n159.,25.\n150.,550.\n145.,577.\n65.,614.\n"
                f"*SPECIFIC HEAT\n{specific_heat()}*DENSITY\n2685.\n"
                "*SOLID SECTION, ELSET=BLOCK, MATERIAL=ALLOY\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL,700.\n")
        f.write(f"*STEP, INC=100000\n*HEAT TRANSFER, SOLVER=ITERATIVE SCALING\n0.02,{END},1e-7,2.\n*FILM\n")
        f.writelines(f"{e},F{number},20.,3000.\n" for e, number in films)
        f.write("*NODE PRINT, NSET=PROBES\nNT\n*NODE FILE, FREQUENCY=100000\nNT\n*END STEP\n")


main()
