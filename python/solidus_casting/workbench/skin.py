"""The skin of a part or of a mesh, as the page draws it: triangles with the numbers of their body and face.

A picture is one block of bytes: a line of JSON with counts and names, then three float32 for each node [m], three uint32 for
each triangle, an int32 each for its face (from one; 0: not known) and for its body (from zero), all with the least byte first.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

_ROW = re.compile(r"^ *(\d+)  (.+?)  +\d+ +[\d.e+-]+ +\(")  # of the table of faces: number and owner
_MOST_TRIANGLES = 6_000_000
_METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}


@dataclass(frozen=True)
class Skin:
    """Triangles of a skin.

    Attributes
    ----------
    nodes:
        Places [m], (n, 3).
    triangles:
        Nodes of each, (m, 3).
    faces, bodies:
        Of each triangle the number of its face, from one, and of its body, from zero.
    names:
        Of the bodies.
    """

    nodes: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    faces: NDArray[np.int32]
    bodies: NDArray[np.int32]
    names: list[str]

    def packed(self) -> bytes:
        """The block of bytes that the page reads."""
        head = json.dumps({"nodes": len(self.nodes), "triangles": len(self.triangles), "names": self.names})
        # Spaces fill the line up so that what follows lies at a multiple of four bytes.
        line = head.encode() + b" " * (3 - len(head.encode()) % 4) + b"\n"
        return b"".join([line, self.nodes.astype("<f4").tobytes(), self.triangles.astype("<u4").tobytes(),
                         self.faces.astype("<i4").tobytes(), self.bodies.astype("<i4").tobytes()])


def of_faces(file: Path, table: str) -> Skin:
    """The skin in the file that ``mesh-info --faces`` writes, with the names of bodies from its table.

    Raises :class:`InputError`.
    """
    text = file.read_text(encoding="ascii", errors="replace")
    try:
        head, _, rest = text.partition("POINTS ")
        count, _, rest = rest.partition(" double\n")
        points, _, rest = rest.partition("POLYGONS ")
        _, _, numbers = rest.partition("SCALARS face int 1\nLOOKUP_TABLE default\n")
        faces, _, bodies = numbers.partition("SCALARS body int 1\nLOOKUP_TABLE default\n")
        corners = np.array(points.split(), dtype=np.float64).reshape(int(count), 3)
        face = np.array(faces.split(), dtype=np.int32)
        body = np.array(bodies.split(), dtype=np.int32)
    except ValueError as error:
        raise InputError(f"this is no file of faces: {error}", file=file) from error
    if not head or len(face) != len(body) or len(corners) != 3 * len(face):
        raise InputError("this file of faces is damaged", file=file)
    nodes, triangles = _welded(corners.astype(np.float32))
    return Skin(nodes, triangles, face, body, _owners(table, face, body))


def _owners(table: str, face: NDArray[np.int32], body: NDArray[np.int32]) -> list[str]:
    """Names of the bodies, whose faces the printed table lists with their owners."""
    owner = {int(match[1]): match[2] for match in map(_ROW.match, table.splitlines()) if match}
    names = [f"body {number + 1}" for number in range(int(body.max(initial=-1)) + 1)]
    for number in range(len(names)):
        own = face[body == number]
        if len(own) and int(own[0]) in owner:
            names[number] = owner[int(own[0])]
    return names


def of_stl(file: Path, unit: str) -> Skin:
    """The triangles of an STL file, text or binary. Raises :class:`InputError`."""
    data = file.read_bytes()
    if unit not in _METRES:
        raise InputError(f"'{unit}' is no unit of an STL file here", ", ".join(_METRES))
    count = int.from_bytes(data[80:84], "little") if len(data) >= 84 else -1
    if len(data) == 84 + 50 * count:
        corners = _binary_corners(data, count)
    else:
        corners = _text_corners(data, file)
    if not len(corners) or not np.isfinite(corners).all():
        raise InputError("this file has no triangles, or some without a place", "an STL file", file=file)
    nodes, triangles = _welded(corners * np.float32(_METRES[unit]))
    zeros = np.zeros(len(triangles), dtype=np.int32)
    return Skin(nodes, triangles, zeros, zeros, [file.stem])


def _binary_corners(data: bytes, count: int) -> NDArray[np.float32]:
    if count > _MOST_TRIANGLES:
        raise InputError(f"{count} triangles are too many to be shown", f"{_MOST_TRIANGLES} at most")
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", 9), ("rest", "<u2")])
    return np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3).astype(np.float32)


def _text_corners(data: bytes, file: Path) -> NDArray[np.float32]:
    found = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data)
    if len(found) % 3 or len(found) > 3 * _MOST_TRIANGLES:
        raise InputError("this is no STL file, or a damaged one", file=file)
    try:
        return np.array(found, dtype=np.float64).reshape(-1, 3).astype(np.float32)
    except ValueError as error:
        raise InputError(f"this is no STL file: {error}", file=file) from error


def _welded(corners: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Nodes and triangles of loose corners: those at the same place are one node."""
    corners = corners + np.float32(0)  # minus zero is zero
    order = np.lexsort(corners.T)
    ordered = corners[order]
    new = np.ones(len(ordered), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    number = np.empty(len(ordered), dtype=np.uint32)
    number[order] = np.cumsum(new) - 1
    return ordered[new], number.reshape(-1, 3)
