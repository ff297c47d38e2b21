#!/usr/bin/env bash
# What:      merge of pyvista, and a + b, make one node of two that lie in one place, although VTK's own vtkAppendFilter, which does the
#            work, does not by default. Of the two values there the first grid's stays: a + b and b + a have different temperatures at the
#            interface. merge_points=False keeps all; MultiBlock.combine keeps all by default.
# Versions:  pyvista 0.44.1, VTK 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   the jump of temperature between casting and mould, and an open gap that is drawn deformed, vanish; the mean changes.
# Solidus:   a moment is one grid, with the nodes of each body apart; docs/guide/python.md says how to put several together.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-pyvista=0.44.1-11
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import pyvista
from vtkmodules.vtkFiltersCore import vtkAppendFilter

# A casting of 700 degrees from x = 0 to 1, a mould of 300 from 1 to 2.
casting, mould = (pyvista.ImageData(dimensions=(2, 2, 2), origin=(x, 0, 0)).cast_to_unstructured_grid() for x in (0, 1))
casting["T"], mould["T"] = [700.0] * 8, [300.0] * 8
append = vtkAppendFilter()
append.AddInputData(casting)
append.AddInputData(mould)
append.Update()
for how, grid in {
    "vtkAppendFilter": pyvista.wrap(append.GetOutput()),
    "casting + mould": casting + mould,
    "mould + casting": mould + casting,
    "merge_points=False": casting.merge(mould, merge_points=False),
    "MultiBlock.combine": pyvista.MultiBlock([casting, mould]).combine(),
}.items():
    print(f"{how}: {grid.n_points} nodes, at x = 1: {sorted({float(t) for t in grid['T'][grid.points[:, 0] == 1]})}")
PYTHON
)
expect "$said" <<END
vtkAppendFilter: 16 nodes, at x = 1: [300.0, 700.0]
casting + mould: 12 nodes, at x = 1: [700.0]
mould + casting: 12 nodes, at x = 1: [300.0]
merge_points=False: 16 nodes, at x = 1: [300.0, 700.0]
MultiBlock.combine: 16 nodes, at x = 1: [300.0, 700.0]
END
