#!/usr/bin/env python3
"""Writes the cooling block of case.toml as a CalculiX input: the same structured mesh, material, films, supports and steps.

usage: calculix_input.py DIVISIONS {hex,tet} OUTPUT.inp [direct|iterative]

CalculiX solves heat first and then mechanics in each step (*UNCOUPLED TEMPERATURE-DISPLACEMENT), as the isothermal split does.
"""
import sys

SIDE = 0.1  # m
STEPS, STEP = 10, 1.0  # s
# Each hexahedron as six tetrahedra around the diagonal 0-6.
TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


def node(i, j, k, n):
    return 1 + i + (n + 1) * (j + (n + 1) * k)


def corners(i, j, k, n):
    return [node(i, j, k, n), node(i + 1, j, k, n), node(i + 1, j + 1, k, n), node(i, j + 1, k, n),
            node(i, j, k + 1, n), node(i + 1, j, k + 1, n), node(i + 1, j + 1, k + 1, n), node(i, j + 1, k + 1, n)]


def elements(n, shape):
    for k in range(n):
        for j in range(n):
            for i in range(n):
                c = corners(i, j, k, n)
                if shape == "hex":
                    yield c
                else:
                    for t in TETS:
                        yield [c[a] for a in t]


FACES = {"hex": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
         "tet": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]}


def main():
    n, shape, path = int(sys.argv[1]), sys.argv[2], sys.argv[3]
    solver = ", SOLVER=ITERATIVE CHOLESKY" if len(sys.argv) > 4 and sys.argv[4] == "iterative" else ""
    grid = lambda m: ((m - 1) % (n + 1), (m - 1) // (n + 1) % (n + 1), (m - 1) // (n + 1) ** 2)
    with open(path, "w") as f:
        f.write("*NODE, NSET=ALL\n")
        for k in range(n + 1):
            for j in range(n + 1):
                for i in range(n + 1):
                    f.write(f"{node(i, j, k, n)},{SIDE * i / n:.9g},{SIDE * j / n:.9g},{SIDE * k / n:.9g}\n")
        f.write(f"*ELEMENT, TYPE={'C3D8' if shape == 'hex' else 'C3D4'}, ELSET=BLOCK\n")
        films = []
        for e, c in enumerate(elements(n, shape), 1):
            f.write(f"{e}," + ",".join(map(str, c)) + "\n")
            for number, face in enumerate(FACES[shape], 1):
                where = [grid(c[a]) for a in face]
                for axis in range(3):
                    if all(w[axis] == n for w in where):
                        films.append((e, number))
        f.write("*MATERIAL, NAME=STEEL\n*ELASTIC\n200.E9,0.3\n*EXPANSION, ZERO=500.\n1.2E-5\n"
                "*CONDUCTIVITY\n45.\n*SPECIFIC HEAT\n500.\n*DENSITY\n7800.\n"
                "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL,500.\n")
        for axis, name in enumerate("XYZ"):
            f.write(f"*NSET, NSET={name}0\n")
            for m in range(1, (n + 1) ** 3 + 1):
                if grid(m)[axis] == 0:
                    f.write(f"{m}\n")
        f.write(f"*STEP, INC=1000\n*UNCOUPLED TEMPERATURE-DISPLACEMENT, DIRECT{solver}\n{STEP},{STEP * STEPS}\n")
        f.write("*BOUNDARY\nX0,1,1\nY0,2,2\nZ0,3,3\n*FILM\n")
        for e, number in films:
            f.write(f"{e},F{number},20.,1000.\n")
        f.write("*NODE FILE, FREQUENCY=1000\nNT,U\n*EL FILE, FREQUENCY=1000\nS\n*END STEP\n")


main()
