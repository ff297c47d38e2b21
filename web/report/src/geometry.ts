/** What is drawn: vertices that lie on nodes or between two of them, triangles and lines over them. */

/** A vertex lies at (1 − t) a + t b of two nodes; of a revolved plane it is turned about the axis. */
export interface Shape {
  a: Uint32Array;
  b: Uint32Array;
  t: Float32Array;
  normal: Float32Array;
  angle?: Float32Array;
  triangles: Uint32Array;
  /** Sharp edges and borders. */
  features: Uint32Array;
  /** Every edge of an element. */
  edges: Uint32Array;
}

const CREASE = Math.cos((38 * Math.PI) / 180);

/** The corner after corner i of a list of triangles, round the same triangle. */
const nextCorner = (i: number): number => (i % 3 === 2 ? i - 2 : i + 1);

/** For each edge, named by the corner where it begins in its triangle, the same edge of the neighbour; -1 where it has none. */
export function partners(skin: Uint32Array, n: number): Int32Array {
  const least = (i: number) => Math.min(skin[i], skin[nextCorner(i)]), most = (i: number) => Math.max(skin[i], skin[nextCorner(i)]);
  const first = new Uint32Array(n + 1); // edges in the order of their lesser node
  for (let i = 0; i < skin.length; ++i) ++first[least(i) + 1];
  for (let v = 0; v < n; ++v) first[v + 1] += first[v];
  const place = first.slice(0, n), edges = new Uint32Array(skin.length);
  for (let i = 0; i < skin.length; ++i) edges[place[least(i)]++] = i;
  const partner = new Int32Array(skin.length).fill(-1);
  for (let v = 0; v < n; ++v)
    for (let p = first[v]; p < first[v + 1]; ++p) {
      const i = edges[p];
      for (let q = p + 1; q < first[v + 1] && partner[i] < 0; ++q) {
        const j = edges[q];
        if (partner[j] >= 0 || most(j) !== most(i)) continue;
        partner[i] = j;
        partner[j] = i;
      }
    }
  return partner;
}

/** Unit normals of triangles, and twice their areas. */
function faceNormals(x: Float32Array, skin: Uint32Array): { face: Float32Array; area: Float32Array } {
  const face = new Float32Array(skin.length), area = new Float32Array(skin.length / 3);
  for (let f = 0; f < area.length; ++f) {
    const p = 3 * skin[3 * f], q = 3 * skin[3 * f + 1], r = 3 * skin[3 * f + 2];
    const ux = x[q] - x[p], uy = x[q + 1] - x[p + 1], uz = x[q + 2] - x[p + 2];
    const vx = x[r] - x[p], vy = x[r + 1] - x[p + 1], vz = x[r + 2] - x[p + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const size = Math.sqrt(nx * nx + ny * ny + nz * nz) || 1e-30;
    area[f] = size;
    face[3 * f] = nx / size;
    face[3 * f + 1] = ny / size;
    face[3 * f + 2] = nz / size;
  }
  return { face, area };
}

/** A skin with normals that are smooth but for sharp edges. */
export function skinShape(x: Float32Array, skin: Uint32Array): Shape {
  const { face, area } = faceNormals(x, skin), partner = partners(skin, x.length / 3);
  // Corners of neighbours that no sharp edge divides are one vertex.
  const root = new Uint32Array(skin.length);
  for (let i = 0; i < root.length; ++i) root[i] = i;
  const find = (i: number) => {
    while (root[i] !== i) i = root[i] = root[root[i]];
    return i;
  };
  const sharp = new Uint32Array(2 * skin.length), all = new Uint32Array(2 * skin.length);
  let nSharp = 0, nAll = 0;
  for (let i = 0; i < skin.length; ++i) {
    const o = partner[i], j = nextCorner(i);
    if (o < 0 || i < o) {
      all[nAll++] = i;
      all[nAll++] = j;
    }
    if (o > i) continue;
    const f = i - (i % 3), g = o - (o % 3); // first corners of both triangles: where their normals stand, too
    if (o < 0 || face[f] * face[g] + face[f + 1] * face[g + 1] + face[f + 2] * face[g + 2] < CREASE) {
      sharp[nSharp++] = i;
      sharp[nSharp++] = j;
      continue;
    }
    const same = skin[o] === skin[i];
    root[find(i)] = find(same ? o : nextCorner(o));
    root[find(j)] = find(same ? nextCorner(o) : o);
  }
  const vertex = new Int32Array(skin.length).fill(-1), nodes = new Uint32Array(skin.length), triangles = new Uint32Array(skin.length);
  let count = 0;
  for (let i = 0; i < skin.length; ++i) {
    const r = find(i);
    if (vertex[r] < 0) {
      vertex[r] = count;
      nodes[count++] = skin[i];
    }
    triangles[i] = vertex[r];
  }
  const normal = new Float32Array(3 * count);
  for (let i = 0; i < skin.length; ++i) {
    const f = i - (i % 3);
    for (let c = 0; c < 3; ++c) normal[3 * triangles[i] + c] += area[f / 3] * face[f + c];
  }
  for (let v = 0; v < normal.length; v += 3) {
    const size = Math.sqrt(normal[v] * normal[v] + normal[v + 1] * normal[v + 1] + normal[v + 2] * normal[v + 2]) || 1;
    for (let c = 0; c < 3; ++c) normal[v + c] /= size;
  }
  const vertices = (corners: Uint32Array) => corners.map((i) => triangles[i]);
  const a = nodes.slice(0, count);
  return {
    a, b: a, t: new Float32Array(count), normal, triangles,
    features: vertices(sharp.subarray(0, nSharp)), edges: vertices(all.subarray(0, nAll)),
  };
}

/** Edges that one triangle alone has, as they run round it. */
function border(triangles: Uint32Array, n: number): number[] {
  const open = new Map<number, [number, number]>();
  for (let i = 0; i < triangles.length; ++i) {
    const u = triangles[i], v = triangles[i % 3 === 2 ? i - 2 : i + 1];
    const key = u < v ? u * n + v : v * n + u;
    if (!open.delete(key)) open.set(key, [u, v]);
  }
  return [...open.values()].flat();
}

/** A plane body as it lies, or turned about the axis x = 0 by `angle` > 0, with its section at both ends. */
export function planeShape(x: Float32Array, cells: Uint32Array, angle: number): Shape {
  const n = x.length / 3;
  const rim = border(cells, n);
  const full = angle > 6.283;
  const a: number[] = [], turn: number[] = [], normal: number[] = [], triangles: number[] = [];
  const features: number[] = [], edges: number[] = [];
  const section = (at: number, side: number) => {
    const first = a.length;
    for (let i = 0; i < n; ++i) {
      a.push(i);
      turn.push(at);
      normal.push(0, 0, side);
    }
    for (const i of cells) triangles.push(first + i);
    for (const i of rim) features.push(first + i);
    for (let c = 0; c < cells.length; c += 3)
      for (let k = 0; k < 3; ++k) {
        const u = cells[c + k], v = cells[c + ((k + 1) % 3)];
        if (u < v) edges.push(first + u, first + v);
      }
  };
  if (angle === 0) {
    section(0, 1);
  } else {
    if (!full) {
      section(0, 1);
      section(angle, -1);
    }
    const steps = Math.max(4, Math.round(angle / (Math.PI / 36)));
    for (let e = 0; e < rim.length; e += 2) {
      const [u, v] = [rim[e], rim[e + 1]];
      if (Math.abs(x[3 * u]) < 1e-9 && Math.abs(x[3 * v]) < 1e-9) continue; // on the axis
      const ex = x[3 * v] - x[3 * u], ey = x[3 * v + 1] - x[3 * u + 1], size = Math.hypot(ex, ey) || 1;
      const first = a.length;
      for (let k = 0; k <= steps; ++k) {
        a.push(u, v);
        turn.push((angle * k) / steps, (angle * k) / steps);
        normal.push(ey / size, -ex / size, 0, ey / size, -ex / size, 0);
        if (k === 0) continue;
        const at = first + 2 * k;
        triangles.push(at - 2, at - 1, at, at - 1, at + 1, at);
      }
    }
  }
  const nodes = Uint32Array.from(a);
  return {
    a: nodes, b: nodes, t: new Float32Array(a.length), normal: Float32Array.from(normal), angle: Float32Array.from(turn),
    triangles: Uint32Array.from(triangles), features: Uint32Array.from(features), edges: Uint32Array.from(edges),
  };
}

/** The surface in a body of tetrahedra on which a number at its nodes is `level`; cells with a corner that has no
 * number are passed over. `normal` is one direction for all, or nothing for those of the triangles themselves. */
export function levelShape(cells: Uint32Array, at: Float32Array, level: number, normal?: number[]): Shape {
  const a: number[] = [], b: number[] = [], t: number[] = [];
  const triangles: number[] = [], edges: number[] = [];
  const put = (u: number, v: number) => {
    a.push(u);
    b.push(v);
    t.push((level - at[u]) / (at[v] - at[u]));
  };
  const over: number[] = [], under: number[] = [];
  for (let c = 0; c < cells.length; c += 4) {
    const s0 = at[cells[c]] > level, s1 = at[cells[c + 1]] > level;
    const s2 = at[cells[c + 2]] > level, s3 = at[cells[c + 3]] > level;
    if (s0 === s1 && s1 === s2 && s2 === s3) continue;
    over.length = under.length = 0;
    for (let k = 0; k < 4; ++k) (at[cells[c + k]] > level ? over : under).push(cells[c + k]);
    const first = a.length;
    if (over.length === 2) {
      put(over[0], under[0]);
      put(over[0], under[1]);
      put(over[1], under[1]);
      put(over[1], under[0]);
      triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
      edges.push(first, first + 1, first + 1, first + 2, first + 2, first + 3, first + 3, first);
    } else {
      const [one, three] = over.length === 1 ? [over, under] : [under, over];
      for (const other of three) put(one[0], other);
      triangles.push(first, first + 1, first + 2);
      edges.push(first, first + 1, first + 1, first + 2, first + 2, first);
    }
  }
  const out = new Float32Array(3 * a.length);
  if (normal) for (let i = 0; i < a.length; ++i) out.set(normal, 3 * i);
  // NaN compares as "not over": a crossing with it has no place.
  const bad = t.some((v) => !Number.isFinite(v));
  const keep = (list: number[], size: number) => {
    if (!bad) return Uint32Array.from(list);
    const kept: number[] = [];
    for (let i = 0; i < list.length; i += size) {
      const group = list.slice(i, i + size);
      if (group.every((v) => Number.isFinite(t[v]))) kept.push(...group);
    }
    return Uint32Array.from(kept);
  };
  return {
    a: Uint32Array.from(a), b: Uint32Array.from(b), t: Float32Array.from(t, (v) => (Number.isFinite(v) ? v : 0)),
    normal: out, triangles: keep(triangles, 3), features: new Uint32Array(), edges: keep(edges, 2),
  };
}

/** Values along the straight line from p to q, exactly: [distance, value] where it passes through cells. */
export function alongLine(
  x: Float32Array, cells: Uint32Array, corners: number, values: Float32Array, p: number[], q: number[],
): [number, number][] {
  const d = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
  const length = Math.hypot(d[0], d[1], d[2]);
  const out: [number, number][] = [];
  const low = new Float64Array(corners), slope = new Float64Array(corners);
  const dim = corners - 1;
  const box = [0, 1, 2].map((i) => [Math.min(p[i], q[i]) - 1e-9, Math.max(p[i], q[i]) + 1e-9]);
  for (let c = 0; c < cells.length; c += corners) {
    let outside = false;
    for (let i = 0; i < dim && !outside; ++i) {
      let least = Infinity, most = -Infinity;
      for (let k = 0; k < corners; ++k) {
        const v = x[3 * cells[c + k] + i];
        least = Math.min(least, v);
        most = Math.max(most, v);
      }
      outside = most < box[i][0] || least > box[i][1];
    }
    if (outside || !barycentric(x, cells, c, corners, p, d, low, slope)) continue;
    let from = 0, to = 1;
    for (let k = 0; k < corners; ++k) {
      if (Math.abs(slope[k]) < 1e-14) {
        if (low[k] < -1e-9) from = 2;
      } else if (slope[k] > 0) from = Math.max(from, -low[k] / slope[k]);
      else to = Math.min(to, -low[k] / slope[k]);
    }
    if (to - from < 1e-9) continue;
    for (const s of [from, to]) {
      let value = 0;
      for (let k = 0; k < corners; ++k) value += (low[k] + s * slope[k]) * values[cells[c + k]];
      out.push([s * length, value]);
    }
  }
  return out.sort((u, v) => u[0] - v[0]);
}

/** Barycentric coordinates of p and their change along d. */
function barycentric(
  x: Float32Array, cells: Uint32Array, c: number, corners: number, p: number[], d: number[], low: Float64Array, slope: Float64Array,
): boolean {
  const o = 3 * cells[c];
  const edge = (k: number) => {
    const i = 3 * cells[c + k];
    return [x[i] - x[o], x[i + 1] - x[o + 1], x[i + 2] - x[o + 2]];
  };
  const r = [p[0] - x[o], p[1] - x[o + 1], p[2] - x[o + 2]];
  const cross = (u: number[], v: number[]) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const dot = (u: number[], v: number[]) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const e1 = edge(1), e2 = edge(2), e3 = corners === 4 ? edge(3) : [0, 0, 1];
  const n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
  const volume = dot(e1, n1);
  if (volume === 0) return false;
  const duals = [n1, n2, n3];
  low[0] = 1;
  slope[0] = 0;
  for (let k = 1; k < corners; ++k) {
    low[k] = dot(duals[k - 1], r) / volume;
    slope[k] = dot(duals[k - 1], d) / volume;
    low[0] -= low[k];
    slope[0] -= slope[k];
  }
  return true;
}
