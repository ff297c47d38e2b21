#!/usr/bin/env bash
# What:      a STEP file whose lengths are in inches comes out of Gmsh in millimetres: 1 x 2 x 3 is 25.4 x 50.8 x 76.2. The kernel
#            converts by the file's own unit. Who knows that the drawing is in inches and scales the mesh by 25.4 does it twice.
# Versions:  Gmsh 4.8.4 with OpenCASCADE 7.6.3 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64; Gmsh 4.13.1 of Debian 13 too
# Matters:   a casting 25 times too large freezes 645 times more slowly.
# Solidus:   reads the unit in the file, prints it, and refuses a unit that contradicts it (docs/guide/formats.md, tests/unit/mesh/units).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-gmsh=4.8.4+ds2-3

said=$(inside python3 - <<'PYTHON' | tail -n 1
import gmsh

MILLIMETRE = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )"
INCH = "( CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9002) )"
SAYS_WHAT_AN_INCH_IS = f"""#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9003);
#9002 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);
#9003 = {MILLIMETRE};
ENDSEC;
END-ISO"""

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 1, 2, 3)
gmsh.model.occ.synchronize()
gmsh.write("/tmp/part.step")
text = open("/tmp/part.step").read().replace(MILLIMETRE, INCH).replace("ENDSEC;\nEND-ISO", SAYS_WHAT_AN_INCH_IS)
with open("/tmp/part.step", "w") as file:
    file.write(text)
gmsh.clear()
gmsh.model.occ.importShapes("/tmp/part.step")
gmsh.model.occ.synchronize()
print("1 x 2 x 3 inches:", *(f"{x:.1f}" for x in gmsh.model.getBoundingBox(3, 1)[3:]))
PYTHON
)
expect "$said" <<<"1 x 2 x 3 inches: 25.4 50.8 76.2"
