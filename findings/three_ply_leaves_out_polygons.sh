#!/usr/bin/env bash
# What:      three.js' PLYLoader takes triangles and quadrilaterals of a .ply and leaves out every face of five corners or more, without a
#            word. A mesh of pentagons alone is a cloud of points.
# Versions:  three 0.187.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   cuts through tetrahedra and hexahedra, iso-surfaces and faces of polyhedra have pentagons and hexagons: the picture has holes.
# Solidus:   makes triangles of all that it hands to three.js (src/results/report).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules three=0.187.0

said=$(in_node <<'SCRIPT'
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";

// A plane piece of n corners.
const file = (n) => {
  const corners = Array.from({ length: n }, (_, i) => `${Math.cos((2 * Math.PI * i) / n)} ${Math.sin((2 * Math.PI * i) / n)} 0`);
  return ["ply", "format ascii 1.0", `element vertex ${n}`, ...["x", "y", "z"].map((axis) => `property float ${axis}`), "element face 1",
    "property list uchar int vertex_indices", "end_header", ...corners, [n, ...corners.keys()].join(" "), ""].join("\n");
};
for (const n of [3, 4, 5, 6]) {
  const geometry = new PLYLoader().parse(file(n));
  console.log(`${n} corners: ${geometry.getIndex() ? geometry.getIndex().count / 3 : "no"} triangles`);
}
SCRIPT
)
expect "$said" <<END
3 corners: 1 triangles
4 corners: 2 triangles
5 corners: no triangles
6 corners: no triangles
END
