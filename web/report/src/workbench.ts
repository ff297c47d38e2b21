/** The pictures of the runs and the slider below: one choice for all, which the panel next to them changes. */
import { Quaternion, Vector3 } from "three";
import { byId, h } from "./dom";
import { markTime } from "./charts";
import { Camera } from "./camera";
import { mapOf } from "./colours";
import { LineSpec, Probes } from "./probes";
import { Panel } from "./panel";
import { duration, place, quantityOf, withUnit } from "./quantities";
import type { Field, Page, Run } from "./run";
import { Mark, Stage } from "./stage";
import type { Hit } from "./picking";
import { Choice, Shown, View } from "./view";

const PLAY = '<svg viewBox="0 0 24 24" width="18" height="18"><path d="M7 4v16l13-8z" fill="currentColor"/></svg>';
const PAUSE = '<svg viewBox="0 0 24 24" width="18" height="18"><path d="M6 4h4v16H6zM14 4h4v16h-4z" fill="currentColor"/></svg>';
const MOST_POINTS = 6;

export class Workbench {
  readonly ready: boolean;
  readonly choice: Choice;
  readonly stages: Stage[] = [];
  readonly runs: Run[];
  readonly camera = new Camera();
  private marks: Mark[] = [];
  private playing = 0;
  private times: number[] = [];
  fixedRange = false;
  ofMoment = true;
  scaleChosen = false;
  private panel?: Panel;
  private readonly probes = new Probes(this);
  private lastHit?: { run: number; hit: Hit };
  private lineSpec?: LineSpec;

  constructor(readonly page: Page) {
    this.runs = page.runs.filter((r) => r.bodies.length > 0).slice(0, 2);
    this.ready = this.runs.length > 0;
    this.choice = {
      field: "", map: "Viridis", bands: 0, log: false, low: 0, high: 1, time: 0, scale: 0, shown: new Map(), mesh: false,
      cut: { on: false, normal: [0, 0, 1], at: 0 }, only: { on: false, low: 0, high: 1 }, revolved: 0,
    };
    if (!this.ready) return;
    byId("view").hidden = false;
    if (this.run.dimension === 3) this.camera.up.set(0, 0, 1);
    this.first();
    for (const [i, run] of this.runs.entries()) {
      const stage = new Stage(new View(run, this.camera, this.choice), i, this, this.runs.length > 1);
      this.stages.push(stage);
      byId("stages").append(stage.root);
    }
    this.timebar();
    this.panel = new Panel(this);
    this.keys();
  }
  /** The first picture, once the page has the room for it. */
  begin(): void {
    if (!this.ready) return;
    for (const stage of this.stages) stage.view.resize();
    this.fit();
    this.update();
    for (const stage of this.stages) stage.view.render();
  }

  get run(): Run {
    return this.runs[0];
  }
  get field(): Field | undefined {
    return this.stages.map((s) => s.view.field).find((f) => f);
  }
  get flat(): boolean {
    return this.run.dimension === 2 && this.choice.revolved === 0;
  }

  /** What one sees first: the casting at the end, by its temperature. */
  private first(): void {
    const c = this.choice;
    for (const run of this.runs) {
      const castings = run.castings;
      run.bodies.forEach((body, b) => {
        if (run.dimension === 3 && castings.length > 0 && !castings.includes(b)) c.shown.set(body.name, "hidden");
      });
    }
    this.times = [...new Set(this.runs.flatMap((r) => r.times))].sort((a, b) => a - b);
    // A run that goes on is watched at its front.
    c.time = location.protocol === "http:" ? this.times[this.times.length - 1] : this.times[Math.max(0, this.firstTelling())];
    // The temperature, else the first field of the elements that has a figure at the head, as the stress.
    const fields = this.run.fields, of = (f: Field) => quantityOf(f.name);
    const first = fields.find((f) => of(f)?.colours === "hot") ?? fields.find((f) => f.ofElements && of(f)?.headline) ?? fields[0];
    c.field = first?.id ?? "";
    const high = this.run.fields.find((f) => f.id === "displacement")?.bound(this.shownBodies(this.run)) ?? 0;
    const size = this.sizeOfBodies();
    // Drawn as it is unless that cannot be seen: then so that the largest is a thirtieth of the body.
    const wanted = high > 0 ? size / 30 / high : 0;
    c.scale = high > 0 ? Math.max(1, niceFactor(Math.min(wanted, 1000))) : 0;
    this.adoptField();
    const centre = this.boxes(0.5);
    c.cut.at = centre[2];
  }
  /** The first moment at which a good third of the casting has frozen, else the last. The curve says it; without one, the field. */
  private firstTelling(): number {
    const run = this.run, last = this.times.length - 1, enough = 0.35;
    const history = run.table("history"), time = history?.numbers("time"), curve = history?.numbers("solid_fraction");
    if (time && curve) {
      const row = curve.findIndex((v) => v > enough), moment = row < 0 ? -1 : run.times.findIndex((t) => t >= time[row] * (1 - 1e-9));
      return moment < 0 ? last : this.times.indexOf(run.times[moment]);
    }
    const solid = run.fields.find((f) => f.id === "solid_fraction");
    if (!solid) return last;
    for (let m = 0; m < run.times.length; ++m) {
      let sum = 0, n = 0;
      for (const b of run.castings) for (const v of solid.values(b, m)) {
        sum += v;
        ++n;
      }
      if (n > 0 && sum / n > enough) return this.times.indexOf(run.times[m]);
    }
    return last;
  }
  shownBodies(run: Run): number[] {
    const shown = run.bodies.flatMap((b, i) => ((this.choice.shown.get(b.name) ?? "shown") === "shown" ? [i] : []));
    return shown.length ? shown : run.bodies.map((_, i) => i);
  }
  private boxes(share: number): [number, number, number] {
    const out: [number, number, number] = [0, 0, 0];
    for (let i = 0; i < 3; ++i) {
      const [low, high] = this.extent(i);
      out[i] = low + share * (high - low);
    }
    return out;
  }
  extent(axis: number): [number, number] {
    let low = Infinity, high = -Infinity;
    for (const run of this.runs)
      for (const b of this.visibleBodies(run)) {
        const [l, u] = run.bodies[b].box;
        low = Math.min(low, l[axis]);
        high = Math.max(high, u[axis]);
      }
    return low <= high ? [low, high] : [0, 1];
  }
  extents(): string {
    return [0, 1, 2].map((i) => this.extent(i).join()).join();
  }
  visibleBodies(run: Run): number[] {
    const some = run.bodies.flatMap((b, i) => ((this.choice.shown.get(b.name) ?? "shown") !== "hidden" ? [i] : []));
    return some.length ? some : run.bodies.map((_, i) => i);
  }
  private sizeOfBodies(): number {
    return Math.max(...[0, 1, 2].map((i) => this.extent(i)).map(([l, u]) => u - l));
  }

  /** Colour map and range that suit the field. */
  private adoptField(): void {
    const field = this.runs.map((r) => r.fields.find((f) => f.id === this.choice.field)).find((f) => f);
    if (!field) return;
    this.choice.map = mapOf(quantityOf(field.name)?.colours, field.component);
    this.choice.log = false;
    this.fixedRange = false;
    this.choice.only.on = false;
    this.adoptRange();
  }
  private adoptRange(): void {
    if (this.fixedRange) return;
    let low = Infinity, high = -Infinity;
    for (const [i, run] of this.runs.entries()) {
      const field = run.fields.find((f) => f.id === this.choice.field);
      if (!field) continue;
      const bodies = this.shownBodies(run), moment = this.stages[i]?.view.moment ?? run.moment(this.choice.time);
      const [l, u] = this.ofMoment ? field.rangeAt(bodies, moment) : field.range(bodies);
      low = Math.min(low, l);
      high = Math.max(high, u);
    }
    if (!(low <= high)) [low, high] = [0, 1];
    if (this.choice.map === "Blue–red" && low < 0 && high > 0) {
      high = Math.max(-low, high);
      low = -high;
    }
    // A field that is the same everywhere but for rounding has one colour.
    if (high - low <= 1e-6 * Math.max(Math.abs(low), Math.abs(high))) high = low + Math.max(1e-12, Math.abs(low) * 1e-3);
    this.choice.low = low;
    this.choice.high = high;
  }

  /** Brings everything to what has been chosen. */
  update(): void {
    if (!this.ready) return;
    this.adoptRange();
    for (const stage of this.stages) {
      stage.marks = this.marks;
      stage.view.update();
      stage.showLegend(this.fixedRange ? "as set" : this.ofMoment && !stage.view.field?.atEnd ? "of this moment" : "of the run", this.legendNote(stage));
    }
    const index = this.timeIndex();
    byId<HTMLInputElement>("time").value = String(index);
    byId("clock").textContent = `t = ${duration(this.times[index])}`;
    this.panel?.refresh();
    markTime(this.choice.time);
  }
  private legendNote(stage: Stage): (Node | string)[] {
    const field = stage.view.field, run = stage.view.run;
    if (!field) return [];
    if (field.atEnd) return [field.group === "Criteria" ? "of the whole run: the same at every moment" : "at the end of the run alone"];
    if (!field.ofElements) return [];
    const bodies = this.shownBodies(run);
    const all = field.extremes(stage.view.moment).filter((e) => bodies.includes(e.body));
    if (!all.length) return ["means of the elements around a node"];
    const most = all.reduce((a, b) => (b.high > a.high ? b : a));
    return [
      "nodes: means of elements; ",
      h("button", { class: "link", style: "pointer-events:auto", title: "Go there", click: () => this.fly(most.highAt, `largest ${withUnit(most.high, field.unit)}`, most.body) }, `largest element ${withUnit(most.high, field.unit)}`),
    ];
  }
  private redraw(moving = false): void {
    for (const s of this.stages) s.view.request(moving);
  }

  /** What the reader has chosen, for the next page of a run that goes on. */
  state(): object {
    const { target, turn, half } = this.camera, c = this.choice;
    return {
      choice: { ...c, shown: [...c.shown] }, last: this.ready && this.timeIndex() === this.times.length - 1, target: target.toArray(), turn: turn.toArray(), half,
      fixedRange: this.fixedRange, ofMoment: this.ofMoment, scaleChosen: this.scaleChosen, scroll: scrollY,
    };
  }
  restore(kept: ReturnType<Workbench["state"]>): void {
    if (!this.ready) return;
    const k = kept as { choice: Choice & { shown: [string, Shown][] }; last: boolean; target: number[]; turn: number[]; half: number; fixedRange: boolean; ofMoment: boolean; scaleChosen: boolean; scroll: number };
    Object.assign(this.choice, k.choice, { shown: new Map(k.choice.shown) });
    if (!this.fields().some((f) => f.id === this.choice.field)) this.choice.field = this.fields()[0]?.id ?? "";
    this.camera.target.fromArray(k.target);
    this.camera.turn.fromArray(k.turn as [number, number, number, number]);
    this.camera.half = k.half;
    this.camera.flat = this.flat;
    this.fixedRange = k.fixedRange;
    this.ofMoment = k.ofMoment;
    this.scaleChosen = k.scaleChosen;
    // Who looked at the last moment wants the last moment.
    this.goTo(k.last ? this.times[this.times.length - 1] : this.choice.time);
    scrollTo({ top: k.scroll, behavior: "instant" });
  }

  // Time
  private timeIndex(): number {
    let best = 0;
    this.times.forEach((t, i) => {
      if (Math.abs(t - this.choice.time) < Math.abs(this.times[best] - this.choice.time)) best = i;
    });
    return best;
  }
  goTo(time: number): void {
    if (!this.ready) return;
    this.choice.time = time;
    this.choice.time = this.times[this.timeIndex()];
    this.update();
  }
  step(by: number): void {
    this.goTo(this.times[Math.max(0, Math.min(this.times.length - 1, this.timeIndex() + by))]);
  }
  play(): void {
    const button = byId("play");
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
    } else {
      // What moves is read on a scale that stands still.
      if (!this.scaleChosen) this.ofMoment = false;
      if (this.timeIndex() === this.times.length - 1) this.goTo(this.times[0]);
      this.playing = window.setInterval(() => {
        if (this.timeIndex() === this.times.length - 1) this.play();
        else this.step(1);
      }, Math.max(90, Math.min(500, 8000 / this.times.length)));
    }
    button.innerHTML = this.playing ? PAUSE : PLAY;
    button.setAttribute("aria-label", this.playing ? "Stop" : "Play");
  }
  private timebar(): void {
    const slider = byId<HTMLInputElement>("time"), n = this.times.length;
    slider.max = String(n - 1);
    slider.addEventListener("input", () => this.goTo(this.times[+slider.value]));
    byId("play").innerHTML = PLAY;
    byId("play").addEventListener("click", () => this.play());
    if (n > 1 && n <= 200)
      byId("ticks").append(...this.times.map((_, i) => h("i", { style: `left:${(100 * i) / (n - 1)}%` })));
  }

  // Camera
  moved(): void {
    this.redraw(true);
  }
  activated(): void {}
  fit(): void {
    const c = this.camera, box = this.stages[0].view.bounds();
    c.flat = this.flat;
    c.target.copy(box.centre);
    c.reach = box.radius;
    if (this.flat) c.turn.identity();
    else if (c.turn.equals(new Quaternion())) c.look(c.corner);
    const inverse = c.turn.clone().invert();
    let halfWidth = 0, halfHeight = 0;
    for (const i of [-1, 1]) for (const j of [-1, 1]) for (const k of [-1, 1]) {
      const corner = new Vector3((i * box.size.x) / 2, (j * box.size.y) / 2, (k * box.size.z) / 2).applyQuaternion(inverse);
      halfWidth = Math.max(halfWidth, Math.abs(corner.x));
      halfHeight = Math.max(halfHeight, Math.abs(corner.y));
    }
    const stage = this.stages[0].root.getBoundingClientRect();
    const aspect = stage.width > 0 ? stage.width / Math.max(1, stage.height) : 1.5;
    c.half = Math.max(halfHeight * 1.36, (halfWidth / aspect) * 1.12) || 1;
    // The legend lies below: what is shown moves up by a little.
    c.target.add(new Vector3(0, -c.half * 0.15, 0).applyQuaternion(c.turn));
    this.redraw();
  }
  look(direction: [number, number, number]): void {
    if (this.flat) return;
    this.camera.look(direction);
    this.fit();
  }
  /** Turns the reader's eye to a place, as it lay in the beginning [m]. */
  fly(at: number[], label: string, body = -1, run = 0): void {
    if (!this.ready) return;
    byId("view").scrollIntoView({ block: "start", behavior: "smooth" });
    const node = body >= 0 ? this.nearest(run, body, at) : this.nearestOfAll(run, at);
    this.marks = this.marks.filter((m) => m.kind !== "find");
    this.marks.push({ run, body: node.body, node: node.node, at: [at[0], at[1], at[2] ?? 0], label, kind: "find" });
    const from = this.camera.target.clone(), to = new Vector3(at[0], at[1], at[2] ?? 0);
    const halfFrom = this.camera.half, halfTo = Math.min(halfFrom, Math.max(this.camera.reach * 0.38, 1e-6));
    const began = performance.now();
    const move = () => {
      const s = Math.min(1, (performance.now() - began) / 600), e = s * s * (3 - 2 * s);
      this.camera.target.lerpVectors(from, to, e);
      this.camera.half = halfFrom * (halfTo / halfFrom) ** e;
      this.redraw(s < 1);
      if (s < 1) requestAnimationFrame(move);
    };
    move();
    this.update();
  }
  private nearest(run: number, body: number, at: number[]): { body: number; node: number; far: number } {
    const x = this.runs[run].bodies[body].x;
    let node = 0, far = Infinity;
    for (let i = 0; i < x.length; i += 3) {
      const d = Math.hypot(x[i] - at[0], x[i + 1] - at[1], x[i + 2] - (at[2] ?? 0));
      if (d < far) [far, node] = [d, i / 3];
    }
    return { body, node, far };
  }
  private nearestOfAll(run: number, at: number[]): { body: number; node: number } {
    return this.visibleBodies(this.runs[run]).map((b) => this.nearest(run, b, at)).reduce((a, b) => (b.far < a.far ? b : a));
  }

  // Places and lines
  picked(run: number, hit: Hit, shift: boolean): void {
    const body = this.runs[run].bodies[hit.body], x = body.x;
    if (shift && this.lastHit && this.lastHit.run === run) {
      this.line(run, this.lastHit.hit, hit);
      return;
    }
    this.lastHit = { run, hit };
    const points = this.marks.filter((m) => m.kind === "point");
    const label = String(points.length + 1);
    if (points.length >= MOST_POINTS) return;
    const at = [x[3 * hit.node], x[3 * hit.node + 1], x[3 * hit.node + 2]];
    this.marks.push({ run, body: hit.body, node: hit.node, at, label, kind: "point" });
    this.probes.show(this.marks, this.lineSpec);
    this.update();
  }
  clearMarks(): void {
    this.marks = [];
    this.lastHit = undefined;
    this.probes.show(this.marks, this.lineSpec);
    this.update();
  }
  private line(run: number, from: Hit, to: Hit): void {
    this.marks = this.marks.filter((m) => m.kind !== "line");
    for (const [hit, label] of [[from, "A"], [to, "B"]] as [Hit, string][])
      this.marks.push({ run, body: hit.body, node: hit.node, at: hit.place, label, kind: "line" });
    this.lineSpec = { run, p: from.place, q: to.place };
    this.probes.show(this.marks, this.lineSpec);
    this.update();
  }

  // What is chosen
  change(f: (c: Choice) => void): void {
    f(this.choice);
    this.update();
  }
  setField(id: string): void {
    this.choice.field = id;
    this.adoptField();
    this.update();
    this.probes.show(this.marks, this.lineSpec);
  }
  fields(): Field[] {
    const seen = new Map<string, Field>();
    for (const run of this.runs) for (const f of run.fields) if (!seen.has(f.id)) seen.set(f.id, f);
    return [...seen.values()];
  }
  private nextField(by: number): void {
    const ids = this.fields().map((f) => f.id), i = ids.indexOf(this.choice.field);
    this.setField(ids[(i + by + ids.length) % ids.length]);
  }

  private keys(): void {
    addEventListener("keydown", (e) => {
      const target = e.target as HTMLElement;
      if (e.ctrlKey || e.metaKey || e.altKey || /^(SELECT|TEXTAREA)$/.test(target.tagName) || (target.tagName === "INPUT" && (target as HTMLInputElement).type === "number")) return;
      const inSlider = target.tagName === "INPUT" && (target as HTMLInputElement).type === "range";
      const directions: Record<string, [number, number, number]> = { 1: [1, 0, 0], 2: [-1, 0, 0], 3: [0, 1, 0], 4: [0, -1, 0], 5: [0, 0, 1], 6: [0, 0, -1], 7: this.camera.corner };
      const actions: Record<string, () => void> = {
        " ": () => this.play(), "[": () => this.nextField(-1), "]": () => this.nextField(1), f: () => this.fit(), Escape: () => this.clearMarks(),
        c: () => this.run.dimension === 3 && this.change((c) => (c.cut.on = !c.cut.on)), m: () => this.change((c) => (c.mesh = !c.mesh)),
        t: () => byId("theme").click(), "?": () => byId("help").click(), ",": () => this.panel?.moveCut(-8), ".": () => this.panel?.moveCut(8),
        ...(inSlider ? {} : { ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1), Home: () => this.goTo(this.times[0]), End: () => this.goTo(this.times[this.times.length - 1]) }),
      };
      const action = directions[e.key] ? () => this.look(directions[e.key]) : actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
      if (!action || (e.key === " " && target.tagName === "BUTTON")) return;
      e.preventDefault();
      action();
    });
  }

  /** For cards elsewhere: "(0, 69, 0) mm" that goes there. */
  placeButton(at: number[], label: string, run = 0): HTMLElement {
    const text = place(at, this.run?.dimension ?? 3);
    return this.ready && run < this.runs.length ? h("button", { class: "link", title: "Show it in the picture", click: () => this.fly(at, label, -1, run) }, text) : h("span", {}, text);
  }
}

function niceFactor(value: number): number {
  return [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000].filter((f) => f <= value).pop() ?? 1;
}
