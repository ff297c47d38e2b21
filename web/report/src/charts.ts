/** Curves: uPlot with zoom by dragging, a common cursor and the moment of the picture. */
import uPlot from "uplot";
import { h, save } from "./dom";
import { lineColour } from "./colours";
import { short } from "./quantities";

export interface Line {
  label: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** Curves of the same colour belong together; a second run is dashed. */
  colour: number;
  dashed?: boolean;
  off?: boolean;
}
export interface ChartSpec {
  title: string;
  unit: string;
  lines: Line[];
  xLabel?: string;
  xUnit?: string;
  logarithmic?: boolean;
  steps?: boolean;
  /** Whether x is the time of the run: the cursor is shared and a click goes there. */
  time?: boolean;
  height?: number;
}

interface Made {
  plot: uPlot;
  spec: ChartSpec;
}
const made = new Set<Made>();
let goTo: (time: number) => void = () => {};
let now = NaN;

export function onTimePicked(f: (time: number) => void): void {
  goTo = f;
}
/** Moves the mark of the picture's moment in all charts over time. */
export function markTime(time: number): void {
  now = time;
  for (const m of made) if (m.spec.time) m.plot.redraw(false);
}

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const dark = () => document.documentElement.dataset.theme === "dark";

/** One abscissa for all lines; uPlot joins what lies between. */
function joined(lines: Line[]): uPlot.AlignedData {
  const tables = lines.map((l) => [Array.from(l.x), Array.from(l.y, (v) => (Number.isFinite(v) ? v : null))] as uPlot.AlignedData);
  return tables.length === 1 ? tables[0] : uPlot.join(tables, tables.map((t) => t.map(() => 2)) as uPlot.JoinNullMode[][]);
}

function options(spec: ChartSpec, width: number): uPlot.Options {
  const axis = { stroke: css("--muted"), grid: { stroke: css("--grid"), width: 1 }, ticks: { stroke: css("--grid"), width: 1 }, font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif", labelSize: 16 };
  const value = (_: uPlot, v: number | null) => (v === null || v === undefined ? "–" : short(v) + (spec.unit ? ` ${spec.unit}` : ""));
  return {
    width, height: spec.height ?? 230,
    cursor: { sync: spec.time ? { key: "time" } : undefined, drag: { x: true, y: false }, points: { size: 6 } },
    scales: { x: { time: false, range: (_u, lo, hi) => wide(lo, hi) }, y: { distr: spec.logarithmic ? 3 : 1, range: spec.logarithmic ? undefined : (_u, lo, hi) => padded(lo, hi) } },
    legend: { live: true },
    axes: [
      { ...axis, label: `${spec.xLabel ?? "Time"}${spec.xUnit === "" ? "" : ` [${spec.xUnit ?? "s"}]`}`, size: 28 },
      { ...axis, size: (_u, ticks) => 16 + 6.6 * Math.max(3, ...(ticks ?? []).map((t) => t.length)), values: (_u, ticks) => ticks.map((v) => (v === null ? "" : short(v))) },
    ],
    series: [
      { label: spec.xLabel ?? "Time", value: (_u, v) => (v === null || v === undefined ? "–" : `${short(v)} ${spec.xUnit ?? "s"}`) },
      ...spec.lines.map((l) => ({
        label: l.label, stroke: lineColour(l.colour, dark()), width: 1.6, dash: l.dashed ? [6, 4] : undefined, show: !l.off, value, spanGaps: true,
        points: { show: l.x.length <= 40, size: 4 },
        paths: spec.steps ? uPlot.paths.stepped!({ align: -1 }) : undefined,
      })),
    ],
    hooks: {
      draw: [(u) => {
        if (!spec.time || !Number.isFinite(now)) return;
        const x = u.valToPos(now, "x", true);
        if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
        u.ctx.save();
        u.ctx.strokeStyle = css("--accent");
        u.ctx.globalAlpha = 0.7;
        u.ctx.lineWidth = 1.5 * devicePixelRatio;
        u.ctx.beginPath();
        u.ctx.moveTo(x, u.bbox.top);
        u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
        u.ctx.stroke();
        u.ctx.restore();
      }],
      ready: [(u) => {
        let x0 = 0;
        u.over.addEventListener("mousedown", (e) => (x0 = e.clientX));
        u.over.addEventListener("click", (e) => {
          if (spec.time && Math.abs(e.clientX - x0) < 4) goTo(u.posToVal(e.clientX - u.over.getBoundingClientRect().left, "x"));
        });
      }],
    },
  };
}

/** Some room above and below; what differs by rounding alone counts as constant, for which there are no ticks. */
function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  const room = high - low > 1e-9 * size ? (high - low) * 0.06 : size * 0.1 || 1;
  return [low - room, high + room];
}

/** As zoomed to, but never so close that numbers cannot tell ticks apart. */
function wide(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const least = 1e-8 * Math.max(Math.abs(low), Math.abs(high)) || 1;
  return high - low > least ? [low, high] : [(low + high - least) / 2, (low + high + least) / 2];
}

/** A card with a chart; it draws itself when it comes into sight. */
export function chart(spec: ChartSpec): HTMLElement {
  const box = h("div", { class: "plot" });
  const card = h("figure", { class: "card chart" },
    h("figcaption", {}, h("span", {}, spec.title, spec.unit ? h("small", {}, ` ${spec.unit}`) : null),
      h("button", { class: "quiet", title: "Save the curves as a table (CSV)", click: () => save(`${spec.title}.csv`, csv(spec)) }, "CSV")),
    box);
  let entry: Made | undefined;
  const draw = () => {
    const width = paper ? PAPER_WIDTH : box.clientWidth;
    if (width < 10) return;
    if (entry) {
      made.delete(entry);
      entry.plot.destroy();
    }
    entry = { plot: new uPlot(options(spec, width), joined(spec.lines), box), spec };
    made.add(entry);
  };
  let near = false;
  const sight = new IntersectionObserver((seen) => {
    if (!seen.some((e) => e.isIntersecting)) return;
    near = true;
    sight.disconnect();
    draw();
  }, { rootMargin: "600px" });
  sight.observe(box);
  new ResizeObserver(() => {
    if (near && !entry) draw();
    else if (entry && !paper && box.clientWidth > 10 && Math.abs(entry.plot.width - box.clientWidth) > 1)
      entry.plot.setSize({ width: box.clientWidth, height: spec.height ?? 230 });
  }).observe(box);
  const redraw = () => {
    if (near) draw();
  };
  redraws.add(redraw);
  const atOnce = () => {
    if (entry) return;
    near = true;
    draw();
  };
  everything.add(atOnce);
  drop.set(card, () => {
    redraws.delete(redraw);
    everything.delete(atOnce);
    sight.disconnect();
    if (entry) {
      made.delete(entry);
      entry.plot.destroy();
    }
  });
  return card;
}
const redraws = new Set<() => void>(), everything = new Set<() => void>();
const drop = new WeakMap<HTMLElement, () => void>();

/** Two charts fit next to each other on A4. */
const PAPER_WIDTH = 420;
let paper = false;

/** Every chart at the width of the paper, or back at that of the window. */
export function drawForPaper(on: boolean): void {
  paper = on;
  if (on) for (const draw of everything) draw();
  redrawCharts();
}
/** Colours follow the theme. */
export function redrawCharts(): void {
  for (const draw of redraws) draw();
}
export function removeChart(card: HTMLElement): void {
  drop.get(card)?.();
  card.remove();
}

function csv(spec: ChartSpec): string {
  const data = joined(spec.lines);
  const head = [`${spec.xLabel ?? "time"}[${spec.xUnit ?? "s"}]`, ...spec.lines.map((l) => `${l.label}${spec.unit ? `[${spec.unit}]` : ""}`)];
  const cell = (text: string) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const rows = Array.from(data[0], (_, i) => data.map((column) => column[i] ?? "").join(","));
  return [head.map(cell).join(","), ...rows].join("\n") + "\n";
}
