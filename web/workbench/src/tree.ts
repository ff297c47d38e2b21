/** A tree of boxes over triangles, by which a line is tried against few of millions. */

/** Triangles of a leaf, about. */
const LEAF = 8;

export class Tree {
  /** Triangles that the last search tried. */
  tried = 0;
  /** Triangles from leaf to leaf. */
  private readonly order: Uint32Array;
  private readonly leaves: number;
  /** Lowest and highest x, y and z of each box. Box 1 holds all; the halves of box b are 2b and 2b + 1; the last ones are the leaves. */
  private readonly boxes: Float32Array;

  /** Over triangles of vertices `x`, three coordinates each. */
  constructor(private readonly x: Float32Array, private readonly triangles: Uint32Array) {
    const n = triangles.length / 3;
    this.leaves = 2 ** Math.max(0, Math.ceil(Math.log2(Math.max(1, n / LEAF))));
    this.boxes = new Float32Array(12 * this.leaves);
    const { low, high } = this.bounds(0, triangles.length);
    this.order = sorted(codes(x, triangles, low, high));
    // Boxes are a little larger than what they hold, so that rounding does not lose a line that grazes one.
    const more = 1e-6 * Math.hypot(...high.map((v, c) => v - low[c]));
    for (let leaf = 0; leaf < this.leaves; ++leaf) this.fill(leaf, more);
    for (let b = this.leaves - 1; b >= 1; --b)
      for (let c = 0; c < 6; ++c) {
        const p = this.boxes[12 * b + c], q = this.boxes[12 * b + 6 + c];
        this.boxes[6 * b + c] = c < 3 ? Math.min(p, q) : Math.max(p, q);
      }
  }

  /** The first triangle of a leaf in the order; that of the leaf behind the last is the number of triangles. */
  private first(leaf: number): number {
    return Math.floor((leaf * this.order.length) / this.leaves);
  }
  private bounds(from: number, to: number): { low: number[]; high: number[] } {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = from; i < to; ++i)
      for (let c = 0; c < 3; ++c) {
        const value = this.x[3 * this.triangles[i] + c];
        if (value < low[c]) low[c] = value;
        if (value > high[c]) high[c] = value;
      }
    return { low, high };
  }
  private fill(leaf: number, more: number): void {
    const { x, triangles, boxes } = this, at = 6 * (this.leaves + leaf);
    for (let c = 0; c < 3; ++c) {
      let low = Infinity, high = -Infinity;
      for (let k = this.first(leaf); k < this.first(leaf + 1); ++k)
        for (let i = 3 * this.order[k]; i < 3 * this.order[k] + 3; ++i) {
          const value = x[3 * triangles[i] + c];
          if (value < low) low = value;
          if (value > high) high = value;
        }
      boxes[at + c] = low - more;
      boxes[at + 3 + c] = high + more;
    }
  }

  /** The triangle that a line from `from` along the unit vector `along` meets first, further than `least`, and how far; nothing: none. */
  cross(from: number[], along: number[], least: number): { triangle: number; far: number } | undefined {
    const steep = along.map((v) => 1 / (Math.abs(v) > 1e-30 ? v : 1e-30)), waiting = [1];
    let far = Infinity, triangle = -1;
    this.tried = 0;
    while (waiting.length) {
      const box = waiting.pop()!;
      if (!(this.enters(box, from, steep, least) < far)) continue;
      if (box < this.leaves) {
        // The nearer half is looked at first: what is found there spares most of the other.
        const p = this.enters(2 * box, from, steep, least), q = this.enters(2 * box + 1, from, steep, least);
        waiting.push(...(p < q ? [2 * box + 1, 2 * box] : [2 * box, 2 * box + 1]));
        continue;
      }
      for (let k = this.first(box - this.leaves); k < this.first(box - this.leaves + 1); ++k) {
        const here = this.meets(this.order[k], from, along);
        if (here > least && here < far) {
          far = here;
          triangle = this.order[k];
        }
      }
    }
    return triangle < 0 ? undefined : { triangle, far };
  }

  /** How far a line is where it enters a box; infinite where it misses it, or has left it before `least`. */
  private enters(box: number, from: number[], steep: number[], least: number): number {
    let near = least, far = Infinity;
    for (let c = 0; c < 3; ++c) {
      const p = (this.boxes[6 * box + c] - from[c]) * steep[c], q = (this.boxes[6 * box + 3 + c] - from[c]) * steep[c];
      near = Math.max(near, Math.min(p, q));
      far = Math.min(far, Math.max(p, q));
    }
    return near <= far ? near : Infinity;
  }

  /** How far along the line a triangle is met; NaN where it is not. */
  private meets(triangle: number, from: number[], along: number[]): number {
    ++this.tried;
    const { x } = this, p = 3 * this.triangles[3 * triangle], q = 3 * this.triangles[3 * triangle + 1], r = 3 * this.triangles[3 * triangle + 2];
    const ux = x[q] - x[p], uy = x[q + 1] - x[p + 1], uz = x[q + 2] - x[p + 2];
    const vx = x[r] - x[p], vy = x[r + 1] - x[p + 1], vz = x[r + 2] - x[p + 2];
    const hx = along[1] * vz - along[2] * vy, hy = along[2] * vx - along[0] * vz, hz = along[0] * vy - along[1] * vx;
    const det = ux * hx + uy * hy + uz * hz;
    if (det === 0) return NaN;
    const sx = from[0] - x[p], sy = from[1] - x[p + 1], sz = from[2] - x[p + 2];
    const a = (sx * hx + sy * hy + sz * hz) / det;
    if (a < 0 || a > 1) return NaN;
    const gx = sy * uz - sz * uy, gy = sz * ux - sx * uz, gz = sx * uy - sy * ux;
    const b = (along[0] * gx + along[1] * gy + along[2] * gz) / det;
    return b < 0 || a + b > 1 ? NaN : (vx * gx + vy * gy + vz * gz) / det;
  }
}

/** Numbers of the cubes of a grid of 1024³ in which the middles of triangles lie, so that cubes next to each other have numbers close to
 * each other: the bits of x, y and z by turns (Morton's order). */
function codes(x: Float32Array, triangles: Uint32Array, low: number[], high: number[]): Uint32Array {
  const out = new Uint32Array(triangles.length / 3), scale = high.map((v, c) => 1023 / (3 * (v - low[c]) || 1));
  for (let t = 0; t < out.length; ++t) {
    let code = 0;
    for (let c = 0; c < 3; ++c) {
      const sum = x[3 * triangles[3 * t] + c] + x[3 * triangles[3 * t + 1] + c] + x[3 * triangles[3 * t + 2] + c];
      code |= apart(Math.max(0, Math.min(1023, Math.floor((sum - 3 * low[c]) * scale[c])))) << c;
    }
    out[t] = code;
  }
  return out;
}
/** Ten bits with two empty ones between neighbours. */
function apart(v: number): number {
  v = (v | (v << 16)) & 0x030000ff;
  v = (v | (v << 8)) & 0x0300f00f;
  v = (v | (v << 4)) & 0x030c30c3;
  return (v | (v << 2)) & 0x09249249;
}
/** The order in which numbers of thirty bits rise, by their digits of ten bits from the least on. */
function sorted(keys: Uint32Array): Uint32Array {
  let order = Uint32Array.from(keys, (_, i) => i), next = new Uint32Array(keys.length);
  for (let shift = 0; shift < 30; shift += 10) {
    const place = new Uint32Array(1025);
    for (const key of keys) ++place[((key >> shift) & 1023) + 1];
    for (let d = 0; d < 1024; ++d) place[d + 1] += place[d];
    for (const i of order) next[place[(keys[i] >> shift) & 1023]++] = i;
    [order, next] = [next, order];
  }
  return order;
}
