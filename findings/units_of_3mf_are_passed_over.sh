#!/usr/bin/env bash
# What:      3MF is a format of triangles that has a unit. FreeCAD and Assimp read the coordinates of a file in inches as they are: in
#            FreeCAD, whose lengths are millimetres, an inch is 1 mm. trimesh keeps the unit beside the coordinates when it reads, and
#            writes "millimeter" into every file: a box of 0.1 m, whose units are set to metres, is one of 0.1 mm for whoever reads its
#            file.
# Versions:  FreeCAD 1.0.0, Assimp 5.4.3, trimesh 4.5.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a factor of 25.4 or 1000, from a format that is chosen because it cannot happen there.
# Solidus:   reads no 3MF. STL, which has no unit, is in the unit that the user names, else in mm (docs/guide/new_case.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie freecad-python3=1.0.0+dfsg-8+deb13u3 assimp-utils=5.4.3+ds-2 python3-trimesh=4.5.1-3 python3-networkx=3.2.1-5 \
  python3-lxml=5.4.0-1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(
  inside python3 - 2>/dev/null <<'PYTHON'
import re
import sys
import zipfile

import trimesh

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", "/usr/lib/freecad/Mod/Mesh"]
import FreeCAD
import Mesh

PACKAGES = "http://schemas.openxmlformats.org/package/2006/"
with zipfile.ZipFile("/tmp/inch.3mf", "w") as file:
    file.writestr("[Content_Types].xml", f'''<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="{PACKAGES}content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>''')
    file.writestr("_rels/.rels", f'''<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="{PACKAGES}relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0"
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>''')
    file.writestr("3D/3dmodel.model", '''<?xml version="1.0" encoding="UTF-8"?>
<model unit="inch" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" type="model"><mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles>
<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/>
</triangles></mesh></object></resources><build><item objectid="1"/></build></model>''')

print("FreeCAD:", Mesh.Mesh("/tmp/inch.3mf").BoundBox.XLength, "mm of 1 inch")
read = trimesh.load("/tmp/inch.3mf")
print("trimesh:", read.extents[0], read.units)
box = trimesh.creation.box((0.1, 0.1, 0.1))
box.units = "meter"
box.export("/tmp/box.3mf")
with zipfile.ZipFile("/tmp/box.3mf") as file:
    model, = [file.read(name).decode() for name in file.namelist() if name.endswith(".model")]
print("0.1 meter of trimesh:", *re.findall(r'unit="\w+"', model), trimesh.load("/tmp/box.3mf").extents[0])
PYTHON
  inside assimp export /tmp/inch.3mf /tmp/inch.stl >/dev/null 2>&1
  printf 'Assimp, to STL: up to %s\n' "$(awk '/vertex/ { if ($2 > most) most = $2 } END { print most }' "$root/tmp/inch.stl")"
)
expect "$said" <<END
FreeCAD: 1.0 mm of 1 inch
trimesh: 1.0 inch
0.1 meter of trimesh: unit="millimeter" 0.1
Assimp, to STL: up to 1
END
