/** Castings and the die from shot to shot. */
import { chart } from "../charts";
import { charts, labelOfColumn, linesOf } from "../columns";
import { byId, h, table } from "../dom";
import { duration, short, unitText } from "../quantities";
import type { Page, Run } from "../run";
import { addSection, Content, perRun } from "../section";
import type { Workbench } from "../workbench";

function shotCharts(page: Page): Node {
  return h("div", { class: "cards" }, ...charts(page, "shots").map((c) =>
    chart({ title: c.title, unit: unitText(c.unit), lines: c.headers.flatMap((x, i) => linesOf(page, "shots", x, i, false, "shot")), xLabel: "Shot", xUnit: "" })));
}

function shots(run: Run, bench: Workbench): Content[] {
  const t = run.table("shots"), n = t?.numbers("shot"), end = t?.numbers("time"), poured = t?.numbers("poured_at");
  if (!t || !n || !end || !poured) return [h("p", { class: "hint" }, "This run has no shots.")];
  const cell = (name: string, i: number, unit: string) => {
    const v = t.numbers(name)?.[i];
    return v === undefined ? "–" : `${short(v)} ${unit}`;
  };
  const heads = ["shot[1]", "poured_at[s]", "time[s]", "time_to_solidify[s]", "die_at_start_mean[degC]", "die_at_end_mean[degC]", "largest_change[K]"].map((x) => labelOfColumn("shots", x));
  const rows = Array.from({ length: t.rows }, (_, i) => {
    const solid = t.numbers("time_to_solidify")?.[i] ?? -1;
    const go = bench.ready ? h("button", { class: "link", title: "Show its end in the picture", click: () => {
      bench.goTo(end[i]);
      byId("view").scrollIntoView({ behavior: "smooth" });
    } }, duration(end[i])) : duration(end[i]);
    return [`${n[i]}`, duration(poured[i]), go, solid < 0 ? "left with melt" : duration(solid), cell("die_at_start_mean", i, "°C"), cell("die_at_end_mean", i, "°C"), cell("largest_change", i, "K"),
      t.numbers("periodic")?.[i] ? "periodic" : ""];
  });
  return [h("div", { style: "height:12px" }), table([...heads, ""], rows)];
}

addSection({ id: "shots", title: "Shots", place: 80, build: (page, bench) => (page.runs.some((r) => r.table("shots")?.rows) ? [shotCharts(page), perRun(page, (r) => shots(r, bench))] : []) });
