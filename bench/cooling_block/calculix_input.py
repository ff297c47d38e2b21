#!/usr/bin/env python3
"""Writes the cooling block of case.toml for CalculiX: the same structured mesh, data, films, supports and steps.

usage: calculix_input.py DIVISIONS {hex8,tet4} {direct,iterative} FOLDER [STEP]

Two inputs, run one after the other: FOLDER/heat.inp (ten *HEAT TRANSFER steps of STEP seconds, default 1) and
FOLDER/mechanics.inp (*STATIC after each of them, with its temperatures). *UNCOUPLED TEMPERATURE-DISPLACEMENT would do both
in one, but runs as a dynamic analysis with slightly other results, and CalculiX 2.20 crashes in it with its iterative solver.
"""
import sys
from pathlib import Path

SIDE = 0.1  # m
STEPS = 10
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
# Each hexahedron as six tetrahedra around the diagonal 0-6, as Solidus splits it.
CELL = {"hex8": [(0, 1, 2, 3, 4, 5, 6, 7)],
        "tet4": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
# CalculiX's order of the faces.
FACES = {"hex8": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
         "tet4": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]}
TYPE = {"hex8": "C3D8", "tet4": "C3D4"}
MATERIAL = """*MATERIAL, NAME=STEEL
*ELASTIC
200.E9,0.3
*PLASTIC
150.E6,0.
2150.E6,1.
*EXPANSION, ZERO=500.
1.2E-5
*CONDUCTIVITY
45.
*SPECIFIC HEAT
500.
*DENSITY
7800.
*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL,500.
"""


def node(i, j, k, n):
    return 1 + i + (n + 1) * (j + (n + 1) * k)


def elements(n, shape):
    """The corners of each element as positions on the lattice."""
    for k in range(n):
        for j in range(n):
            for i in range(n):
                cell = [(i + a, j + b, k + c) for a, b, c in CORNERS]
                for corners in CELL[shape]:
                    yield [cell[a] for a in corners]


def model(n, shape):
    """Nodes, elements, sets and material; and the cooled faces as (element, face)."""
    text, films = ["*NODE, NSET=ALL\n"], []
    for k in range(n + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                text.append(f"{node(i, j, k, n)},{SIDE * i / n:.9g},{SIDE * j / n:.9g},{SIDE * k / n:.9g}\n")
    text.append(f"*ELEMENT, TYPE={TYPE[shape]}, ELSET=BLOCK\n")
    for e, corners in enumerate(elements(n, shape), 1):
        text.append(f"{e}," + ",".join(str(node(*p, n)) for p in corners) + "\n")
        if any(n in p for p in corners):
            for number, face in enumerate(FACES[shape], 1):
                if any(all(corners[a][axis] == n for a in face) for axis in range(3)):
                    films.append((e, number))
    text.append(f"*NSET, NSET=PROBES\n{node(n, n, n, n)}\n{node(0, 0, 0, n)}\n")
    span = range(n + 1)
    for axis, name in enumerate("XYZ"):
        text.append(f"*NSET, NSET={name}0\n")
        text += [f"{node(*p[:axis], 0, *p[axis:], n)}\n" for p in ((a, b) for a in span for b in span)]
    return "".join(text) + MATERIAL, films


def main():
    n, shape, solver, folder = int(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
    step = float(sys.argv[5]) if len(sys.argv) > 5 else 1.0
    solver = ", SOLVER=ITERATIVE SCALING" if solver == "iterative" else ", SOLVER=SPOOLES"
    folder.mkdir(parents=True, exist_ok=True)
    common, films = model(n, shape)
    with open(folder / "heat.inp", "w") as f:
        f.write(common)
        for i in range(1, STEPS + 1):  # one increment a step: mechanics.inp finds temperatures by the number of the step
            f.write(f"*STEP\n*HEAT TRANSFER, DIRECT{solver}\n{step},{step}\n")
            if i == 1:
                f.write("*FILM\n")
                f.writelines(f"{e},F{number},20.,1000.\n" for e, number in films)
            f.write("*NODE PRINT, NSET=PROBES\nNT\n*NODE FILE\nNT\n*END STEP\n")
    with open(folder / "mechanics.inp", "w") as f:
        f.write(common + "*BOUNDARY\nX0,1,1\nY0,2,2\nZ0,3,3\n")
        for i in range(1, STEPS + 1):
            f.write(f"*STEP\n*STATIC{solver}\n*TEMPERATURE, FILE=heat.frd, BSTEP={i}\n*NODE PRINT, NSET=PROBES\nU\n")
            f.write("*NODE FILE\nU\n*EL FILE\nS\n" if i == STEPS else "*NODE FILE\n*EL FILE\n")
            f.write("*END STEP\n")


main()
