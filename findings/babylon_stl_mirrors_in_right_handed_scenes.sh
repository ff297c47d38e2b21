#!/usr/bin/env bash
# What:      Babylon.js' loader of STL exchanges y and z of every point, which mirrors the part. In a left-handed scene, Babylon's default,
#            the picture is right again, with z upwards on y. In a scene with useRightHandedSystem it is exchanged all the same: the part on
#            the screen is the mirror image. STLFileLoader.DO_NOT_ALTER_FILE_COORDINATES = true, for all loaders of the page, leaves it.
# Versions:  @babylonjs/core and @babylonjs/loaders 9.28.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   positions that are picked on the screen are not those of the file, and a left-hand part is shown for a right-hand one.
# Solidus:   draws its own meshes by three.js, right-handed and unchanged (web/report/src).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules @babylonjs/core=9.28.0 @babylonjs/loaders=9.28.0

said=$(in_node <<'SCRIPT'
import { createRequire } from "node:module";

console.log = () => {}; // of the engine, which greets
const load = createRequire(process.cwd() + "/");
const { NullEngine, Scene } = load("@babylonjs/core");
const { STLFileLoader } = load("@babylonjs/loaders/STL/index.js");
const part = `solid part
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 2 3
endloop
endfacet
endsolid part
`;
for (const unaltered of [false, true])
  for (const rightHanded of [false, true]) {
    STLFileLoader.DO_NOT_ALTER_FILE_COORDINATES = unaltered;
    const scene = new Scene(new NullEngine());
    scene.useRightHandedSystem = rightHanded;
    new STLFileLoader().importMesh(null, scene, part, "", []);
    const [mesh] = scene.meshes;
    mesh.computeWorldMatrix(true);
    const third = [...mesh.getVerticesData("position").slice(6, 9)];
    const turned = mesh.getWorldMatrix().isIdentity() ? "" : ", and moved";
    const hand = `${unaltered ? "unaltered, " : ""}${rightHanded ? "right" : "left"}-handed`;
    console.info(`${hand}: (0, 2, 3) is at (${third.join(", ")})${turned}`);
  }
process.exit();
SCRIPT
)
expect "$said" <<END
left-handed: (0, 2, 3) is at (0, 3, 2)
right-handed: (0, 2, 3) is at (0, 3, 2)
unaltered, left-handed: (0, 2, 3) is at (0, 2, 3)
unaltered, right-handed: (0, 2, 3) is at (0, 2, 3)
END
