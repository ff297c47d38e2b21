#!/usr/bin/env python3
"""Writes the crankshaft without its sand as STEP, for other programs: export_step.py [FILE]. Needs python3-gmsh."""
import pathlib
import sys

import gmsh

here = pathlib.Path(__file__).resolve().parent
gmsh.initialize()
gmsh.onelab.setNumber("with_sand", [0])
gmsh.open(str(here / "crankshaft.geo"))
gmsh.write(sys.argv[1] if len(sys.argv) > 1 else "crankshaft.step")
gmsh.finalize()
