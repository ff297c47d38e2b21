/** The picture of one run. */
import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, GLSL3, LineSegments, Mesh, RGBAFormat, Scene, ShaderMaterial,
  Vector2, Vector3, Vector4, WebGLRenderer,
} from "three";
import { Camera } from "./camera";
import { colourTable } from "./colours";
import { levelShape, planeShape, Shape, skinShape } from "./geometry";
import type { Field, Run } from "./run";

export type Shown = "shown" | "ghost" | "hidden";

/** What the user has chosen; all views share it. */
export interface Choice {
  field: string;
  map: string;
  bands: number;
  log: boolean;
  low: number;
  high: number;
  time: number;
  scale: number;
  shown: Map<string, Shown>;
  mesh: boolean;
  cut: { on: boolean; normal: [number, number, number]; at: number };
  only: { on: boolean; low: number; high: number };
  /** Of an axisymmetric section about its axis [rad]. */
  revolved: number;
}

const NONE = -1e30;

const VERTEX = `
in vec3 disp; in float value; in float angle;
uniform float scale;
out vec3 vPlace; out vec3 vEye; out vec3 vNormal; out float vValue; out float vThere;
vec3 turned(vec3 p, float a) { return vec3(p.x * cos(a) + p.z * sin(a), p.y, p.z * cos(a) - p.x * sin(a)); }
void main() {
  vPlace = position;
  vec3 p = turned(position + scale * disp, angle);
  vec4 eye = modelViewMatrix * vec4(p, 1.0);
  vEye = eye.xyz;
  vNormal = normalMatrix * turned(normal, angle);
  vThere = value > -1e29 ? 1.0 : 0.0;
  vValue = value > -1e29 ? value : 0.0;
  gl_Position = projectionMatrix * eye;
}`;

const FRAGMENT = `
precision highp float;
uniform sampler2D map;
uniform float low; uniform float high; uniform float bands; uniform bool logarithmic;
uniform vec4 cut; uniform bool cutting; uniform vec2 only; uniform bool onlyOn;
uniform int style; // 0: lit skin, 1: flat, 2: lit by the triangles themselves, 3: ghost, 4: line
uniform vec3 plain; uniform float opacity;
in vec3 vPlace; in vec3 vEye; in vec3 vNormal; in float vValue; in float vThere;
out vec4 colour;
void main() {
  if (cutting && dot(vPlace, cut.xyz) > cut.w) discard;
  bool there = vThere > 0.999;
  if (onlyOn && style != 2 && style != 3 && (!there || vValue < only.x || vValue > only.y)) discard;
  if (style == 4) { colour = vec4(plain, opacity); return; }
  if (style == 3) {
    float rim = 1.0 - abs(normalize(vNormal).z);
    colour = vec4(plain, opacity * (0.35 + 0.65 * rim));
    return;
  }
  float s = logarithmic ? log(max(vValue, low) / low) / log(high / low) : (vValue - low) / max(high - low, 1e-30);
  s = clamp(s, 0.0, 1.0);
  if (bands > 0.5) s = (min(floor(s * bands), bands - 1.0) + 0.5) / bands;
  vec3 c = there ? texture(map, vec2((s * 255.0 + 0.5) / 256.0, 0.5)).rgb : plain;
  float light = 1.0;
  if (style != 1) {
    vec3 n = style == 2 ? normalize(cross(dFdx(vEye), dFdy(vEye))) : normalize(vNormal);
    light = 0.62 + 0.38 * abs(dot(n, normalize(vec3(0.25, 0.35, 1.0))));
  }
  colour = vec4(c * light, 1.0);
}`;

/** A shape with what the graphics card knows of it. */
class Drawn {
  readonly mesh: Mesh;
  readonly features: LineSegments;
  readonly edges: LineSegments;
  readonly position: Float32Array;
  readonly disp: Float32Array;
  readonly value: Float32Array;
  private attributes: BufferAttribute[];

  constructor(readonly body: number, readonly shape: Shape, x: Float32Array, material: ShaderMaterial, line: ShaderMaterial) {
    const n = shape.a.length;
    this.position = new Float32Array(3 * n);
    this.disp = new Float32Array(3 * n);
    this.value = new Float32Array(n).fill(NONE);
    for (let i = 0; i < n; ++i)
      for (let c = 0; c < 3; ++c)
        this.position[3 * i + c] = (1 - shape.t[i]) * x[3 * shape.a[i] + c] + shape.t[i] * x[3 * shape.b[i] + c];
    this.attributes = [new BufferAttribute(this.disp, 3), new BufferAttribute(this.value, 1)];
    const common: [string, BufferAttribute][] = [
      ["position", new BufferAttribute(this.position, 3)],
      ["normal", new BufferAttribute(shape.normal, 3)],
      ["angle", new BufferAttribute(shape.angle ?? new Float32Array(n), 1)],
      ["disp", this.attributes[0]],
      ["value", this.attributes[1]],
    ];
    const geometry = (index: Uint32Array) => {
      const g = new BufferGeometry();
      for (const [name, attribute] of common) g.setAttribute(name, attribute);
      g.setIndex(new BufferAttribute(index, 1));
      return g;
    };
    this.mesh = new Mesh(geometry(shape.triangles), material);
    this.features = new LineSegments(geometry(shape.features), line);
    this.edges = new LineSegments(geometry(shape.edges), line);
    for (const each of [this.mesh, this.features, this.edges]) each.frustumCulled = false;
  }
  setValues(values: Float32Array): void {
    const { a, b, t } = this.shape;
    for (let i = 0; i < a.length; ++i) {
      const v = t[i] === 0 ? values[a[i]] : (1 - t[i]) * values[a[i]] + t[i] * values[b[i]];
      this.value[i] = Number.isFinite(v) ? v : NONE;
    }
    this.attributes[1].needsUpdate = true;
  }
  setDisplacement(parts: Float32Array[]): void {
    const { a, b, t } = this.shape;
    parts.forEach((part, c) => {
      for (let i = 0; i < a.length; ++i) {
        const v = t[i] === 0 ? part[a[i]] : (1 - t[i]) * part[a[i]] + t[i] * part[b[i]];
        this.disp[3 * i + c] = Number.isFinite(v) ? v : 0;
      }
    });
    this.attributes[0].needsUpdate = true;
  }
  dispose(): void {
    for (const each of [this.mesh, this.features, this.edges]) each.geometry.dispose();
  }
}

export interface Hit {
  body: number;
  node: number;
  /** As it lay in the beginning, in the plane of an axisymmetric section [m]. */
  place: [number, number, number];
  value: number;
  depth: number;
}

interface BodyShapes {
  skin?: Drawn;
  ghost?: Drawn;
  skinKey: string;
  cap?: Drawn;
  capKey: string;
  levels: Drawn[];
  levelKey: string;
}

export class View {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly materials: ShaderMaterial[];
  private readonly lines: ShaderMaterial;
  private readonly map = new DataTexture(colourTable("Viridis"), 256, 1, RGBAFormat);
  private readonly shapes: BodyShapes[];
  private mapName = "Viridis";
  private wanted = false;
  /** Called after each picture, for what lies over it. */
  drawn: () => void = () => {};

  constructor(readonly run: Run, readonly camera: Camera, readonly choice: Choice) {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.canvas = this.renderer.domElement;
    this.map.needsUpdate = true;
    const shared = {
      map: { value: this.map }, low: { value: 0 }, high: { value: 1 }, bands: { value: 0 }, logarithmic: { value: false },
      cut: { value: new Vector4() }, cutting: { value: false }, only: { value: { x: 0, y: 0 } }, onlyOn: { value: false },
      scale: { value: 1 },
    };
    const material = (style: number, extra: object) =>
      new ShaderMaterial({
        glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
        uniforms: { ...shared, style: { value: style }, plain: { value: new Vector3(0.6, 0.6, 0.62) }, opacity: { value: 1 } },
        ...extra,
      });
    const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 };
    this.materials = [
      material(0, behind), material(1, behind), material(2, behind),
      material(3, { transparent: true, depthWrite: false }),
    ];
    this.lines = material(4, { transparent: true });
    // Caps of a cut lie on it: rounding must not take them away.
    this.materials.push(material(1, { ...behind }));
    this.materials[4].uniforms = { ...this.materials[4].uniforms, cutting: { value: false } };
    this.shapes = run.bodies.map(() => ({ skinKey: "", capKey: "", levels: [], levelKey: "" }));
  }

  get moment(): number {
    return this.run.moment(this.choice.time);
  }
  get field(): Field | undefined {
    return this.run.fields.find((f) => f.id === this.choice.field);
  }
  state(body: number): Shown {
    if (!this.run.present(body, this.moment)) return "hidden";
    return this.choice.shown.get(this.run.bodies[body].name) ?? "shown";
  }
  /** The smallest box round the bodies that are shown: centre and half its diagonal. */
  bounds(): { centre: Vector3; radius: number; size: Vector3 } {
    const low = new Vector3(Infinity, Infinity, Infinity), high = new Vector3(-Infinity, -Infinity, -Infinity);
    const consider = (any: boolean) =>
      this.run.bodies.forEach((body, b) => {
        if (!any && this.state(b) === "hidden") return;
        const [l, u] = body.box;
        low.min(new Vector3(...l));
        high.max(new Vector3(...u));
      });
    consider(false);
    if (!(low.x <= high.x)) consider(true);
    if (this.choice.revolved > 0) {
      low.z = -high.x;
      if (this.choice.revolved > 1.6) low.x = -high.x;
      if (this.choice.revolved > 3.2) high.z = high.x;
    }
    const size = high.clone().sub(low);
    return { centre: low.clone().add(high).multiplyScalar(0.5), radius: size.length() / 2 || 1, size };
  }

  /** Rebuilds what the choice has changed and asks for a picture. */
  update(): void {
    const c = this.choice, dark = document.documentElement.dataset.theme === "dark";
    const uniforms = this.materials[0].uniforms;
    if (this.mapName !== c.map) {
      this.mapName = c.map;
      (this.map.image.data as Uint8Array).set(colourTable(c.map));
      this.map.needsUpdate = true;
    }
    const cutting = c.cut.on && this.run.dimension === 3;
    uniforms.low.value = c.low;
    uniforms.high.value = c.high;
    uniforms.bands.value = c.bands;
    uniforms.logarithmic.value = c.log && c.low > 0;
    uniforms.cut.value.set(...c.cut.normal, c.cut.at);
    uniforms.cutting.value = cutting;
    uniforms.only.value = { x: c.only.low, y: c.only.high };
    uniforms.onlyOn.value = c.only.on;
    uniforms.scale.value = c.scale;
    for (const m of this.materials) m.uniforms.plain.value.setScalar(dark ? 0.5 : 0.66);
    this.materials[3].uniforms.plain.value.set(...((dark ? [0.75, 0.8, 0.88] : [0.3, 0.36, 0.44]) as [number, number, number]));
    this.materials[3].uniforms.opacity.value = dark ? 0.2 : 0.22;
    this.lines.uniforms.plain.value.setScalar(dark ? 0.02 : 0.05);
    this.lines.uniforms.opacity.value = c.mesh ? 0.3 : 0.45;
    this.scene.clear();
    const field = this.field, m = this.moment;
    this.run.bodies.forEach((body, b) => {
      const state = this.state(b);
      if (state === "hidden") return;
      const values = field?.has(b) ? field.values(b, m) : new Float32Array(body.n).fill(NaN);
      const displacement = this.run.displacement.map((axis) => axis[b].at(m));
      const shapes = this.shapes[b];
      const drawn = this.shapesOf(b, shapes, values, state, cutting);
      for (const d of drawn) {
        d.setValues(values);
        d.setDisplacement(displacement);
        this.scene.add(d.mesh);
        if (d.mesh.material === this.materials[3]) continue;
        if (d.shape.features.length) this.scene.add(d.features);
        if (c.mesh) this.scene.add(d.edges);
      }
    });
    this.request();
  }

  private shapesOf(b: number, s: BodyShapes, values: Float32Array, state: Shown, cutting: boolean): Drawn[] {
    const body = this.run.bodies[b], c = this.choice, flat = this.run.dimension === 2;
    const skinKey = `${c.revolved}`;
    if (!s.skin || s.skinKey !== skinKey) {
      s.skin?.dispose();
      const shape = flat ? planeShape(body.x, body.cells, c.revolved) : skinShape(body.x, body.skin);
      s.skin = new Drawn(b, shape, body.x, this.materials[flat && c.revolved === 0 ? 1 : 0], this.lines);
      s.skinKey = skinKey;
      s.ghost = undefined;
    }
    const ghost = () => (s.ghost ??= new Drawn(b, s.skin!.shape, body.x, this.materials[3], this.lines));
    if (state === "ghost") return [ghost()];
    const out = [s.skin];
    if (c.only.on) out.push(ghost());
    if (flat || !body.hasCells) return out;
    const x = body.x;
    if (cutting) {
      const key = [...c.cut.normal, c.cut.at].join();
      if (s.capKey !== key) {
        s.cap?.dispose();
        const [nx, ny, nz] = c.cut.normal;
        const at = new Float32Array(body.n);
        for (let i = 0; i < body.n; ++i) at[i] = nx * x[3 * i] + ny * x[3 * i + 1] + nz * x[3 * i + 2];
        s.cap = new Drawn(b, levelShape(body.cells, at, c.cut.at, c.cut.normal), x, this.materials[4], this.lines);
        s.capKey = key;
      }
      if (s.cap) out.push(s.cap);
    }
    if (c.only.on) {
      const key = [c.only.low, c.only.high, c.field, this.field?.atEnd ? 0 : this.moment].join();
      if (s.levelKey !== key) {
        for (const d of s.levels) d.dispose();
        s.levels = [c.only.low, c.only.high].map(
          (level) => new Drawn(b, levelShape(body.cells, values, level), x, this.materials[2], this.lines),
        );
        s.levelKey = key;
      }
      out.push(...s.levels);
    }
    return out;
  }

  resize(): void {
    const box = this.canvas.parentElement!.getBoundingClientRect();
    const size = this.renderer.getSize(new Vector2());
    if (size.x === Math.max(1, box.width) && size.y === Math.max(1, box.height)) return;
    this.renderer.setSize(Math.max(1, box.width), Math.max(1, box.height), false);
    this.request();
  }
  request(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.render();
    });
  }
  render(): void {
    const w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    this.camera.apply(w, h);
    this.renderer.render(this.scene, this.camera.three);
    performance.mark("drawn");
    this.drawn();
  }

  private turned(p: [number, number, number], angle: number): [number, number, number] {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [p[0] * c + p[2] * s, p[1], p[2] * c - p[0] * s];
  }

  /** Pixels from the upper left corner of a place as it lay in the beginning, moved with its body. */
  project(place: ArrayLike<number>): [number, number] {
    const v = new Vector3(place[0], place[1], place[2] ?? 0).project(this.camera.three);
    return [((v.x + 1) / 2) * this.canvas.clientWidth, ((1 - v.y) / 2) * this.canvas.clientHeight];
  }

  /** What lies under a pixel: the foremost triangle that is not cut away. */
  pick(px: number, py: number): Hit | undefined {
    const w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    this.camera.apply(w, h);
    const e = this.camera.three.matrixWorldInverse.elements;
    const ex = ((px / w) * 2 - 1) * this.camera.three.right, ey = (1 - (py / h) * 2) * this.camera.three.top;
    const c = this.choice, cutting = c.cut.on && this.run.dimension === 3;
    let best: Hit | undefined;
    for (const object of this.scene.children) {
      const d = this.drawnOf(object as Mesh);
      if (!d) continue;
      const isCap = (object as Mesh).material === this.materials[4];
      const { triangles, angle } = d.shape;
      const eye = new Float32Array(3 * d.shape.a.length);
      for (let i = 0; i < d.shape.a.length; ++i) {
        let p: [number, number, number] = [0, 1, 2].map((k) => d.position[3 * i + k] + c.scale * d.disp[3 * i + k]) as [number, number, number];
        if (angle && angle[i] !== 0) p = this.turned(p, angle[i]);
        for (let k = 0; k < 3; ++k) eye[3 * i + k] = e[k] * p[0] + e[4 + k] * p[1] + e[8 + k] * p[2] + e[12 + k];
      }
      for (let t = 0; t < triangles.length; t += 3) {
        const [i, j, k] = [triangles[t], triangles[t + 1], triangles[t + 2]];
        const [ax, ay] = [eye[3 * i] - ex, eye[3 * i + 1] - ey];
        const [bx, by] = [eye[3 * j] - ex, eye[3 * j + 1] - ey];
        const [cx, cy] = [eye[3 * k] - ex, eye[3 * k + 1] - ey];
        const u = bx * cy - by * cx, v = cx * ay - cy * ax, s = ax * by - ay * bx;
        if (!((u >= 0 && v >= 0 && s >= 0) || (u <= 0 && v <= 0 && s <= 0)) || u + v + s === 0) continue;
        const weights = [u / (u + v + s), v / (u + v + s), s / (u + v + s)], corners = [i, j, k];
        const mix = (f: (corner: number) => number) => weights.reduce((sum, weight, q) => sum + weight * f(corners[q]), 0);
        const depth = mix((q) => eye[3 * q + 2]);
        if (best && depth <= best.depth) continue;
        const place = [0, 1, 2].map((axis) => mix((q) => d.position[3 * q + axis])) as [number, number, number];
        if (cutting && !isCap && place[0] * c.cut.normal[0] + place[1] * c.cut.normal[1] + place[2] * c.cut.normal[2] > c.cut.at) continue;
        const there = corners.every((q) => d.value[q] > NONE / 10);
        const value = there ? mix((q) => d.value[q]) : NaN;
        const isLevel = (object as Mesh).material === this.materials[2];
        if (c.only.on && !isLevel && !(value >= c.only.low && value <= c.only.high)) continue;
        let node = d.shape.a[i], least = Infinity;
        const x = this.run.bodies[d.body].x;
        for (const q of corners)
          for (const candidate of [d.shape.a[q], d.shape.b[q]]) {
            const far = Math.hypot(x[3 * candidate] - place[0], x[3 * candidate + 1] - place[1], x[3 * candidate + 2] - place[2]);
            if (far < least) [least, node] = [far, candidate];
          }
        best = { body: d.body, node, place, value, depth };
      }
    }
    return best;
  }
  private drawnOf(object: Mesh): Drawn | undefined {
    if (!(object instanceof Mesh) || object.material === this.materials[3]) return undefined;
    for (const s of this.shapes)
      for (const d of [s.skin, s.cap, ...s.levels]) if (d && d.mesh === object) return d;
    return undefined;
  }
  /** Triangles of what is on the screen. */
  get triangles(): number {
    return this.renderer.info.render.triangles;
  }
}
