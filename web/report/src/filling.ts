/** How the mould was filled: cubes of metal over time, in a picture that turns, with what python/solidus_plots/filling_view.py keeps of it. */
import { blockBytes } from "./blocks";
import { colourTable } from "./colours";
import { h } from "./dom";
import { duration, short } from "./quantities";
import type { Run } from "./run";

interface FillingPlace {
  kind: string;
  text: string;
  at: number[];
}
interface FillingPage {
  format: number;
  cubes: number;
  edge: number;
  origin: number[];
  up: number[];
  joined: number;
  times: number[];
  full: number[];
  temperature: [number, number];
  liquidus: number;
  fastest: number;
  parts: Record<string, [number, number]>;
  maps: Record<string, { unit: string; range: [number, number] }>;
  gate: { at: number[]; direction: number[]; width: number };
  places: FillingPlace[];
  answers: string[];
}

const KELVIN = 273.15;
const NOW = "now";
const NAMES: Record<string, string> = {
  [NOW]: "Temperature at the moment", fill_time: "Time of arrival", temperature_at_arrival: "Temperature at arrival", age: "Age at the end", speed_of_front: "Speed of the front",
};
const PALETTE: Record<string, string> = { [NOW]: "Inferno", temperature_at_arrival: "Inferno" };
const KINDS: Record<string, [string, string]> = {
  coldest: ["#0072b2", "coldest arrival"], misrun: ["#b3261e", "misrun"], joint: ["#009e73", "fronts met"], cold_shut: ["#b3261e", "cold shut"], air: ["#9a6a00", "air closed in"],
};
const SHADES = [0.8, 0.9, 1];
const ARROW = 5;
/** Faces of a cube: corners that differ from the first along the two other axes. */
const SIDES = [[1, 2], [2, 0], [0, 1]];

type V3 = [number, number, number];

class Filling {
  readonly page: FillingPage;
  private readonly bytes: Uint8Array;
  private readonly cells: Int16Array[];
  private readonly grid: Int32Array;
  private readonly size: V3;
  private readonly middle: V3;
  private readonly reach: number;
  private azimuth = -0.9;
  private elevation = 0.45;
  moment: number;
  shown = NOW;
  arrows = true;
  marks = true;
  cutAxis = -1;
  cutAt = 0.5;

  constructor(run: Run, readonly canvas: HTMLCanvasElement) {
    this.page = JSON.parse(run.meta.filling_text!) as FillingPage;
    this.bytes = blockBytes(`b${run.meta.filling}`);
    const n = this.page.cubes;
    const [from] = this.page.parts.cells;
    const words = new Int16Array(this.bytes.slice(from, from + 6 * n).buffer);
    this.cells = [0, 1, 2].map((d) => words.subarray(d * n, (d + 1) * n));
    const ends = this.cells.map((of) => of.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [32767, -32768]));
    const low = ends.map(([a]) => a);
    this.size = ends.map(([a, b]) => b - a + 3) as V3;
    this.grid = new Int32Array(this.size[0] * this.size[1] * this.size[2]).fill(-1);
    for (let i = 0; i < n; ++i) this.grid[this.key(this.cells[0][i] - low[0] + 1, this.cells[1][i] - low[1] + 1, this.cells[2][i] - low[2] + 1)] = i;
    this.low = low as V3;
    this.middle = ends.map(([a, b]) => 0.5 * (a + b + 1)) as V3;
    this.reach = 0.5 * Math.hypot(...ends.map(([a, b]) => b - a + 1));
    this.moment = this.page.times.length - 1;
  }
  private readonly low: V3;

  private key(x: number, y: number, z: number): number {
    return x + this.size[0] * (y + this.size[1] * z);
  }

  private part(name: string): Uint8Array {
    const [from, length] = this.page.parts[name];
    return this.bytes.subarray(from, from + length);
  }

  /** Of each cube 0 for air, else 1 ... 255 in the colours of what is shown. */
  private colours(): { state: Uint8Array; value: Uint8Array } {
    const n = this.page.cubes, state = this.part("state").subarray(this.moment * n, (this.moment + 1) * n);
    return { state, value: this.shown === NOW ? state : this.part(this.shown) };
  }

  /** The ends of the colours as text. */
  range(): [string, string] {
    if (this.shown === NOW) return this.page.temperature.map((t) => `${short(Math.round(t - KELVIN))} °C`) as [string, string];
    const { unit, range } = this.page.maps[this.shown];
    return range.map((v) => (unit === "K" ? `${short(Math.round(v - KELVIN))} °C` : unit === "s" ? duration(v) : `${short(v)} ${unit}`)) as [string, string];
  }

  turn(dx: number, dy: number): void {
    this.azimuth -= 0.01 * dx;
    this.elevation = Math.max(-1.5, Math.min(1.5, this.elevation + 0.01 * dy));
    this.draw();
  }

  /** Two axes of the picture, and the way to the eye, for the up of the filling. */
  private frame(): [V3, V3, V3] {
    const up = this.page.up, axis = up.map(Math.abs).indexOf(Math.max(...up.map(Math.abs))), sign = Math.sign(up[axis]) || 1;
    const a = (axis + 1) % 3, b = (axis + 2) % 3;
    const vector = (along: number, beside: number, above: number): V3 => {
      const out: V3 = [0, 0, 0];
      out[a] = along;
      out[b] = beside * sign;
      out[axis] = above * sign;
      return out;
    };
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    return [vector(-sa, ca, 0), vector(-se * ca, -se * sa, ce), vector(ce * ca, ce * sa, se)];
  }

  draw(): void {
    const canvas = this.canvas, context = canvas.getContext("2d")!, ratio = window.devicePixelRatio || 1;
    const wide = canvas.clientWidth || 800, high = canvas.clientHeight || 480;
    canvas.width = Math.round(wide * ratio);
    canvas.height = Math.round(high * ratio);
    context.scale(ratio, ratio);
    context.clearRect(0, 0, wide, high);
    const [right, above, eye] = this.frame(), scale = (0.47 * Math.min(wide, high * 1.15)) / this.reach;
    const x = (p: ArrayLike<number>) => wide / 2 + scale * right.reduce((sum, r, d) => sum + r * (p[d] - this.middle[d]), 0);
    const y = (p: ArrayLike<number>) => high / 2 - scale * above.reduce((sum, r, d) => sum + r * (p[d] - this.middle[d]), 0);
    const there = this.cubes(context, right, above, eye, scale, wide, high);
    if (this.arrows) this.drawArrows(context, there, right, above, eye, scale, x, y);
    this.drawGate(context, x, y);
    if (this.marks) this.drawMarks(context, x, y);
  }

  private hidden(i: number, eye: V3): boolean {
    if (this.cutAxis < 0) return false;
    const along = this.size[this.cutAxis] - 2, at = this.cells[this.cutAxis][i] - this.low[this.cutAxis] + 0.5;
    return eye[this.cutAxis] >= 0 ? at > (1 - this.cutAt) * along : at < this.cutAt * along;
  }

  /** Draws cubes from back to front; the numbers of those of metal that are seen. */
  private cubes(context: CanvasRenderingContext2D, right: V3, above: V3, eye: V3, scale: number, wide: number, high: number): number[] {
    const { state, value } = this.colours(), n = this.page.cubes, [cx, cy, cz] = this.cells;
    const order = new Uint32Array(n), depth = new Float32Array(n), gone = new Uint8Array(n);
    for (let i = 0; i < n; ++i) {
      order[i] = i;
      depth[i] = cx[i] * eye[0] + cy[i] * eye[1] + cz[i] * eye[2];
      gone[i] = this.hidden(i, eye) ? 1 : 0;
    }
    order.sort((a, b) => depth[a] - depth[b]);
    const table = colourTable(PALETTE[this.shown] ?? "Viridis");
    const paint = (code: number, side: number) => {
      const k = 4 * Math.round(((code - 1) / 254) * 255), f = SHADES[side];
      return `rgb(${Math.round(table[k] * f)},${Math.round(table[k + 1] * f)},${Math.round(table[k + 2] * f)})`;
    };
    const glass = document.documentElement.dataset.theme === "dark" ? "rgba(200,215,230,0.07)" : "rgba(40,60,80,0.07)";
    const seen: number[] = [];
    for (const i of order) {
      if (gone[i]) continue;
      const metal = state[i] > 0, place = [cx[i], cy[i], cz[i]];
      let drawn = false;
      for (let side = 0; side < 3; ++side) {
        const way = eye[side] > 0 ? 1 : -1;
        if (Math.abs(eye[side]) < 1e-6) continue;
        const beside = [place[0] - this.low[0] + 1, place[1] - this.low[1] + 1, place[2] - this.low[2] + 1];
        beside[side] += way;
        const other = this.grid[this.key(beside[0], beside[1], beside[2])];
        // A face of metal is hidden by metal before it, one of air by any cube.
        if (other >= 0 && !gone[other] && (!metal || state[other] > 0)) continue;
        const corner = place.slice();
        if (way > 0) corner[side] += 1;
        const px = wide / 2 + scale * (right[0] * (corner[0] - this.middle[0]) + right[1] * (corner[1] - this.middle[1]) + right[2] * (corner[2] - this.middle[2]));
        const py = high / 2 - scale * (above[0] * (corner[0] - this.middle[0]) + above[1] * (corner[1] - this.middle[1]) + above[2] * (corner[2] - this.middle[2]));
        const [a, b] = SIDES[side];
        const ax = scale * right[a], ay = -scale * above[a], bx = scale * right[b], by = -scale * above[b];
        context.beginPath();
        context.moveTo(px, py);
        context.lineTo(px + ax, py + ay);
        context.lineTo(px + ax + bx, py + ay + by);
        context.lineTo(px + bx, py + by);
        context.closePath();
        const colour = metal ? paint(value[i] || 1, side) : glass;
        context.fillStyle = colour;
        context.fill();
        if (metal) {
          // Neighbours leave no gap between them.
          context.strokeStyle = colour;
          context.lineWidth = 0.6;
          context.stroke();
          drawn = true;
        }
      }
      if (drawn) seen.push(i);
    }
    return seen;
  }

  private line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number, wide: number): void {
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 2) return;
    const ux = (x1 - x0) / length, uy = (y1 - y0) / length, head = Math.min(4 + wide, 0.5 * length);
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.moveTo(x1 - head * (ux - 0.5 * uy), y1 - head * (uy + 0.5 * ux));
    context.lineTo(x1, y1);
    context.lineTo(x1 - head * (ux + 0.5 * uy), y1 - head * (uy - 0.5 * ux));
    context.lineWidth = wide;
    context.stroke();
  }

  private drawArrows(context: CanvasRenderingContext2D, seen: number[], right: V3, above: V3, eye: V3, scale: number, x: (p: ArrayLike<number>) => number, y: (p: ArrayLike<number>) => number): void {
    const n = this.page.cubes, frames = this.page.times.length, all = this.part("velocity"), step = Math.max(1, Math.round(Math.sqrt(seen.length / 260)));
    for (const pass of [3.2, 1.4]) {
      context.strokeStyle = pass > 2 ? "rgba(0,0,0,0.55)" : "#ffffff";
      for (const i of seen) {
        const place = this.cells.map((of) => of[i] + 0.5);
        if (place.some((p, d) => d !== this.flat(eye) && (Math.floor(p) - this.low[d]) % step !== 0)) continue;
        const v = [0, 1, 2].map((d) => (all[d * n * frames + this.moment * n + i] - 128) / 127);
        const vx = v[0] * right[0] + v[1] * right[1] + v[2] * right[2], vy = v[0] * above[0] + v[1] * above[1] + v[2] * above[2];
        const long = ARROW * scale;
        this.line(context, x(place), y(place), x(place) + long * vx, y(place) - long * vy, pass);
      }
    }
  }

  /** The axis that points most to the eye: arrows are thinned out along the two others. */
  private flat(eye: V3): number {
    const sizes = eye.map(Math.abs);
    return sizes.indexOf(Math.max(...sizes));
  }

  private inCells(at: number[]): number[] {
    return at.map((v, d) => (v - this.page.origin[d]) / this.page.edge);
  }

  private drawGate(context: CanvasRenderingContext2D, x: (p: ArrayLike<number>) => number, y: (p: ArrayLike<number>) => number): void {
    const { at, direction } = this.page.gate, end = this.inCells(at), length = Math.max(0.3 * this.reach, 2);
    const start = end.map((v, d) => v - length * direction[d]);
    context.strokeStyle = "#d55e00";
    context.fillStyle = "#d55e00";
    this.line(context, x(start), y(start), x(end), y(end), 4);
    context.font = "600 12px system-ui, sans-serif";
    context.fillText("gate", x(start) + 6, y(start) - 6);
  }

  private drawMarks(context: CanvasRenderingContext2D, x: (p: ArrayLike<number>) => number, y: (p: ArrayLike<number>) => number): void {
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    this.page.places.forEach((place, k) => {
      const at = this.inCells(place.at), px = x(at), py = y(at);
      context.beginPath();
      context.arc(px, py, 9, 0, 7);
      context.fillStyle = KINDS[place.kind]?.[0] ?? "#555555";
      context.fill();
      context.strokeStyle = "#ffffff";
      context.lineWidth = 1.6;
      context.stroke();
      context.fillStyle = "#ffffff";
      context.fillText(String(k + 1), px, py + 0.5);
    });
    context.textAlign = "start";
    context.textBaseline = "alphabetic";
  }
}

/** The colours of what is shown, with their ends. */
function legend(filling: Filling, box: HTMLElement): void {
  const table = colourTable(PALETTE[filling.shown] ?? "Viridis");
  const stops = [0, 32, 64, 96, 128, 160, 192, 224, 255].map((k) => `rgb(${table[4 * k]},${table[4 * k + 1]},${table[4 * k + 2]})`).join(",");
  const [low, high] = filling.range();
  box.replaceChildren(h("span", {}, low), h("i", { style: `background: linear-gradient(90deg, ${stops})` }), h("span", {}, high));
}

/** What a section on the filling of a run holds. */
export function fillingSection(run: Run): (Node | null)[] {
  if (!run.meta.filling_text || run.meta.filling === undefined) return [h("p", { class: "hint" }, "This run began with a full mould.")];
  const canvas = h("canvas", { class: "filling-picture", role: "img", "aria-label": "Cubes of metal in the mould at a moment of filling" });
  const filling = new Filling(run, canvas), page = filling.page, last = page.times.length - 1;
  const clock = h("output", {}), colours = h("div", { class: "filling-legend" });
  const time = h("input", { type: "range", min: 0, max: last, value: last, "aria-label": "Moment of filling" });
  const show = () => {
    time.value = String(filling.moment);
    clock.textContent = `${duration(page.times[filling.moment])} · ${(100 * page.full[filling.moment]).toFixed(0)} % full`;
    legend(filling, colours);
    filling.draw();
  };
  let playing = 0;
  const stop = () => {
    clearInterval(playing);
    playing = 0;
    play.textContent = "Play";
  };
  const play = h("button", { click: () => {
    if (playing) return stop();
    if (filling.moment === last) filling.moment = 0;
    play.textContent = "Pause";
    playing = window.setInterval(() => {
      if (filling.moment >= last || !canvas.isConnected) return stop();
      ++filling.moment;
      show();
    }, 150);
  } }, "Play");
  time.addEventListener("input", () => {
    stop();
    filling.moment = +time.value;
    show();
  });
  const pick = h("select", { "aria-label": "What is painted", change: () => {
    filling.shown = pick.value;
    show();
  } }, ...[NOW, ...Object.keys(page.maps)].map((name) => h("option", { value: name }, NAMES[name] ?? name)));
  const toggle = (text: string, set: (on: boolean) => void) => {
    const box = h("input", { type: "checkbox", checked: true });
    box.addEventListener("change", () => {
      set(box.checked);
      show();
    });
    return h("label", {}, box, ` ${text}`);
  };
  const depth = h("input", { type: "range", min: 0, max: 100, value: 50, "aria-label": "Place of the cut", disabled: true });
  const cut = h("select", { "aria-label": "Cut", change: () => {
    filling.cutAxis = +cut.value;
    depth.disabled = filling.cutAxis < 0;
    show();
  } }, h("option", { value: -1 }, "no cut"), ...["x", "y", "z"].map((name, d) => h("option", { value: d }, `cut across ${name}`)));
  depth.addEventListener("input", () => {
    filling.cutAt = +depth.value / 100;
    show();
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => event.buttons && filling.turn(event.movementX, event.movementY));
  new ResizeObserver(() => filling.draw()).observe(canvas);
  requestAnimationFrame(show);
  const list = h("ol", { class: "filling-places" }, ...page.places.map((place) => h("li", { style: `--kind: ${KINDS[place.kind]?.[0] ?? "#555555"}` }, place.text)));
  const others = page.answers.filter((text) => !page.places.some((place) => place.text === text));
  return [
    h("div", { class: "card filling" }, canvas,
      h("div", { class: "timebar" }, play, h("div", { class: "slider" }, time), clock),
      h("div", { class: "filling-row" }, pick, colours, cut, depth, toggle(`arrows of speed, ${ARROW} cubes long at ${short(page.fastest)} m/s`, (on) => (filling.arrows = on)), toggle("places", (on) => (filling.marks = on)))),
    list,
    h("ul", { class: "filling-answers" }, ...others.map((text) => h("li", {}, text))),
    h("p", { class: "hint" }, `Drag turns the picture. ${page.cubes.toLocaleString("en")} cubes of ${short(1e3 * page.edge)} mm${page.joined > 1 ? `, each the mean of ${page.joined}×${page.joined}×${page.joined} of the flow` : ""}; ${page.times.length} moments. Liquidus ${short(Math.round(page.liquidus - KELVIN))} °C.`),
  ];
}
