#!/usr/bin/env python3
"""Writes the meshes of the ten tests, each as mesh.msh (Gmsh 2.2) and mesh.inp (Abaqus, CalculiX).

usage: meshes.py [TEST ...]

A mesh has bodies (physical groups of the highest dimension, element sets) and sides (physical groups of lines or faces;
in the .inp file node sets and, as SIDE_faces, surfaces of elements). All lengths are in metres. Numbers of nodes and
elements begin at 1 in both files and are the same.
"""
from pathlib import Path
import sys

import numpy as np

HERE = Path(__file__).resolve().parent
# Type in Gmsh, type of solid elements in Abaqus, and the corners of each side in the order of Abaqus' numbers of sides.
QUAD = (3, "CPE4", [(0, 1), (1, 2), (2, 3), (3, 0)])
HEX = (5, "C3D8", [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)])
TET = (4, "C3D4", [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)])
SIDE_TYPE = {2: 1, 3: 2, 4: 3}  # Gmsh's line, triangle, quadrilateral
SIX_TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


class Mesh:
    def __init__(self, kind, dimension, inp_type=None):
        self.kind, self.dimension = kind, dimension
        self.inp_type = inp_type or kind[1]
        self.nodes, self.bodies, self.sides = [], {}, {}

    def grid(self, body, axes, move=None, split=False):
        """Adds a body of cells between the given coordinates of two or three axes, with its sides BODY_x_min and so on."""
        first = len(self.nodes) + 1
        sizes = [len(axis) for axis in axes]
        number = np.arange(int(np.prod(sizes))).reshape(sizes, order="F") + first
        for index in np.ndindex(*sizes[::-1]):
            point = [axis[i] for axis, i in zip(axes, index[::-1])]
            self.nodes.append(move(*point) if move else point)
        cells = []
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)] if len(axes) == 2 else [
            (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        for index in np.ndindex(*[n - 1 for n in sizes[::-1]]):
            cell = [int(number[tuple(np.add(index[::-1], corner))]) for corner in corners]
            cells += [[cell[i] for i in tet] for tet in SIX_TETS] if split else [cell]
        self.bodies[body] = cells
        for axis, letter in enumerate("xyz"[:len(axes)]):
            for end, name in ((0, "min"), (-1, "max")):
                on = set(np.take(number, end, axis=axis).ravel().tolist())
                self.sides[f"{body}_{letter}_{name}"] = self.faces_on(body, on)

    def faces_on(self, body, on):
        """The faces of a body all of whose nodes are in the set, as (place of the element in the body, number of its side)."""
        return [(e, s) for e, cell in enumerate(self.bodies[body])
                for s, side in enumerate(self.kind[2]) if all(cell[i] in on for i in side)]

    def side_nodes(self, name):
        body = next(b for b in self.bodies if name.startswith(b + "_"))
        return [[self.bodies[body][e][i] for i in self.kind[2][s]] for e, s in self.sides[name]]

    def write_msh(self, path):
        names = [(self.dimension, b) for b in self.bodies] + [(self.dimension - 1, s) for s in self.sides]
        tag = {name: i + 1 for i, (_, name) in enumerate(names)}
        out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
        out += [f'{d} {tag[name]} "{name}"' for d, name in names] + ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        for i, point in enumerate(self.nodes):
            out.append(f"{i + 1} " + " ".join(f"{x:.10g}" for x in (list(point) + [0.0])[:3]))
        lines = [(self.kind[0], tag[b], cell) for b, cells in self.bodies.items() for cell in cells]
        lines += [(SIDE_TYPE[len(face)], tag[s], face) for s in self.sides for face in self.side_nodes(s)]
        out += ["$EndNodes", "$Elements", str(len(lines))]
        out += [f"{i + 1} {kind} 2 {group} {group} " + " ".join(map(str, cell)) for i, (kind, group, cell) in enumerate(lines)]
        path.write_text("\n".join(out + ["$EndElements", ""]))

    def write_inp(self, path):
        out = ["*NODE, NSET=all"]
        for i, point in enumerate(self.nodes):
            out.append(f"{i + 1}, " + ", ".join(f"{x:.10g}" for x in (list(point) + [0.0])[:3]))
        first = {}
        number = 1
        for body, cells in self.bodies.items():
            first[body] = number
            out.append(f"*ELEMENT, TYPE={self.inp_type}, ELSET={body}")
            for cell in cells:
                out.append(f"{number}, " + ", ".join(map(str, cell)))
                number += 1
        for side, faces in self.sides.items():
            body = next(b for b in self.bodies if side.startswith(b + "_"))
            nodes = sorted({n for face in self.side_nodes(side) for n in face})
            out.append(f"*NSET, NSET={side}")
            out += [", ".join(map(str, nodes[i:i + 12])) for i in range(0, len(nodes), 12)]
            out.append(f"*SURFACE, NAME={side}_faces, TYPE=ELEMENT")
            out += [f"{first[body] + e}, S{s + 1}" for e, s in faces]
        for body, cells in self.bodies.items():
            nodes = sorted({n for cell in cells for n in cell})
            out.append(f"*NSET, NSET={body}_nodes")
            out += [", ".join(map(str, nodes[i:i + 12])) for i in range(0, len(nodes), 12)]
        path.write_text("\n".join(out + [""]))


def even(length, n, start=0.0):
    return start + length * np.arange(n + 1) / n


def graded(length, n, ratio):
    """From 0 to length with n cells, each `ratio` times as long as the one before."""
    steps = ratio ** np.arange(n)
    return np.concatenate([[0.0], np.cumsum(steps) * length / steps.sum()])


def bar():
    mesh = Mesh(QUAD, 2)
    mesh.grid("bar", [even(0.1, 100), even(0.001, 1)])
    return mesh


def corner():
    mesh = Mesh(QUAD, 2)
    mesh.grid("quarter", [even(0.1, 50), even(0.1, 50)])
    return mesh


def clamped_cube():
    """Tetrahedra whose inner nodes are moved by up to a fifth of a cell, the same way every time."""
    mesh = Mesh(TET, 3)

    def move(x, y, z):
        inside = min(x, y, z) > 1e-9 and max(x, y, z) < 0.1 - 1e-9
        shift = 0.004 if inside else 0.0
        return [x + shift * np.sin(311 * x + 97 * y + 17 * z), y + shift * np.sin(151 * x + 223 * z),
                z + shift * np.sin(91 * x + 401 * y)]

    mesh.grid("cube", [even(0.1, 4)] * 3, move, split=True)
    return mesh


def weiner_boley():
    mesh = Mesh(HEX, 3)
    mesh.grid("shell", [even(0.03, 75), even(0.0004, 1), even(0.0004, 1)])
    return mesh


def closing_gap():
    mesh = Mesh(QUAD, 2)
    mesh.grid("left", [even(0.1, 20), even(0.01, 2)])
    mesh.grid("right", [even(0.1, 20, 0.1001), even(0.01, 3)])
    return mesh


def plastic_work():
    mesh = Mesh(HEX, 3)
    mesh.grid("cube", [even(0.01, 2)] * 3)
    return mesh


def ring_on_core():
    mesh = Mesh(QUAD, 2, "CAX4")
    mesh.grid("core", [even(0.05, 25), even(0.004, 2)])
    mesh.grid("ring", [even(0.03, 15, 0.05002), even(0.004, 3)])
    return mesh


def pipe():
    mesh = Mesh(QUAD, 2, "CAX4")
    mesh.grid("casting", [even(0.05, 25), even(0.1, 50)])
    return mesh


def rubbing():
    """Both bodies are finest where they touch, at y = 0."""
    mesh = Mesh(QUAD, 2)
    mesh.grid("lower", [even(0.1, 20), -graded(0.02, 30, 1.1)[::-1]])
    mesh.grid("upper", [even(0.1, 20), graded(0.02, 30, 1.1)])
    return mesh


MESHES = {"stefan": bar, "alloy": bar, "corner": corner, "clamped_cube": clamped_cube, "weiner_boley": weiner_boley,
          "closing_gap": closing_gap, "plastic_work": plastic_work, "ring_on_core": ring_on_core, "pipe": pipe, "rubbing": rubbing}


def main():
    for name in sys.argv[1:] or MESHES:
        if name not in MESHES:
            sys.exit(f"meshes.py: there is no test '{name}'; there are {', '.join(MESHES)}")
        mesh = MESHES[name]()
        mesh.write_msh(HERE / name / "mesh.msh")
        mesh.write_inp(HERE / name / "mesh.inp")


if __name__ == "__main__":
    main()
