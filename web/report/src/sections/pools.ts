/** Pools of melt: when they were closed off, and when they froze. */
import { labelOfColumn } from "../columns";
import { h, svg, table } from "../dom";
import { duration, unitOfValue, withUnit } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, ofRuns } from "../section";
import type { Workbench } from "../workbench";

function pools(run: Run, index: number, bench: Workbench): Content[] {
  const t = run.table("pools");
  const time = t?.numbers("time"), number = t?.numbers("pool"), parent = t?.numbers("parent"), closed = t?.numbers("closed_off_since"), frozen = t?.numbers("frozen_at");
  const volume = t?.numbers("volume"), x = t?.numbers("x"), y = t?.numbers("y"), z = t?.numbers("z");
  if (!t || !time || !number || !parent || !closed || !frozen || !volume || !x || !y || !z) return [h("p", { class: "hint" }, "This run has no table of pools.")];
  interface Pool { number: number; parent: number; from: number; to: number; closed: number; frozen: number; volume: number; at: number[] }
  const all = new Map<number, Pool>();
  for (let i = 0; i < t.rows; ++i) {
    const p = all.get(number[i]) ?? { number: number[i], parent: parent[i], from: time[i], to: time[i], closed: -1, frozen: -1, volume: 0, at: [] };
    p.to = time[i];
    if (closed[i] >= 0) p.closed = closed[i];
    if (frozen[i] >= 0) p.frozen = frozen[i];
    p.volume = Math.max(p.volume, volume[i]);
    p.at = [x[i], y[i], z[i]];
    all.set(p.number, p);
  }
  const list = [...all.values()], label = (header: string) => labelOfColumn("pools", header);
  const rows = list.map((p) => [
    `${p.number}`, p.parent > 0 ? `${p.parent}` : "–", duration(p.from), p.closed >= 0 ? duration(p.closed) : "fed to the end", p.frozen >= 0 ? duration(p.frozen) : "left as melt or still there",
    withUnit(p.volume, unitOfValue("m3")), bench.placeButton(p.at, `pool ${p.number}`, index),
  ]);
  return [h("div", { class: "card" }, gantt(list)), h("div", { style: "height:12px" }), table([label("pool[1]"), label("parent[1]"), "Since", label("closed_off_since[s]"), label("frozen_at[s]"), "Largest volume", "Last melt at"], rows)];
}

function gantt(pools: { number: number; from: number; to: number; closed: number; frozen: number }[]): Node {
  const shown = pools.slice(0, 30), end = Math.max(...pools.map((p) => Math.max(p.to, p.frozen))) || 1;
  const left = 62, width = 1000, row = 22, at = (t: number) => left + ((width - left - 20) * t) / end;
  const height = shown.length * row + 30;
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((s) => s * end);
  return svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "gantt", role: "img", "aria-label": "Life of the pools: orange fed, red closed off" },
    ...ticks.flatMap((t) => [svg("line", { x1: at(t), x2: at(t), y1: 0, y2: height - 22 }), svg("text", { x: at(t), y: height - 6, class: "axis", "text-anchor": t === end ? "end" : "middle" }, duration(t))]),
    ...shown.flatMap((p, i) => {
      const y = i * row + 4, stop = p.frozen >= 0 ? p.frozen : p.to, open = p.closed >= 0 ? Math.min(p.closed, stop) : stop;
      return [
        svg("text", { x: 0, y: y + 12 }, `pool ${p.number}`),
        svg("rect", { x: at(p.from), y, width: Math.max(1.5, at(open) - at(p.from)), height: row - 8, rx: 3, class: "open" }, svg("title", {}, "fed")),
        ...(p.closed >= 0 ? [svg("rect", { x: at(open), y, width: Math.max(3, at(stop) - at(open)), height: row - 8, rx: 3, class: "closed" }, svg("title", {}, "closed off"))] : []),
      ];
    }));
}

addSection({ id: "pools", title: "Pools of melt", place: 70, build: (page, bench) => ofRuns(page, (r) => r.table("pools")?.rows, (r, i) => pools(r, i, bench)) });
