"""Field files as Solidus writes them (src/results/formats/vtu.cpp, vtk_data.cpp), in some lines of Python."""

import struct
import zlib

import numpy as np

TYPES = {"f8": "Float64", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


class Writer:
    """Appended raw data: zlib blocks of at most `BLOCK` bytes behind their sizes."""

    BLOCK = 64

    def __init__(self):
        self.data = b""

    def array(self, name, values, unit=""):
        raw = np.ascontiguousarray(values).tobytes()
        blocks = [raw[start:start + self.BLOCK] for start in range(0, len(raw), self.BLOCK)]
        packed = [zlib.compress(block) for block in blocks]
        head = struct.pack("<3Q", len(blocks), self.BLOCK, len(raw) % self.BLOCK)
        components = values.shape[1] if values.ndim > 1 else 1
        label = unit and f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>'
        element = (f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name="{name}" format="appended" '
                   f'NumberOfComponents="{components}" offset="{len(self.data)}">{label}</DataArray>')
        self.data += head + struct.pack(f"<{len(packed)}Q", *map(len, packed)) + b"".join(packed)
        return element


def write(path, points, nodes, numbers, temperature, hidden=None):
    """One moment (12.5 s) of triangles `nodes` [cell][3]; `hidden`: vtkGhostType of each cell."""
    writer, count = Writer(), len(nodes)
    cells = [writer.array("element", np.arange(count, dtype="i8")),
             writer.array("body", np.zeros(count, "i4")),
             writer.array("stress", np.arange(6.0 * count).reshape(count, 6), "Pa")]
    if hidden is not None:
        cells.append(writer.array("vtkGhostType", np.array(hidden, "u1")))
    body = (f'<PointData>{writer.array("node", np.array(numbers, "i8"))}'
            f'{writer.array("temperature", np.array(temperature, "f8"), "K")}</PointData>'
            f'<CellData>{"".join(cells)}</CellData>'
            f'<Points>{writer.array("Points", np.array(points, "f8"))}</Points>'
            f'<Cells>{writer.array("connectivity", np.array(nodes, "i8").ravel())}'
            f'{writer.array("offsets", 3 * (1 + np.arange(count, dtype="i8")))}'
            f'{writer.array("types", np.full(count, 5, "u1"))}</Cells>')
    text = (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><FieldData>'
            f'<DataArray Name="TimeValue">12.5</DataArray></FieldData><Piece>{body}</Piece></UnstructuredGrid>'
            f'<AppendedData encoding="raw">\n_')
    path.write_bytes(text.encode() + writer.data + b"\n</AppendedData></VTKFile>")
