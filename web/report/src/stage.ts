/** A picture with what lies over it: legend, axes, length, marks; and what the pointer does to it. */
import { Vector3 } from "three";
import { h, svg } from "./dom";
import { colourTable } from "./colours";
import { place, short, withUnit } from "./quantities";
import type { Hit } from "./picking";
import type { View } from "./view";

export interface Mark {
  run: number;
  body: number;
  node: number;
  /** Beginning of the run [m]. */
  at: number[];
  label: string;
  kind: "point" | "find" | "line";
}

export interface StageEvents {
  picked(run: number, hit: Hit, shift: boolean): void;
  moved(): void;
  activated(run: number): void;
}

export class Stage {
  readonly root: HTMLElement;
  private readonly over = svg("svg", { class: "marks" });
  private readonly legend = h("div", { class: "legend" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly axes = svg("svg", { class: "axes", viewBox: "-40 -40 80 80" });
  private readonly rule = h("div", { class: "rule" });
  private readonly caption = h("div", { class: "caption" });
  marks: Mark[] = [];

  constructor(readonly view: View, readonly index: number, private readonly events: StageEvents, named: boolean) {
    this.root = h("div", { class: "stage", tabindex: 0, "aria-label": "Picture of the run: drag to turn, wheel to zoom, click for the curves of a place" });
    this.root.append(view.canvas, this.over, this.legend, this.axes, this.rule, this.tip);
    if (named) this.root.append(this.caption);
    view.drawn = () => this.overlay();
    this.pointers();
    new ResizeObserver(() => view.resize()).observe(this.root);
  }

  private pointers(): void {
    const canvas = this.view.canvas, camera = this.view.camera;
    const down = new Map<number, [number, number]>();
    let moved = 0, spread = 0;
    const where = (e: PointerEvent | MouseEvent): [number, number] => {
      const box = canvas.getBoundingClientRect();
      return [e.clientX - box.left, e.clientY - box.top];
    };
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      down.set(e.pointerId, where(e));
      moved = 0;
      spread = 0;
      this.leave();
      this.events.activated(this.index);
    });
    canvas.addEventListener("pointermove", (e) => {
      const at = where(e), before = down.get(e.pointerId);
      if (!before) {
        this.hover(at);
        return;
      }
      const dx = at[0] - before[0], dy = at[1] - before[1];
      down.set(e.pointerId, at);
      moved += Math.abs(dx) + Math.abs(dy);
      if (down.size === 2) {
        const [p, q] = [...down.values()], now = Math.hypot(p[0] - q[0], p[1] - q[1]);
        if (spread > 0) camera.zoom(spread / now, 0, 0, 1);
        spread = now;
        camera.pan(dx / 2, dy / 2, canvas.clientHeight);
      } else if (moved > 3) {
        if (e.shiftKey || e.buttons === 2 || e.buttons === 4 || camera.flat) camera.pan(dx, dy, canvas.clientHeight);
        else camera.rotate(dx, dy);
      }
      this.events.moved();
    });
    const up = (e: PointerEvent) => {
      const single = down.size === 1;
      down.delete(e.pointerId);
      if (e.type === "pointerup" && single && moved <= 4 && e.button === 0) {
        const hit = this.view.pick(...where(e));
        if (hit) this.events.picked(this.index, hit, e.shiftKey);
      }
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("pointerleave", () => this.leave());
    canvas.addEventListener("wheel", (e) => {
      // Without Ctrl a wheel over the picture zooms once it is in use; else the page scrolls on.
      if (!e.ctrlKey && document.activeElement !== this.root) return;
      e.preventDefault();
      const [x, y] = where(e), w = canvas.clientWidth, t = canvas.clientHeight;
      camera.zoom(Math.exp(Math.max(-60, Math.min(60, e.deltaY)) * 0.004), (2 * x) / w - 1, 1 - (2 * y) / t, w / t);
      this.events.moved();
    }, { passive: false });
    canvas.addEventListener("pointerdown", () => this.root.focus({ preventScroll: true }));
  }

  private hovering = 0;
  private pointer?: [number, number];
  private leave(): void {
    cancelAnimationFrame(this.hovering);
    this.pointer = undefined;
    this.tip.hidden = true;
  }

  /** Says what the pointer points at, and goes on to say it while the picture changes under it. */
  private hover(at: [number, number]): void {
    this.pointer = at;
    cancelAnimationFrame(this.hovering);
    this.hovering = requestAnimationFrame(() => {
      const hit = this.view.pick(...at), field = this.view.field;
      this.tip.hidden = !hit;
      if (!hit || !field) return;
      const body = this.view.run.bodies[hit.body];
      this.tip.replaceChildren(
        h("b", {}, Number.isFinite(hit.value) ? withUnit(hit.value, field.unit) : "no value"),
        h("span", {}, `${body.name} · ${place(hit.place, this.view.run.dimension)}`),
      );
      const right = at[0] > this.view.canvas.clientWidth - 190;
      this.tip.style.transform = `translate(${right ? at[0] - 12 : at[0] + 14}px, ${at[1] + 14}px)${right ? " translateX(-100%)" : ""}`;
    });
  }

  /** Where a node is on the screen, moved as the picture moves it. */
  private pixel(mark: Mark): [number, number] {
    const run = this.view.run, m = this.view.moment, scale = this.view.choice.scale;
    const at = [mark.at[0], mark.at[1], mark.at[2] ?? 0];
    if (mark.node >= 0)
      run.displacement.forEach((axis, i) => {
        const d = axis[mark.body].one(mark.node, m);
        if (Number.isFinite(d)) at[i] += scale * d;
      });
    return this.view.project(at);
  }

  private overlay(): void {
    const marks = this.marks.filter((m) => m.run === this.index);
    const ends = marks.filter((m) => m.kind === "line").map((m) => this.pixel(m));
    this.over.replaceChildren(
      ...(ends.length === 2 ? [svg("line", { x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1], class: "between" })] : []),
      ...marks.map((m) => {
        const [x, y] = this.pixel(m);
        return svg("g", { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`, class: `mark ${m.kind}` },
          svg("circle", { r: 5 }), m.kind === "find" ? svg("circle", { r: 11, class: "ring" }) : null,
          svg("text", { x: 10, y: 4 }, m.label));
      }),
    );
    this.drawAxes();
    this.drawRule();
    if (this.pointer) this.hover(this.pointer);
  }

  private drawAxes(): void {
    const flat = this.view.run.axisymmetric;
    const names: [string, Vector3][] = [
      [flat ? "r" : "x", new Vector3(1, 0, 0)], [flat ? "z" : "y", new Vector3(0, 1, 0)], [flat ? "" : "z", new Vector3(0, 0, 1)],
    ];
    const inverse = this.view.camera.turn.clone().invert();
    const drawn = names.filter(([n, v]) => n && (this.view.run.dimension === 3 || v.z === 0))
      .map(([name, v], i) => ({ name, v: v.applyQuaternion(inverse), i })).sort((p, q) => p.v.z - q.v.z);
    this.axes.replaceChildren(...drawn.flatMap(({ name, v, i }) => {
      const [x, y] = [v.x * 24, -v.y * 24];
      return [svg("line", { x1: 0, y1: 0, x2: x, y2: y, class: `axis${i}` }), svg("text", { x: x * 1.38, y: y * 1.38 + 4, class: `axis${i}` }, name)];
    }));
  }

  private drawRule(): void {
    const metres = (2 * this.view.camera.half) / Math.max(1, this.view.canvas.clientHeight);
    const wish = metres * 110, power = 10 ** Math.floor(Math.log10(wish));
    const length = [5, 2, 1].map((k) => k * power).find((l) => l <= wish) ?? power;
    const width = length / metres;
    this.rule.style.width = `${width}px`;
    this.rule.replaceChildren(h("span", {}, `${short(length * 1e3)} mm`));
  }

  /** The scale of colours, with its title, unit and what the elements say. */
  showLegend(rangeName: string, note: (Node | string)[]): void {
    const { view } = this, c = view.choice, field = view.field;
    this.caption.textContent = `${view.run.meta.name} · t = ${short(view.run.times[view.moment])} s`;
    if (!field) {
      this.legend.hidden = true;
      return;
    }
    this.legend.hidden = false;
    const table = colourTable(c.map), stops: string[] = [];
    const n = c.bands || 32;
    for (let k = 0; k < n; ++k) {
      const s = c.bands ? (k + 0.5) / n : k / (n - 1), i = Math.round(s * 255);
      const colour = `rgb(${table[4 * i]} ${table[4 * i + 1]} ${table[4 * i + 2]})`;
      if (c.bands) stops.push(`${colour} ${(100 * k) / n}%`, `${colour} ${(100 * (k + 1)) / n}%`);
      else stops.push(colour);
    }
    const ticks = 5, logarithmic = c.log && c.low > 0;
    const tick = (k: number) => {
      const s = k / (ticks - 1);
      const value = logarithmic ? c.low * (c.high / c.low) ** s : c.low + s * (c.high - c.low);
      return h("span", { style: `left:${100 * s}%` }, short(value * field.unit.scale + field.unit.offset));
    };
    const bar = h("div", { class: "colours" });
    bar.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    this.legend.replaceChildren(
      h("div", { class: "legend-title" }, h("b", {}, field.label), field.unit.text ? ` [${field.unit.text}]` : "", h("small", {}, rangeName)),
      bar, h("div", { class: "ticks" }, ...Array.from({ length: ticks }, (_, k) => tick(k))),
      ...(note.length ? [h("div", { class: "legend-note" }, ...note)] : []),
    );
  }
}
