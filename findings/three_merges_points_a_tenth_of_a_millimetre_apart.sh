#!/usr/bin/env bash
# What:      mergeVertices of three.js makes one point of all points that agree to 0.0001 in whatever unit. In metres that is 0.1 mm: of two
#            faces with a gap of 0.04 mm between them one is left. The tolerance is an argument, with that default; it is no distance but a
#            grid, so that points 0.08 mm apart are merged or not, by where they lie.
# Versions:  three 0.187.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   air gaps, coats and thin walls vanish from meshes in metres, the unit of glTF; what is left is not closed.
# Solidus:   its pages do not use it (web).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules three=0.187.0

said=$(in_node <<'SCRIPT'
import { BufferGeometry, Float32BufferAttribute } from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";

const left = (unit, gap, base = 0) => {
  const faces = [0, gap].flatMap((z) => [0, 0, base + z, 100, 0, base + z, 0, 100, base + z]);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(faces.map((x) => x * unit), 3));
  return mergeVertices(geometry).attributes.position.count;
};
console.log(`gap of 0.04 mm: ${left(1, 0.04)} of 6 points in mm, ${left(1e-3, 0.04)} in m`);
console.log(`gap of 0.08 mm in m: ${left(1e-3, 0.08)} points from 0, ${left(1e-3, 0.08, 0.06)} from 0.06 mm`);
SCRIPT
)
expect "$said" <<END
gap of 0.04 mm: 6 of 6 points in mm, 3 in m
gap of 0.08 mm in m: 6 points from 0, 3 from 0.06 mm
END
