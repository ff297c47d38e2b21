/** The curves of the nodes that were clicked and of the line between two places. */
import { chart, ChartSpec, removeChart } from "./charts";
import { byId, h } from "./dom";
import { alongLine } from "./geometry";
import { duration } from "./quantities";
import type { Mark } from "./stage";
import type { Workbench } from "./workbench";

/** Places between which values are shown, as they lay in the beginning [m]. */
export interface LineSpec {
  run: number;
  p: number[];
  q: number[];
}

export class Probes {
  private cards: HTMLElement[] = [];

  constructor(private readonly bench: Workbench) {}

  show(marks: Mark[], line?: LineSpec): void {
    for (const card of this.cards) removeChart(card);
    this.cards = [];
    const field = this.bench.field;
    const points = marks.filter((m) => m.kind === "point");
    if (field && points.length && !field.atEnd) {
      const lines = points.map((m, i) => {
        const run = this.bench.runs[m.run], of = run.fields.find((f) => f.id === field.id);
        const y = run.times.map((_, k) => (of?.has(m.body) ? of.value(m.body, m.node, k) * field.unit.scale + field.unit.offset : NaN));
        const which = this.bench.runs.length > 1 ? `${run.meta.name}, ` : "";
        return { label: `${m.label}: ${which}${run.bodies[m.body].name}, node ${run.bodies[m.body].numbers[m.node]}`, x: run.times, y, colour: i };
      });
      this.add({ title: `${field.label} at the nodes clicked`, unit: field.unit.text, lines, time: true }, points.length > 0);
    }
    if (field && line && marks.some((m) => m.kind === "line")) {
      const { run, p, q } = line, r = this.bench.runs[run], moment = this.bench.stages[run].view.moment;
      const of = r.fields.find((f) => f.id === field.id);
      const lines = this.bench.visibleBodies(r).flatMap((b, i) => {
        if (!of?.has(b) || !r.bodies[b].hasCells) return [];
        const pairs = alongLine(r.bodies[b].x, r.bodies[b].cells, r.bodies[b].corners, of.values(b, moment), p, q);
        return pairs.length ? [{ label: r.bodies[b].name, x: pairs.map((v) => v[0] * 1e3), y: pairs.map((v) => v[1] * field.unit.scale + field.unit.offset), colour: i }] : [];
      });
      this.add({ title: `${field.label} from A to B at t = ${duration(r.times[moment])}`, unit: field.unit.text, lines: merged(lines), xLabel: "From A", xUnit: "mm" }, true);
    }
  }
  private add(spec: ChartSpec, closable: boolean): void {
    const card = chart(spec);
    if (closable)
      card.querySelector("figcaption")!.append(h("button", { class: "quiet", title: "Take away (Esc)", click: () => this.bench.clearMarks() }, "✕"));
    this.cards.push(card);
    byId("probed").append(card);
  }
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
