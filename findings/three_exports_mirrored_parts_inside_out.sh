#!/usr/bin/env bash
# What:      a mesh of three.js that is mirrored by a negative scale is drawn right, as the renderer turns its triangles. The exporters of
#            STL and OBJ write its triangles as they are: normals outwards, corners the other way round, and a negative volume.
# Versions:  three 0.187.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   the other hand of a part, or its second half, is exported so; a program that goes by the corners takes metal for cavity.
# Solidus:   its pages export no STL and no OBJ.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules three=0.187.0

said=$(in_node <<'SCRIPT'
import { BoxGeometry, Mesh, Vector3 } from "three";
import { OBJExporter } from "three/addons/exporters/OBJExporter.js";
import { STLExporter } from "three/addons/exporters/STLExporter.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

const volume = (geometry) => {
  const points = geometry.attributes.position;
  const corner = (n) => new Vector3().fromBufferAttribute(points, n);
  let six = 0;
  for (let n = 0; n < points.count; n += 3) six += corner(n).dot(corner(n + 1).cross(corner(n + 2)));
  return six / 6;
};
const part = new Mesh(new BoxGeometry(1, 2, 3));
for (const scale of [1, -1]) {
  part.scale.x = scale;
  part.updateMatrixWorld(true);
  const stl = new STLLoader().parse(new STLExporter().parse(part));
  const obj = new OBJLoader().parse(new OBJExporter().parse(part)).children[0].geometry;
  console.log(`x times ${scale}: volume of the STL ${volume(stl)}, of the OBJ ${volume(obj)}`);
}
SCRIPT
)
expect "$said" <<END
x times 1: volume of the STL 6, of the OBJ 6
x times -1: volume of the STL -6, of the OBJ -6
END
