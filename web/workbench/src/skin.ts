/** Skins of parts and bodies: unpacked, and asked where a line meets them. */
import { partners, skinShape, type Shape } from "../../report/src/geometry";
import type { Place } from "./state";
import { Tree } from "./tree";

/** A body of a skin: triangles of its own with smooth normals, and the face of each. */
export interface SkinBody {
  name: string;
  shape: Shape;
  /** Places of the vertices of the shape [m]. */
  position: Float32Array;
  /** Number of the face of each triangle, from one; 0: not known. */
  faces: Int32Array;
  /** Borders of faces, or sharp edges where faces have no numbers: pairs of vertices. */
  lines: Uint32Array;
  /** Its triangles, to find where lines meet them. */
  tree: Tree;
  low: Place;
  high: Place;
}

/** Reads the block of bytes that the server packs. */
export function unpack(block: ArrayBuffer): SkinBody[] {
  const all = new Uint8Array(block);
  const end = all.indexOf(10) + 1;
  const head = JSON.parse(new TextDecoder().decode(all.subarray(0, end))) as { nodes: number; triangles: number; names: string[] };
  let at = end;
  const take = <T>(make: (buffer: ArrayBuffer, offset: number, length: number) => T, length: number): T => {
    const part = make(block, at, length);
    at += 4 * length;
    return part;
  };
  const x = take((b, o, n) => new Float32Array(b, o, n), 3 * head.nodes);
  const triangles = take((b, o, n) => new Uint32Array(b, o, n), 3 * head.triangles);
  const faces = take((b, o, n) => new Int32Array(b, o, n), head.triangles);
  const bodies = take((b, o, n) => new Int32Array(b, o, n), head.triangles);
  return head.names.map((name, body) => one(name, x, triangles, faces, bodies, body));
}

function one(name: string, x: Float32Array, all: Uint32Array, allFaces: Int32Array, bodies: Int32Array, body: number): SkinBody {
  let n = 0;
  for (const b of bodies) if (b === body) ++n;
  const corners = new Uint32Array(3 * n), faces = new Int32Array(n);
  for (let t = 0, k = 0; t < bodies.length; ++t) {
    if (bodies[t] !== body) continue;
    corners.set(all.subarray(3 * t, 3 * t + 3), 3 * k);
    faces[k++] = allFaces[t];
  }
  const shape = skinShape(x, corners);
  const position = new Float32Array(3 * shape.a.length);
  const low: Place = [Infinity, Infinity, Infinity], high: Place = [-Infinity, -Infinity, -Infinity];
  shape.a.forEach((node, v) => {
    for (let c = 0; c < 3; ++c) {
      const value = (position[3 * v + c] = x[3 * node + c]);
      low[c] = Math.min(low[c], value);
      high[c] = Math.max(high[c], value);
    }
  });
  return { name, shape, position, faces, lines: bordersOf(corners, faces, shape, x.length / 3), tree: new Tree(position, shape.triangles), low, high };
}

/** Edges between triangles of different faces; sharp edges where faces have no numbers. */
function bordersOf(corners: Uint32Array, faces: Int32Array, shape: Shape, nodes: number): Uint32Array {
  if (!faces.some((f) => f > 0)) return shape.features;
  const other = partners(corners, nodes), out: number[] = [];
  for (let i = 0; i < corners.length; ++i)
    if (other[i] > i && faces[(other[i] / 3) | 0] !== faces[(i / 3) | 0]) out.push(shape.triangles[i], shape.triangles[i % 3 === 2 ? i - 2 : i + 1]);
  return Uint32Array.from(out);
}

/** A coarse skin of a body for pictures that move: vertices within one cube of a grid become one, at the first of them. */
export function coarse(body: SkinBody, cubes: number): { position: Float32Array; normal: Float32Array; triangles: Uint32Array } {
  const { position: x, shape } = body, n = x.length / 3;
  const edge = Math.max(...[0, 1, 2].map((i) => body.high[i] - body.low[i])) / cubes || 1;
  const cell = (i: number, axis: number) => Math.floor((x[3 * i + axis] - body.low[axis]) / edge);
  const first = new Map<number, number>(), of = new Uint32Array(n), kept: number[] = [];
  for (let i = 0; i < n; ++i) {
    const key = (cell(i, 0) * (cubes + 2) + cell(i, 1)) * (cubes + 2) + cell(i, 2), known = first.get(key);
    if (known === undefined) {
      first.set(key, kept.length);
      of[i] = kept.length;
      kept.push(i);
    } else of[i] = known;
  }
  const triangles: number[] = [];
  for (let t = 0; t < shape.triangles.length; t += 3) {
    const [p, q, r] = [of[shape.triangles[t]], of[shape.triangles[t + 1]], of[shape.triangles[t + 2]]];
    if (p !== q && q !== r && r !== p) triangles.push(p, q, r);
  }
  const take = (values: Float32Array) => Float32Array.from({ length: 3 * kept.length }, (_, k) => values[3 * kept[Math.floor(k / 3)] + (k % 3)]);
  return { position: take(x), normal: take(shape.normal), triangles: Uint32Array.from(triangles) };
}

export interface Crossing { triangle: number; far: number; place: Place; normal: Place }

/** Where a line from `from` along the unit vector `along` meets a body first, further than `least` [m]. */
export function cross(body: SkinBody, from: Place, along: Place, least: number): Crossing | undefined {
  const met = body.tree.cross(from, along, least);
  return met && { ...met, place: [0, 1, 2].map((c) => from[c] + met.far * along[c]) as Place, normal: normalOf(body, met.triangle) };
}

/** The unit normal of a triangle, outward. */
export function normalOf({ position: x, shape: { triangles } }: SkinBody, triangle: number): Place {
  const [p, q, r] = [0, 1, 2].map((k) => 3 * triangles[3 * triangle + k]);
  const u = [0, 1, 2].map((c) => x[q + c] - x[p + c]), v = [0, 1, 2].map((c) => x[r + c] - x[p + c]);
  const n: Place = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const size = Math.hypot(...n) || 1;
  return [n[0] / size, n[1] / size, n[2] / size];
}
