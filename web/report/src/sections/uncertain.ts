/** What the spreads of the data make of the answers. */
import { h, svg } from "../dom";
import { short } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, ofRuns } from "../section";

/** A tornado for each answer: from what it falls to what it rises where each datum goes to its ends. */
function uncertain(run: Run): Content[] {
  const all = run.uncertain;
  if (!all?.answers?.length) return [h("p", { class: "hint" }, "This run belongs to no `solidus uncertain`.")];
  const most = 8, wide = 420, row = 22;
  const boxes = all.answers.map((answer) => {
    const parts = answer.parts.slice(0, most);
    const ends = parts.map((p) => [p.down ?? 2 * answer.value - (p.up ?? answer.value), p.up ?? answer.value]);
    const band = answer.step_and_mesh ?? 0;
    const low = Math.min(answer.value - band, ...ends.flat()), high = Math.max(answer.value + band, ...ends.flat()), span = high - low || 1;
    const x = (v: number) => ((v - low) / span) * wide;
    const bars = parts.map((p, i) => {
      const [a, b] = ends[i];
      return svg("g", {}, svg("rect", { x: x(Math.min(a, b)), y: i * row + 4, width: Math.max(1, Math.abs(x(b) - x(a))), height: row - 8, class: "tornado" }),
        svg("title", {}, `${p.label}: ${short(a)} to ${short(b)} ${answer.unit}`));
    });
    if (band > 0) bars.push(svg("rect", { x: x(answer.value - band), y: parts.length * row + 4, width: Math.max(1, x(answer.value + band) - x(answer.value - band)), height: row - 8, class: "tornado-band" }));
    const n = bars.length, names = [...parts.map((p) => `${p.label} ± ${short(p.plus_minus)}`), ...(band > 0 ? [`step and mesh ± ${short(band)}`] : [])];
    const labels = names.map((name, i) => svg("text", { x: wide + 10, y: i * row + row / 2 + 4, class: "tornado-text" }, name));
    const picture = svg("svg", { viewBox: `0 0 ${wide + 400} ${n * row + 4}`, class: "tornado-picture", role: "img", "aria-label": `What moves ${answer.name}` },
      ...bars, svg("line", { x1: x(answer.value), x2: x(answer.value), y1: 0, y2: n * row, class: "tornado-middle" }), ...labels);
    return h("div", { class: "tornado-box" }, h("h3", {}, `${answer.name}: ${short(answer.value)} ± ${short(answer.plus_minus)} ${answer.unit}`), picture,
      answer.jumps ? h("p", { class: "hint" }, "About as much by whatever is moved: steps and mesh more than data.") : null);
  });
  return [h("p", { class: "hint" }, `± holds ${short(100 * (all.coverage ?? 0.95))} %. Bars: from one end of a datum to the other; the line is the answer as computed.`), ...boxes,
    ...(all.remarks ?? []).map((r) => h("p", { class: "hint" }, r))];
}

addSection({ id: "uncertain", title: "Uncertain data", place: 50, build: (page) => ofRuns(page, (r) => r.uncertain?.answers?.length, uncertain) });
