#!/usr/bin/env bash
# What:      A cylinder of radius 0.05 and height 0.1, a casting in metres, is in Manifold a prism on a square of 64 % of its volume, and a
#            sphere of that radius an octahedron of 32 %. The number of segments follows from a shortest edge of 1 in whatever unit. In mm
#            the same two have 99.5 % and 98.2 %. setMinCircularEdgeLength, or the number of segments as argument, changes that.
# Versions:  manifold-3d 3.5.4 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   risers, sprues and cooling channels that are made in metres have a wrong modulus and volume, and look angular at most.
# Solidus:   makes bodies by Gmsh and OpenCASCADE, whose cylinders are exact and are divided by the size that the case asks for.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules manifold-3d=3.5.4

said=$(in_node <<'SCRIPT'
import load from "manifold-3d";

const module = await load();
module.setup();
const { Manifold } = module;
const percent = (body, exact) => `${((100 * body.volume()) / exact).toFixed(1)} %`;
const show = (unit, radius, height) => {
  const cylinder = Manifold.cylinder(height, radius), sphere = Manifold.sphere(radius);
  const volumes = [percent(cylinder, Math.PI * radius ** 2 * height), percent(sphere, (4 / 3) * Math.PI * radius ** 3)];
  console.log(`${unit}: cylinder ${cylinder.numVert() / 2} corners, ${volumes[0]}, sphere ${sphere.numVert()} corners, ${volumes[1]}`);
};
show("mm", 50, 100);
show("m", 0.05, 0.1);
module.setMinCircularEdgeLength(0.001);
show("m, edges from 0.001", 0.05, 0.1);
SCRIPT
)
expect "$said" <<END
mm: cylinder 36 corners, 99.5 %, sphere 326 corners, 98.2 %
m: cylinder 4 corners, 63.7 %, sphere 6 corners, 31.8 %
m, edges from 0.001: cylinder 36 corners, 99.5 %, sphere 326 corners, 98.2 %
END
