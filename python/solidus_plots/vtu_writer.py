"""Writes a grid as ParaView's .vtu: appended raw data, as solidus_plots.vtu reads it."""

import struct
import zlib

import numpy as np

TYPES = {"f8": "Float64", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


def write_grid(path, grid):
    """Points, cells, fields with their units, and the time of a grid."""
    data, at = [], 0

    def array(name, values):
        nonlocal at
        values = np.ascontiguousarray(values)
        if values.dtype.str[1:] not in TYPES:
            values = values.astype("f8" if values.dtype.kind == "f" else "i8")
        raw = values.tobytes()
        packed = zlib.compress(raw, 1)
        part = struct.pack("<4Q", 1, len(raw), 0, len(packed)) + packed if raw else struct.pack("<3Q", 0, 0, 0)
        unit = grid.units.get(name)
        label = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>' if unit else ""
        element = (f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name="{name}" format="appended" '
                   f'NumberOfComponents="{values.shape[1] if values.ndim > 1 else 1}" offset="{at}">{label}</DataArray>')
        data.append(part)
        at += len(part)
        return element

    points, cells = ("".join(array(name, fields[name]) for name in fields)
                     for fields in (grid.point_data, grid.cell_data))
    text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
            'header_type="UInt64" compressor="vtkZLibDataCompressor"><UnstructuredGrid><FieldData>'
            f'<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{float(grid.time)!r}</DataArray>'
            f'</FieldData><Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(grid.cell_types)}">'
            f'<PointData>{points}</PointData><CellData>{cells}</CellData>'
            f'<Points>{array("Points", grid.points.astype("f8"))}</Points>'
            f'<Cells>{array("connectivity", grid.connectivity.astype("i8"))}'
            f'{array("offsets", grid.offsets.astype("i8"))}{array("types", grid.cell_types.astype("u1"))}</Cells>'
            '</Piece></UnstructuredGrid><AppendedData encoding="raw">\n_')
    path.write_bytes(text.encode() + b"".join(data) + b"\n</AppendedData></VTKFile>\n")
