/** The picture: bodies by their roles, what is placed on them, a face that is pointed to, and marks of findings. */
import {
  Box3, BoxGeometry, BufferAttribute, BufferGeometry, CylinderGeometry, DoubleSide, GLSL3, Group, LineSegments, Mesh, Scene, ShaderMaterial, SphereGeometry,
  Vector3, WebGLRenderer, type Material,
} from "three";
import { Camera } from "../../report/src/camera";
import { Painter } from "../../report/src/painter";
import { coarse, cross, type Crossing, type SkinBody } from "./skin";
import type { Choices, Gating, Place, Preview, Riser } from "./state";

export interface Pick extends Crossing { body: number }
export type Shown = "shown" | "ghost" | "hidden";

/** Colours of roles, which read on light and on dark. */
export const ROLE_COLOURS: Record<string, string> = {
  casting: "#8f9db0", riser: "#e08a3c", gating: "#b07ac4", mould: "#c9b48a", core: "#b58f5a", chill: "#3f86c9", sleeve: "#5fae7d", die: "#76808c", insulation: "#d8c3d8",
};
const OTHER = "#9aa3ad";
/** Skins of so many triangles have a coarse copy. */
const LARGE = 200_000;
const ACCENT = "#ff6a1f";

// Colours go to the screen as they are, so that pictures and drafts of them, which the painter makes in two ways, look alike.
const VERTEX = `
out vec3 vNormal;
void main() { vNormal = normalMatrix * normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const FRAGMENT = `
precision highp float;
uniform vec3 colour; uniform float opacity; uniform bool lit;
in vec3 vNormal; out vec4 result;
void main() {
  float light = lit ? 0.6 + 0.4 * abs(dot(normalize(vNormal), normalize(vec3(0.25, 0.35, 1.0)))) : 1.0;
  result = vec4(colour * light, opacity);
}`;

/** A surface or line of one colour, "#rrggbb". */
function paint(colour: string, opacity = 1, lit = true): ShaderMaterial {
  const rgb = new Vector3(...([1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255) as [number, number, number]));
  return new ShaderMaterial({
    glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide, transparent: opacity < 1, depthWrite: opacity > 0.5,
    uniforms: { colour: { value: rgb }, opacity: { value: opacity }, lit: { value: lit } },
    ...(opacity === 1 && lit ? { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 } : {}),
  });
}

export class Picture {
  readonly canvas: HTMLCanvasElement;
  readonly camera = new Camera();
  bodies: SkinBody[] = [];
  private roles: string[] = [];
  private shown: Shown[] = [];
  private lit = new Set<string>();
  /** Nothing where the browser has no WebGL: then there is no picture, and all else of the page goes on. */
  private readonly renderer?: WebGLRenderer;
  private readonly painter?: Painter;
  private readonly scene = new Scene();
  private readonly things = new Group();
  /** What is drawn in place of large skins while the picture moves, where pictures are slow. */
  private readonly rough = new Group();
  private roughOf: (BufferGeometry | undefined)[] = [];
  /** What the graphics card keeps of each body, however it is dressed. */
  private skins: { surface: BufferGeometry; lines: BufferGeometry; edges: BufferGeometry }[] = [];
  /** Whether every edge of an element is drawn, or the borders of faces alone. */
  private elements = false;
  private readonly placed = new Group();
  private placedOf = "";
  private readonly pointed = new Group();
  private wanted = 0;
  private moving = false;
  /** Whether a finger or button is held on the picture: one that is slow then stays rough, though it may rest for a while. */
  held = false;
  /** Called behind each picture, for what lies over it. */
  drawn: () => void = () => {};

  constructor() {
    try {
      this.renderer = new WebGLRenderer({ antialias: false, preserveDrawingBuffer: true, alpha: true });
      this.painter = new Painter(this.renderer);
    } catch {
      this.renderer = undefined;
    }
    this.canvas = this.renderer?.domElement ?? document.createElement("canvas");
    this.camera.up.set(0, 0, 1);
    this.camera.look(this.camera.corner);
    this.scene.add(this.things, this.rough, this.placed, this.pointed);
  }

  get canDraw(): boolean {
    return this.painter !== undefined;
  }

  /** Other bodies; the camera goes to them where `fit`. */
  load(bodies: SkinBody[], fit: boolean): void {
    this.bodies = bodies;
    this.roles = bodies.map(() => "");
    this.shown = bodies.map(() => "shown");
    empty(this.pointed);
    for (const geometry of this.roughOf) geometry?.dispose();
    for (const { surface, lines, edges } of this.skins) for (const geometry of [surface, lines, edges]) geometry.dispose();
    this.roughOf = bodies.map((body) => {
      if (body.faces.length < LARGE) return undefined;
      const { position, normal, triangles } = coarse(body, 72);
      return surfaceOf(position, normal, triangles);
    });
    this.skins = bodies.map((body) => {
      const surface = surfaceOf(body.position, body.shape.normal, body.shape.triangles);
      const [lines, edges] = [body.lines, body.shape.edges].map((pairs) => {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", surface.getAttribute("position"));
        geometry.setIndex(new BufferAttribute(pairs, 1));
        return geometry;
      });
      return { surface, lines, edges };
    });
    this.painter?.forget();
    this.build();
    if (fit) this.fit();
  }

  /** Roles of the bodies by name, how each is shown, and which are lit up. */
  dress(roles: Record<string, string>, shown: Record<string, Shown>, lit: string[]): void {
    const next = this.bodies.map((b) => roles[b.name] ?? ""), seen = this.bodies.map((b) => shown[b.name] ?? "shown");
    const same = String(next) === String(this.roles) && String(seen) === String(this.shown) && String(lit) === String([...this.lit]);
    if (same) return;
    this.roles = next;
    this.shown = seen;
    this.lit = new Set(lit);
    this.build();
  }

  private build(): void {
    empty(this.things, true);
    empty(this.rough, true);
    const dark = document.documentElement.dataset.theme === "dark";
    this.bodies.forEach((body, b) => {
      if (this.shown[b] === "hidden") return;
      const ghost = this.shown[b] === "ghost", lit = this.lit.has(body.name);
      const colour = lit ? ACCENT : (ROLE_COLOURS[this.roles[b]] ?? OTHER);
      const { surface, lines, edges } = this.skins[b], look = paint(colour, ghost ? (lit ? 0.4 : 0.13) : 1);
      this.things.add(plain(new Mesh(surface, look)));
      this.rough.add(plain(new Mesh(this.roughOf[b] ?? surface, look)));
      this.things.add(plain(new LineSegments(this.elements ? edges : lines, paint(dark ? "#0c0f13" : "#2a3038", ghost ? 0.25 : 0.6, false))));
    });
    this.request();
  }

  /** Draws every edge of an element, or no longer; whether it does now. */
  toggleElements(): boolean {
    this.elements = !this.elements;
    this.build();
    return this.elements;
  }

  /** Drawn anew in the colours of the theme. */
  recolour(): void {
    this.build();
  }

  /** What is placed and not yet in the mesh: risers, gating, chills, probes and the gate. */
  place(choices: Choices | null, preview: Preview | null = null): void {
    const size = this.size(), key = JSON.stringify([choices, preview, this.box()]);
    if (key === this.placedOf) return; // news of other things ask for no picture
    this.placedOf = key;
    empty(this.placed);
    const add = (mesh: Mesh, at: Place) => {
      mesh.position.set(...at);
      this.placed.add(plain(mesh));
    };
    const look = (colour: string) => paint(colour, 0.75);
    for (const r of choices?.riser === "placed" ? choices.risers : []) {
      const mesh = new Mesh(new CylinderGeometry(r.diameter / 2, r.diameter / 2, r.height, 48), look(ROLE_COLOURS.riser));
      mesh.rotateX(Math.PI / 2);
      add(mesh, [r.foot[0], r.foot[1], r.foot[2] + r.height / 2]);
      if (r.sleeve) {
        const from = r.foot[2] + (r.neck_height ?? 0), high = r.foot[2] + r.height - from;
        const sleeve = new Mesh(new CylinderGeometry(r.diameter / 2 + r.sleeve, r.diameter / 2 + r.sleeve, high, 48), paint(ROLE_COLOURS.sleeve, 0.35));
        sleeve.rotateX(Math.PI / 2);
        add(sleeve, [r.foot[0], r.foot[1], from + high / 2]);
      }
      if (r.neck_to) this.neck(r, r.neck_to, look(ROLE_COLOURS.riser));
    }
    for (const g of choices?.gatings ?? []) this.gating(g, look(ROLE_COLOURS.gating));
    for (const c of choices?.riser === "placed" ? choices.chills : []) {
      const d = [0, 1, 2].map((i) => c.highest[i] - c.lowest[i]);
      add(new Mesh(new BoxGeometry(d[0], d[1], d[2]), look(ROLE_COLOURS.chill)), [0, 1, 2].map((i) => (c.highest[i] + c.lowest[i]) / 2) as Place);
    }
    if (preview) this.ahead(preview, choices?.riser === "auto");
    for (const p of choices?.probes ?? []) add(new Mesh(new SphereGeometry(size / 90, 20, 14), look("#d03a8c")), p.point);
    // The plane of symmetry, in the middle of the part: `new` keeps what lies below it.
    const { low, high } = this.box(), axis = "xyz".indexOf(choices?.symmetry || "-");
    if (axis >= 0) {
      const d = [0, 1, 2].map((i) => (i === axis ? size / 2000 : 1.15 * (high[i] - low[i])));
      add(new Mesh(new BoxGeometry(d[0], d[1], d[2]), paint("#2f8fd0", 0.3)), [0, 1, 2].map((i) => (low[i] + high[i]) / 2) as Place);
    }
    if (choices?.gate) add(new Mesh(new SphereGeometry(size / 60, 20, 14), look("#7b3fb5")), choices.gate);
    if (this.bodies.length && this.reachesOut()) this.fit();
    this.request();
  }

  /** The mould that would be made, as glass with lines as far apart as its elements are long, and the risers of the rule. */
  private ahead(p: Preview, risers: boolean): void {
    const d = [0, 1, 2].map((i) => p.high[i] - p.low[i]), middle = new Vector3(...[0, 1, 2].map((i) => (p.high[i] + p.low[i]) / 2));
    if (p.walls) {
      const glass = plain(new Mesh(new BoxGeometry(d[0], d[1], d[2]), paint(ROLE_COLOURS.mould, 0.13)));
      glass.position.copy(middle);
      const n = d.map((length) => Math.min(60, Math.max(1, Math.round(length / p.mould_size)))), ends: number[] = [];
      for (const [i, j, k] of [[0, 1, 2], [1, 2, 0], [2, 0, 1]]) // lines along i, on the faces that j and k are normal to
        for (const [across, other] of [[j, k], [k, j]]) for (let m = 0; m <= n[across]; ++m) for (const side of [p.low[other], p.high[other]])
          for (const end of [p.low[i], p.high[i]]) {
            const x = [0, 0, 0];
            x[i] = end;
            x[across] = p.low[across] + (m * d[across]) / n[across];
            x[other] = side;
            ends.push(...x);
          }
      const lines = new BufferGeometry();
      lines.setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
      this.placed.add(glass, plain(new LineSegments(lines, paint(ROLE_COLOURS.mould, 0.35, false))));
    }
    for (const r of risers ? p.risers : []) {
      const mesh = plain(new Mesh(new CylinderGeometry(r.diameter / 2, r.diameter / 2, r.height, 48), paint(ROLE_COLOURS.riser, 0.75)));
      mesh.rotateX(Math.PI / 2);
      mesh.position.set(r.foot[0], r.foot[1], r.foot[2] + r.height / 2);
      this.placed.add(mesh);
    }
  }

  /** Ingate and runner, drawn along x and turned about the upright line through the gate, and the sprue. */
  private gating(g: Gating, look: Material): void {
    const floor = g.gate[2] - g.gate_height / 2, dx = g.sprue[0] - g.gate[0], dy = g.sprue[1] - g.gate[1];
    const along = Math.hypot(dx, dy) + Math.max(g.foot_diameter, g.runner_width) / 2, high = g.sprue[2] - floor;
    const bar = (from: number, to: number, wide: number, tall: number) => {
      const mesh = plain(new Mesh(new BoxGeometry(Math.max(to - from, 1e-6), wide, tall).translate((from + to) / 2, 0, tall / 2), look));
      mesh.rotation.z = Math.atan2(dy, dx);
      mesh.position.set(g.gate[0], g.gate[1], floor);
      this.placed.add(mesh);
    };
    bar(0, g.gate_length, g.gate_width, g.gate_height);
    bar(g.gate_length, along, g.runner_width, g.runner_height);
    const sprue = plain(new Mesh(new CylinderGeometry(g.top_diameter / 2, g.foot_diameter / 2, Math.max(high, 1e-6), 48), look));
    sprue.rotateX(Math.PI / 2);
    sprue.position.set(g.sprue[0], g.sprue[1], floor + high / 2);
    this.placed.add(sprue);
  }

  /** The neck of a riser next to the part: from its axis to a place of the part, level as far as the riser has that height. */
  private neck(r: Riser, to: Place, look: Material): void {
    const wide = r.neck_diameter ?? r.diameter, half = Math.min(wide / 2, r.height / 2);
    const from = new Vector3(r.foot[0], r.foot[1], Math.min(Math.max(to[2], r.foot[2] + half), r.foot[2] + r.height - half)), along = new Vector3(...to).sub(from);
    const mesh = plain(new Mesh(new CylinderGeometry(wide / 2, wide / 2, along.length(), 32), look));
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.clone().normalize());
    mesh.position.copy(from).addScaledVector(along, 0.5);
    this.placed.add(mesh);
  }

  /** Lights up a face of a body, or the triangle where faces have no numbers; nothing: none. */
  point(at?: Pick): void {
    empty(this.pointed);
    if (at) {
      const body = this.bodies[at.body], face = body.faces[at.triangle], { triangles, normal } = body.shape;
      // Its triangles alone go to the graphics card, each with corners of its own.
      const own: number[] = [];
      if (face > 0) body.faces.forEach((f, t) => f === face && own.push(3 * t, 3 * t + 1, 3 * t + 2));
      else own.push(3 * at.triangle, 3 * at.triangle + 1, 3 * at.triangle + 2);
      const take = (values: Float32Array) => Float32Array.from({ length: 3 * own.length }, (_, k) => values[3 * triangles[own[Math.floor(k / 3)]] + (k % 3)]);
      this.pointed.add(plain(new Mesh(surfaceOf(take(body.position), take(normal), Uint32Array.from(own, (_, k) => k)), paint(ACCENT, 0.65))));
    }
    this.request();
  }

  private visible(): number[] {
    const some = this.bodies.flatMap((_, b) => (this.shown[b] === "shown" ? [b] : []));
    return some.length ? some : this.bodies.map((_, b) => b);
  }
  box(): { low: Place; high: Place } {
    const low: Place = [Infinity, Infinity, Infinity], high: Place = [-Infinity, -Infinity, -Infinity];
    for (const b of this.visible())
      for (let i = 0; i < 3; ++i) {
        low[i] = Math.min(low[i], this.bodies[b].low[i]);
        high[i] = Math.max(high[i], this.bodies[b].high[i]);
      }
    return low[0] <= high[0] ? { low, high } : { low: [-0.05, -0.05, -0.05], high: [0.05, 0.05, 0.05] };
  }
  size(): number {
    const { low, high } = this.box();
    return Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  }

  /** The box with what was placed and is not yet in the mesh: a riser reaches above the part. */
  private boxOfAll(): { low: Place; high: Place } {
    const { low, high } = this.box(), placed = new Box3();
    this.placed.updateMatrixWorld(true);
    placed.setFromObject(this.placed);
    if (!placed.isEmpty()) {
      placed.min.toArray().forEach((v, i) => (low[i] = Math.min(low[i], v)));
      placed.max.toArray().forEach((v, i) => (high[i] = Math.max(high[i], v)));
    }
    return { low, high };
  }

  /** Whether something lies beyond the frame. */
  private reachesOut(): boolean {
    const { low, high } = this.boxOfAll(), w = this.canvas.clientWidth, t = this.canvas.clientHeight, x = [low, high];
    return [0, 1, 2, 3, 4, 5, 6, 7].some((k) => {
      const [px, py] = this.project([x[k & 1][0], x[(k >> 1) & 1][1], x[k >> 2][2]]);
      return px < 0 || py < 0 || px > w || py > t;
    });
  }

  fit(): void {
    const { low, high } = this.boxOfAll(), c = this.camera;
    const size = new Vector3(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    c.target.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
    c.reach = size.length() / 2 || 1;
    const inverse = c.turn.clone().invert();
    let wide = 0, tall = 0;
    for (const i of [-1, 1]) for (const j of [-1, 1]) for (const k of [-1, 1]) {
      const corner = new Vector3((i * size.x) / 2, (j * size.y) / 2, (k * size.z) / 2).applyQuaternion(inverse);
      wide = Math.max(wide, Math.abs(corner.x));
      tall = Math.max(tall, Math.abs(corner.y));
    }
    const aspect = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight) || 1.5;
    c.half = Math.max(tall, wide / aspect) * 1.25 || 1;
    this.request();
  }
  look(direction: Place): void {
    this.camera.look(direction);
    this.fit();
  }
  /** Turns the eye to a place. */
  fly(at: Place): void {
    this.camera.target.set(...at);
    this.request();
  }

  resize(): void {
    const box = this.canvas.parentElement!.getBoundingClientRect();
    if (box.width < 2 || box.height < 2) return;
    this.renderer?.setSize(box.width, box.height, false);
    this.request();
  }
  request(moving = false): void {
    this.moving = moving;
    this.wanted ||= requestAnimationFrame(() => this.render());
  }
  private render(): void {
    this.wanted = 0;
    if (!this.painter) return;
    this.camera.apply(this.canvas.clientWidth, this.canvas.clientHeight);
    // A large skin that moves is drawn coarsely unless the machine has shown that it is quick enough, and whole as soon as it rests.
    const moving = this.moving || this.held, draft = moving && !this.painter.quick && this.roughOf.some((geometry) => geometry);
    this.things.visible = !draft;
    this.rough.visible = draft;
    this.painter.paint(this.scene, this.camera.three, moving, () => this.held || this.request(), draft);
    this.drawn();
  }

  /** Pixels from the upper left corner of a place. */
  project(at: Place): [number, number] {
    this.camera.apply(this.canvas.clientWidth, this.canvas.clientHeight); // the camera may have moved since the last picture
    const v = new Vector3(...at).project(this.camera.three);
    return [((v.x + 1) / 2) * this.canvas.clientWidth, ((1 - v.y) / 2) * this.canvas.clientHeight];
  }
  /** What lies under a pixel. */
  pick(px: number, py: number): Pick | undefined {
    const w = this.canvas.clientWidth, t = this.canvas.clientHeight, c = this.camera;
    c.apply(w, t);
    const aspect = w / Math.max(1, t);
    const far = 10 * c.reach + 2 * c.half;
    const from = new Vector3(((px / w) * 2 - 1) * c.half * aspect, (1 - (py / t) * 2) * c.half, far).applyQuaternion(c.turn).add(c.target);
    const along = new Vector3(0, 0, -1).applyQuaternion(c.turn);
    let best: Pick | undefined;
    for (const body of this.visible()) {
      const hit = cross(this.bodies[body], from.toArray() as Place, along.toArray() as Place, 0);
      if (hit && (!best || hit.far < best.far)) best = { ...hit, body };
    }
    // Some files have their triangles inside out: what is seen looks outward.
    if (best && best.normal[0] * along.x + best.normal[1] * along.y + best.normal[2] * along.z > 0) best.normal = best.normal.map((v) => -v) as Place;
    return best;
  }
  get triangles(): number {
    return this.painter?.triangles ?? 0;
  }
}

function plain<T extends Mesh | LineSegments>(thing: T): T {
  thing.frustumCulled = false;
  return thing;
}

function surfaceOf(position: Float32Array, normal: Float32Array, triangles: Uint32Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(position, 3));
  geometry.setAttribute("normal", new BufferAttribute(normal, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return geometry;
}

/** Takes everything out of a group, and off the graphics card; shapes that are shown again stay there. */
function empty(group: Group, keep = false): void {
  for (const child of [...group.children]) {
    const mesh = child as Mesh;
    if (!keep) mesh.geometry.dispose();
    (mesh.material as Material).dispose();
    group.remove(child);
  }
}
