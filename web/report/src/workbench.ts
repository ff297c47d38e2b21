/** The pictures of the runs, the panel beside them and the slider below: one choice for all. */
import { Quaternion, Vector3 } from "three";
import { byId, h, save } from "./dom";
import { chart, ChartSpec, markTime, removeChart } from "./charts";
import { Camera } from "./camera";
import { mapOf, MAPS } from "./colours";
import { alongLine } from "./geometry";
import { duration, place, short, withUnit } from "./quantities";
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
  private readonly camera = new Camera();
  private marks: Mark[] = [];
  private playing = 0;
  private times: number[] = [];
  private fixedRange = false;
  private ofMoment = true;
  private scaleChosen = false;
  private panelParts: { refresh(): void }[] = [];
  private probeCards: HTMLElement[] = [];
  private lastHit?: { run: number; hit: Hit };

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
    this.panel();
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
    const field = ["temperature", "von_mises", "displacement"].find((id) => this.run.fields.some((f) => f.id === id)) ?? this.run.fields[0]?.id ?? "";
    c.field = field;
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
  private shownBodies(run: Run): number[] {
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
  private extent(axis: number): [number, number] {
    let low = Infinity, high = -Infinity;
    for (const run of this.runs)
      for (const b of this.visibleBodies(run)) {
        const [l, u] = run.bodies[b].box;
        low = Math.min(low, l[axis]);
        high = Math.max(high, u[axis]);
      }
    return low <= high ? [low, high] : [0, 1];
  }
  private extents(): string {
    return [0, 1, 2].map((i) => this.extent(i).join()).join();
  }
  private visibleBodies(run: Run): number[] {
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
    this.choice.map = mapOf(field.id, field.group);
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
    if (high === low) high = low + Math.max(1e-12, Math.abs(low) * 1e-6);
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
    for (const part of this.panelParts) part.refresh();
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
    this.showProbes();
    this.update();
  }
  clearMarks(): void {
    this.marks = [];
    this.lastHit = undefined;
    this.showProbes();
    this.update();
  }
  private lineSpec?: { run: number; p: number[]; q: number[] };
  private line(run: number, from: Hit, to: Hit): void {
    this.marks = this.marks.filter((m) => m.kind !== "line");
    for (const [hit, label] of [[from, "A"], [to, "B"]] as [Hit, string][])
      this.marks.push({ run, body: hit.body, node: hit.node, at: hit.place, label, kind: "line" });
    this.lineSpec = { run, p: from.place, q: to.place };
    this.showProbes();
    this.update();
  }

  /** The curves of the nodes that were clicked and of the line between two places. */
  private showProbes(): void {
    for (const card of this.probeCards) removeChart(card);
    this.probeCards = [];
    const field = this.field;
    const points = this.marks.filter((m) => m.kind === "point");
    if (field && points.length && !field.atEnd) {
      const lines = points.map((m, i) => {
        const run = this.runs[m.run], of = run.fields.find((f) => f.id === field.id);
        const y = run.times.map((_, k) => (of?.has(m.body) ? of.value(m.body, m.node, k) * field.unit.scale + field.unit.offset : NaN));
        const which = this.runs.length > 1 ? `${run.meta.name}, ` : "";
        return { label: `${m.label}: ${which}${run.bodies[m.body].name}, node ${run.bodies[m.body].numbers[m.node]}`, x: run.times, y, colour: i };
      });
      this.addProbe({ title: `${field.label} at the nodes clicked`, unit: field.unit.text, lines, time: true }, points.length > 0);
    }
    if (field && this.lineSpec && this.marks.some((m) => m.kind === "line")) {
      const { run, p, q } = this.lineSpec, r = this.runs[run], moment = this.stages[run].view.moment;
      const of = r.fields.find((f) => f.id === field.id);
      const lines = this.visibleBodies(r).flatMap((b, i) => {
        if (!of?.has(b) || !r.bodies[b].hasCells) return [];
        const pairs = alongLine(r.bodies[b].x, r.bodies[b].cells, r.bodies[b].corners, of.values(b, moment), p, q);
        return pairs.length ? [{ label: r.bodies[b].name, x: pairs.map((v) => v[0] * 1e3), y: pairs.map((v) => v[1] * field.unit.scale + field.unit.offset), colour: i }] : [];
      });
      this.addProbe({ title: `${field.label} from A to B at t = ${duration(r.times[moment])}`, unit: field.unit.text, lines: merged(lines), xLabel: "From A", xUnit: "mm" }, true);
    }
  }
  private addProbe(spec: ChartSpec, closable: boolean): void {
    const card = chart(spec);
    if (closable)
      card.querySelector("figcaption")!.append(h("button", { class: "quiet", title: "Take away (Esc)", click: () => this.clearMarks() }, "✕"));
    this.probeCards.push(card);
    byId("probed").append(card);
  }

  // The panel
  private change(f: (c: Choice) => void): void {
    f(this.choice);
    this.update();
  }
  setField(id: string): void {
    this.choice.field = id;
    this.adoptField();
    this.update();
    this.showProbes();
  }
  private fields(): Field[] {
    const seen = new Map<string, Field>();
    for (const run of this.runs) for (const f of run.fields) if (!seen.has(f.id)) seen.set(f.id, f);
    return [...seen.values()];
  }
  private nextField(by: number): void {
    const ids = this.fields().map((f) => f.id), i = ids.indexOf(this.choice.field);
    this.setField(ids[(i + by + ids.length) % ids.length]);
  }

  private panel(): void {
    const panel = byId("panel"), c = this.choice;
    const part = (title: string, refresh: () => void, ...children: (Node | null)[]) => {
      panel.append(h("fieldset", {}, h("legend", {}, title), ...children));
      this.panelParts.push({ refresh });
    };
    this.fieldPart(part);
    this.bodiesPart(part);
    if (this.run.displacement.length) this.deformationPart(part);
    if (this.run.axisymmetric) {
      const turns: [string, number][] = [["Section", 0], ["½", Math.PI], ["¾", 1.5 * Math.PI], ["Full", 2 * Math.PI]];
      const buttons = turns.map(([text, angle]) => h("button", { click: () => {
        const wasFlat = this.flat;
        this.change((ch) => (ch.revolved = angle));
        if (wasFlat !== this.flat) this.camera.turn.identity();
        this.fit();
      } }, text));
      part("Turned about the axis", () => buttons.forEach((b, i) => b.classList.toggle("on", turns[i][1] === c.revolved)), h("div", { class: "choice" }, ...buttons));
    }
    if (this.run.dimension === 3) this.cutPart(part);
    this.onlyPart(part);
    this.viewPart(part);
  }

  private fieldPart(part: Part): void {
    const c = this.choice;
    const select = h("select", { id: "field", "aria-label": "Field", change: () => this.setField(select.value) });
    const groups = new Map<string, HTMLOptGroupElement>();
    for (const f of this.fields()) {
      if (!groups.has(f.group)) groups.set(f.group, h("optgroup", { label: f.group }));
      groups.get(f.group)!.append(h("option", { value: f.id }, f.label));
    }
    for (const name of ["Heat", "Mechanics", "Contact", "Criteria"]) if (groups.has(name)) select.append(groups.get(name)!);
    const map = h("select", { "aria-label": "Colours", change: () => this.change((ch) => (ch.map = map.value)) }, ...MAPS.map((m) => h("option", { value: m }, m)));
    const bands = h("select", { "aria-label": "Bands", change: () => this.change((ch) => (ch.bands = +bands.value)) }, ...[["0", "smooth"], ["6", "6 bands"], ["10", "10 bands"], ["16", "16 bands"]].map(([v, t]) => h("option", { value: v }, t)));
    const low = h("input", { type: "number", step: "any", "aria-label": "Least of the scale" }), high = h("input", { type: "number", step: "any", "aria-label": "Greatest of the scale" });
    const set = () => {
      const unit = this.field!.unit;
      const l = (+low.value - unit.offset) / unit.scale, u = (+high.value - unit.offset) / unit.scale;
      if (!(l < u)) return;
      this.fixedRange = true;
      this.change((ch) => {
        ch.low = l;
        ch.high = u;
      });
    };
    low.addEventListener("change", set);
    high.addEventListener("change", set);
    const how = ["Run", "Moment"].map((text, i) => h("button", { title: i ? "Scale of the present moment" : "Scale of the whole run", click: () => {
      this.fixedRange = false;
      this.ofMoment = i === 1;
      this.scaleChosen = true;
      this.update();
    } }, text));
    const log = h("input", { type: "checkbox", change: () => this.change((ch) => (ch.log = log.checked)) });
    part("Field", () => {
      select.value = c.field;
      map.value = c.map;
      bands.value = String(c.bands);
      const unit = this.field?.unit ?? { scale: 1, offset: 0, text: "" };
      if (document.activeElement !== low) low.value = String(+(c.low * unit.scale + unit.offset).toPrecision(5));
      if (document.activeElement !== high) high.value = String(+(c.high * unit.scale + unit.offset).toPrecision(5));
      how.forEach((b, i) => b.classList.toggle("on", !this.fixedRange && this.ofMoment === (i === 1)));
      log.checked = c.log;
      log.disabled = !(c.low > 0) || unit.offset !== 0;
    },
    h("div", { class: "row" }, select), h("div", { class: "row" }, map, bands),
    h("div", { class: "two" }, h("label", {}, "from", low), h("label", {}, "to", high)),
    h("div", { class: "row" }, h("div", { class: "choice" }, ...how), h("label", {}, log, " log")));
  }

  private bodiesPart(part: Part): void {
    const names = [...new Set(this.runs.flatMap((r) => r.bodies.map((b) => b.name)))];
    const states: [Shown, string][] = [["shown", "Show"], ["ghost", "Ghost"], ["hidden", "Hide"]];
    const rows = names.map((name) => {
      const buttons = states.map(([state, text]) => h("button", { "data-body": name, "data-state": state, click: () => {
        const before = this.extents();
        this.change((ch) => ch.shown.set(name, state));
        if (this.extents() !== before) this.fit();
      } }, text));
      const material = this.runs.flatMap((r) => r.bodies).find((b) => b.name === name)?.material ?? "";
      return { name, buttons, row: h("div", {}, h("span", { title: `${name}: ${material}` }, name), h("div", { class: "choice" }, ...buttons)) };
    });
    part("Bodies", () => {
      for (const { name, buttons } of rows)
        buttons.forEach((b, i) => b.classList.toggle("on", (this.choice.shown.get(name) ?? "shown") === states[i][0]));
    }, h("div", { class: "bodies" }, ...rows.map((r) => r.row)));
  }

  private deformationPart(part: Part): void {
    const slider = h("input", { type: "range", min: 0, max: 100, "aria-label": "Scale of displacements", id: "scale" });
    const output = h("output");
    const factors = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
    slider.max = String(factors.length - 1);
    slider.addEventListener("input", () => this.change((ch) => (ch.scale = factors[+slider.value])));
    part("Displacements", () => {
      const i = factors.reduce((best, f, k) => (Math.abs(f - this.choice.scale) < Math.abs(factors[best] - this.choice.scale) ? k : best), 0);
      slider.value = String(i);
      output.textContent = this.choice.scale === 0 ? "none" : `× ${this.choice.scale}`;
    }, h("div", { class: "row" }, slider, output));
  }

  private cutPart(part: Part): void {
    const c = this.choice.cut;
    const on = h("input", { type: "checkbox", id: "cut", change: () => this.change(() => (c.on = on.checked)) });
    const slider = h("input", { type: "range", min: 0, max: 400, "aria-label": "Place of the cut", id: "cutat" });
    const output = h("output");
    const span = () => {
      let low = Infinity, high = -Infinity;
      const [ex, ey, ez] = [this.extent(0), this.extent(1), this.extent(2)];
      for (const x of ex) for (const y of ey) for (const z of ez) {
        const d = c.normal[0] * x + c.normal[1] * y + c.normal[2] * z;
        low = Math.min(low, d);
        high = Math.max(high, d);
      }
      return [low, high];
    };
    const at = () => {
      const [low, high] = span();
      c.at = low + (high - low) * (0.002 + 0.996 * (+slider.value / 400));
    };
    slider.addEventListener("input", () => this.change(() => {
      at();
      c.on = true;
    }));
    const normals: [string, () => [number, number, number]][] = [
      ["x", () => [1, 0, 0]], ["y", () => [0, 1, 0]], ["z", () => [0, 0, 1]],
      ["screen", () => new Vector3(0, 0, 1).applyQuaternion(this.camera.turn).toArray() as [number, number, number]],
    ];
    let chosen = "z";
    const buttons = normals.map(([text, normal]) => h("button", { title: text === "screen" ? "Through the middle, along the screen" : `Across ${text}`, click: () => this.change(() => {
      chosen = text;
      c.normal = normal();
      slider.value = "200";
      at();
      c.on = true;
    }) }, text));
    const flip = h("button", { title: "Show the other side", click: () => this.change(() => {
      c.normal = c.normal.map((v) => -v) as [number, number, number];
      c.at = -c.at;
      c.on = true;
    }) }, "flip");
    this.moveCut = (by) => {
      const [low, high] = span();
      slider.value = String(Math.round((400 * (c.at - low)) / (high - low)) + by);
      slider.dispatchEvent(new Event("input"));
    };
    part("Cut", () => {
      on.checked = c.on;
      const [low, high] = span();
      slider.value = String(Math.round((400 * (c.at - low)) / (high - low)));
      buttons.forEach((b, i) => b.classList.toggle("on", c.on && normals[i][0] === chosen));
      const sign = Math.sign(c.normal.reduce((a, b) => a + b, 0)) || 1;
      const at = Math.abs(c.at) < 1e-5 * (high - low) ? 0 : chosen === "screen" ? c.at : sign * c.at;
      output.textContent = `${short(1e3 * at)} mm`;
    }, h("div", { class: "row" }, h("label", {}, on, " on"), h("div", { class: "choice" }, ...buttons), flip), h("div", { class: "row" }, slider, output));
  }
  private moveCut: (by: number) => void = () => {};

  private onlyPart(part: Part): void {
    const o = this.choice.only;
    const on = h("input", { type: "checkbox", id: "only", change: () => this.change(() => {
      o.on = on.checked;
      const view = this.stages[0].view, [low, high] = view.field?.rangeAt(this.shownBodies(view.run), view.moment) ?? [0, 1];
      if (o.on) [o.low, o.high] = [low + 0.5 * (high - low), high];
    }) });
    const low = h("input", { type: "range", min: 0, max: 500, "aria-label": "Least value shown", id: "onlylow" });
    const high = h("input", { type: "range", min: 0, max: 500, "aria-label": "Greatest value shown" });
    const outLow = h("output"), outHigh = h("output");
    const value = (s: HTMLInputElement) => this.choice.low + (+s.value / 500) * (this.choice.high - this.choice.low);
    const set = () => this.change(() => {
      o.on = true;
      o.low = Math.min(value(low), value(high));
      o.high = Math.max(value(low), value(high));
    });
    low.addEventListener("input", set);
    high.addEventListener("input", set);
    const has = (id: string) => this.fields().some((f) => f.id === id);
    const preset = (text: string, title: string, field: string, range: (r: [number, number]) => [number, number]) =>
      has(field) ? h("button", { title, click: () => {
        this.setField(field);
        this.change((c) => {
          [o.low, o.high] = range([c.low, c.high]);
          o.on = true;
        });
      } }, text) : null;
    part("Only values between", () => {
      on.checked = o.on;
      const share = (v: number) => String(Math.round((500 * (v - this.choice.low)) / (this.choice.high - this.choice.low)));
      low.value = o.on ? share(o.low) : "0";
      high.value = o.on ? share(o.high) : "500";
      const unit = this.field?.unit;
      outLow.textContent = o.on && unit ? withUnit(o.low, unit) : "";
      outHigh.textContent = o.on && unit ? withUnit(o.high, unit) : "";
    },
    h("div", { class: "row" }, h("label", {}, on, " on"), low, outLow), h("div", { class: "row" }, h("label", { style: "visibility:hidden" }, "☐ on"), high, outHigh),
    h("div", { class: "presets" },
      preset("Still liquid", "Where less than half has frozen at this moment", "solid_fraction", () => [0, 0.5]),
      preset("Mushy", "Between liquid and solid at this moment", "solid_fraction", () => [0.01, 0.99]),
      preset("Last to freeze", "What froze in the last tenth of the time: hot spots", "solidified_at", ([l, u]) => [l + 0.9 * (u - l), u]),
      preset("Low Niyama", "The lowest tenth of the range on a scale of logarithms: poor feeding", "niyama", ([l, u]) => [l, l > 0 ? l * (u / l) ** 0.1 : l + 0.02 * (u - l)]),
      preset("Pores", "Where more than a tenth of the densest pores has opened at this moment", "pore_fraction", ([, u]) => [0.1 * u, u]),
      preset("Open gap", "Where casting and mould are apart by more than a tenth of the widest gap", "gap", ([, u]) => [0.1 * u, u])));
  }

  private viewPart(part: Part): void {
    const mesh = h("input", { type: "checkbox", id: "mesh", change: () => this.change((c) => (c.mesh = mesh.checked)) });
    const directions: [string, [number, number, number]][] = [
      ["+x", [1, 0, 0]], ["−x", [-1, 0, 0]], ["+y", [0, 1, 0]], ["−y", [0, -1, 0]], ["+z", [0, 0, 1]], ["−z", [0, 0, -1]], ["Corner", this.camera.corner],
    ];
    const solid = this.run.dimension === 3 || this.run.axisymmetric;
    part("View", () => (mesh.checked = this.choice.mesh),
      h("div", { class: "views" }, ...(solid ? directions.map(([text, d]) => h("button", { click: () => this.look(d) }, text)) : []), h("button", { click: () => this.fit(), title: "Everything in sight (F)" }, "Fit")),
      h("div", { class: "row" }, h("label", {}, mesh, " elements"), h("span", { style: "flex:1" }),
        h("button", { class: "quiet", title: "Save the picture", click: () => this.stages.forEach((s) => {
          s.view.render();
          s.view.canvas.toBlob((b) => b && save(`${s.view.run.meta.name.replace(/\W+/g, "_")}.png`, b));
        }) }, "PNG"), h("button", { class: "quiet", title: "Take marks and lines away (Esc)", click: () => this.clearMarks() }, "clear marks")),
      h("p", { class: "hint" }, "Click: curves of a node. Shift-click: values along the line from the last click. ? lists the keys."));
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
        t: () => byId("theme").click(), "?": () => byId("help").click(), ",": () => this.moveCut(-8), ".": () => this.moveCut(8),
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

type Part = (title: string, refresh: () => void, ...children: (Node | null)[]) => void;

function niceFactor(value: number): number {
  return [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000].filter((f) => f <= value).pop() ?? 1;
}

/** uPlot wants each abscissa once in a line: places that two cells share hold two values at a jump. */
function merged<T extends { x: number[]; y: number[] }>(lines: T[]): T[] {
  return lines.map((line) => {
    const x: number[] = [], y: number[] = [];
    line.x.forEach((v, i) => {
      if (x.length && v - x[x.length - 1] < 1e-6) y[y.length - 1] = (y[y.length - 1] + line.y[i]) / 2;
      else {
        x.push(v);
        y.push(line.y[i]);
      }
    });
    return { ...line, x, y };
  });
}
