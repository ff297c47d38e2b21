#!/usr/bin/env bash
# What:      of a .geo whose last line has no end of line Gmsh runs the first statement of that line and drops the others, without a word.
#            A script that an editor or a program wrote in one line has one point and no volume.
# Versions:  Gmsh 4.8.4 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64; Gmsh 4.13.1 of Debian 13 too
# Matters:   bodies are missing, and the message that follows speaks of something else.
# Solidus:   reads such a script to its end (OneLineWithoutItsEndIsReadLikeAnyOther in tests/unit/mesh/gmsh_script_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-gmsh=4.8.4+ds2-3

said=$(inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for what, end in (("without", ""), ("with", "\n")):
    with open("/tmp/line.geo", "w") as file:
        file.write("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2};" + end)
    gmsh.clear()
    gmsh.open("/tmp/line.geo")
    gmsh.model.geo.synchronize()
    print(what, "an end of line:", len(gmsh.model.getEntities(0)), "points,", len(gmsh.model.getEntities(1)), "lines")
PYTHON
)
expect "$said" <<END
without an end of line: 1 points, 0 lines
with an end of line: 2 points, 1 lines
END
