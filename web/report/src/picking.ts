/** What lies under a pixel. */
import { type Drawn, NONE } from "./drawn";
import type { Camera } from "./camera";

export interface Hit {
  body: number;
  node: number;
  /** As it lay in the beginning, in the plane of an axisymmetric section [m]. */
  place: [number, number, number];
  value: number;
  depth: number;
}

/** A shape in the picture, and what of it counts. */
export interface Target {
  drawn: Drawn;
  /** Places of the body's nodes. */
  x: Float32Array;
  /** Whether a place is drawn: not cut away, its value not left out. */
  there(place: ArrayLike<number>, value: number): boolean;
}

/** Places of the vertices as the camera sees them: [vertex][3], moved by `scale` times their displacements. */
function seen(d: Drawn, scale: number, e: ArrayLike<number>): Float32Array {
  const { position, disp } = d, { angle, a } = d.shape;
  const eye = new Float32Array(3 * a.length);
  for (let i = 0; i < eye.length; i += 3) {
    let x = position[i] + scale * disp[i], z = position[i + 2] + scale * disp[i + 2];
    const y = position[i + 1] + scale * disp[i + 1], turn = angle ? angle[i / 3] : 0;
    if (turn !== 0) {
      const c = Math.cos(turn), s = Math.sin(turn), r = x;
      x = r * c + z * s;
      z = z * c - r * s;
    }
    for (let k = 0; k < 3; ++k) eye[i + k] = e[k] * x + e[4 + k] * y + e[8 + k] * z + e[12 + k];
  }
  return eye;
}

/** The foremost triangle at (px, py) pixels of a picture of width × height that is there. */
export function pick(targets: Target[], camera: Camera, scale: number, px: number, py: number, width: number, height: number): Hit | undefined {
  camera.apply(width, height);
  const ex = ((px / width) * 2 - 1) * camera.three.right, ey = (1 - (py / height) * 2) * camera.three.top;
  let best: Hit | undefined;
  for (const { drawn: d, x, there } of targets) {
    const { triangles, a, b } = d.shape, eye = seen(d, scale, camera.three.matrixWorldInverse.elements);
    for (let t = 0; t < triangles.length; t += 3) {
      const i = triangles[t], j = triangles[t + 1], k = triangles[t + 2];
      const ax = eye[3 * i] - ex, ay = eye[3 * i + 1] - ey, bx = eye[3 * j] - ex, by = eye[3 * j + 1] - ey;
      const cx = eye[3 * k] - ex, cy = eye[3 * k + 1] - ey;
      const u = bx * cy - by * cx, v = cx * ay - cy * ax, s = ax * by - ay * bx;
      if (!((u >= 0 && v >= 0 && s >= 0) || (u <= 0 && v <= 0 && s <= 0)) || u + v + s === 0) continue;
      const corners = [i, j, k], weights = [u / (u + v + s), v / (u + v + s), s / (u + v + s)];
      const mix = (values: Float32Array, size: number, axis: number) => corners.reduce((sum, q, n) => sum + weights[n] * values[size * q + axis], 0);
      const depth = mix(eye, 3, 2);
      if ((best && depth <= best.depth) || corners.some((q) => d.gone(q))) continue;
      const place = [0, 1, 2].map((axis) => mix(d.position, 3, axis)) as [number, number, number];
      const value = corners.every((q) => d.value[q] > NONE / 10) ? mix(d.value, 1, 0) : NaN;
      if (!there(place, value)) continue;
      let node = a[i], least = Infinity;
      for (const q of corners)
        for (const candidate of [a[q], b[q]]) {
          const far = Math.hypot(x[3 * candidate] - place[0], x[3 * candidate + 1] - place[1], x[3 * candidate + 2] - place[2]);
          if (far < least) [least, node] = [far, candidate];
        }
      best = { body: d.body, node, place, value, depth };
    }
  }
  return best;
}
