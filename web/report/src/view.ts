/** The picture of one run. */
import { DataTexture, DoubleSide, FrontSide, GLSL3, Mesh, RGBAFormat, Scene, ShaderMaterial, Vector2, Vector3, Vector4, WebGLRenderer } from "three";
import { Camera } from "./camera";
import { colourTable } from "./colours";
import { Drawn, FRAGMENT, VERTEX } from "./drawn";
import { levelShape, planeShape, skinShape } from "./geometry";
import { Painter } from "./painter";
import { type Hit, pick } from "./picking";
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
  private readonly painter: Painter;
  private readonly scene = new Scene();
  private readonly materials: ShaderMaterial[];
  private readonly lines: ShaderMaterial;
  private readonly map = new DataTexture(colourTable("Viridis"), 256, 1, RGBAFormat);
  private readonly shapes: BodyShapes[];
  private mapName = "Viridis";
  /** The frame for which a picture is asked, 0 for none, and whether something moves in it. */
  private wanted = 0;
  private moving = false;
  /** Called after each picture, for what lies over it. */
  drawn: () => void = () => {};

  constructor(readonly run: Run, readonly camera: Camera, readonly choice: Choice) {
    this.renderer = new WebGLRenderer({ antialias: false, preserveDrawingBuffer: true, alpha: true });
    this.painter = new Painter(this.renderer);
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
      const places = this.run.places(b, m);
      const displacement = this.run.displacement.map((axis) => axis[b].at(m));
      const shapes = this.shapes[b];
      const drawn = this.shapesOf(b, shapes, values, state, cutting);
      for (const d of drawn) {
        d.setValues(values, places);
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
  /** Asks for a picture at the next frame. `moving`: others will follow it at once. */
  request(moving = false): void {
    this.moving = moving;
    this.wanted ||= requestAnimationFrame(() => this.render(this.moving));
  }
  render(moving = false): void {
    cancelAnimationFrame(this.wanted);
    this.wanted = 0;
    this.camera.apply(this.canvas.clientWidth, this.canvas.clientHeight);
    // Of a closed skin that nothing opens the back is not seen: a draft does without it.
    const c = this.choice, closed = this.run.dimension === 3 && !c.cut.on && !c.only.on;
    this.materials[0].side = moving && this.painter.slow && closed ? FrontSide : DoubleSide;
    this.painter.paint(this.scene, this.camera.three, moving, () => this.request());
    performance.mark("drawn");
    this.drawn();
  }

  /** Pixels from the upper left corner of a place as it lay in the beginning, moved with its body. */
  project(place: ArrayLike<number>): [number, number] {
    const v = new Vector3(place[0], place[1], place[2] ?? 0).project(this.camera.three);
    return [((v.x + 1) / 2) * this.canvas.clientWidth, ((1 - v.y) / 2) * this.canvas.clientHeight];
  }

  /** What lies under a pixel: the foremost triangle that is not cut away. */
  pick(px: number, py: number): Hit | undefined {
    const c = this.choice, cutting = c.cut.on && this.run.dimension === 3, [nx, ny, nz] = c.cut.normal;
    const targets = this.scene.children.flatMap((object) => {
      const drawn = this.drawnOf(object as Mesh);
      if (!drawn) return [];
      const isCap = drawn.mesh.material === this.materials[4], isLevel = drawn.mesh.material === this.materials[2];
      const there = (p: ArrayLike<number>, value: number) =>
        (!cutting || isCap || nx * p[0] + ny * p[1] + nz * p[2] <= c.cut.at) && (!c.only.on || isLevel || (value >= c.only.low && value <= c.only.high));
      return [{ drawn, x: this.run.bodies[drawn.body].x, there }];
    });
    return pick(targets, this.camera, c.scale, px, py, this.canvas.clientWidth, this.canvas.clientHeight);
  }
  private drawnOf(object: Mesh): Drawn | undefined {
    if (!(object instanceof Mesh) || object.material === this.materials[3]) return undefined;
    return this.shapes.flatMap((s) => [s.skin, s.cap, ...s.levels]).find((d) => d?.mesh === object);
  }
  /** Triangles of what is on the screen. */
  get triangles(): number {
    return this.painter.triangles;
  }
}
