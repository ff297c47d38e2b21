#!/usr/bin/env bash
# What:      Gmsh writes .bdf in small fields of eight characters and cuts off what does not fit. A metre from the origin, in mm, that
#            leaves steps of 0.001 mm: a layer of 0.0004 mm is 0 or 0.001 mm thick when the file is read again.
# Versions:  Gmsh 4.8.4 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64; Gmsh 4.13.1 of Debian 13 too
# Matters:   thin layers (coats, gaps, skins) and faces that should coincide move; Mesh.BdfFieldFormat = 2 writes large fields.
# Solidus:   refuses elements that lost their volume, with number and place (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-gmsh=4.8.4+ds2-3

said=$(inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for fields in (1, 2):
    gmsh.clear()
    gmsh.option.setNumber("Mesh.BdfFieldFormat", fields)
    a, b = (gmsh.model.geo.addPoint(x, 0, 0) for x in (1234.5671, 1234.5675))
    gmsh.model.geo.addLine(a, b)
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(1)
    before = gmsh.model.mesh.getNodes()[1]
    gmsh.write("/tmp/a.bdf")
    gmsh.clear()
    gmsh.merge("/tmp/a.bdf")
    after = gmsh.model.mesh.getNodes()[1]
    print(f"fields {fields}: {before[3] - before[0]:.4f} before, {after[3] - after[0]:.4f} after")
PYTHON
)
expect "$said" <<END
fields 1: 0.0004 before, 0.0000 after
fields 2: 0.0004 before, 0.0004 after
END
