/** The sizes of the steps, what limited them, and what they cost. */
import { chart } from "../charts";
import { charts, headOfColumn, linesOf, listedHeaders } from "../columns";
import { h, table } from "../dom";
import { triesText } from "../head";
import { short, unitText } from "../quantities";
import type { Page, Run } from "../run";
import { addSection, bars, Content, perRun } from "../section";

function stepCharts(page: Page): Node {
  return h("div", { class: "cards" }, ...charts(page, "steps").map((c) =>
    chart({ title: c.title, unit: unitText(c.unit), lines: c.headers.flatMap((x, i) => linesOf(page, "steps", x, i)), time: true, logarithmic: c.logarithmic, steps: c.unit === "1" })));
}

function stepTables(run: Run): Content[] {
  const t = run.table("steps");
  const reason = t?.texts("reason"), time = t?.numbers("time"), dt = t?.numbers("dt"), rejected = t?.numbers("rejected"), shortened = t?.numbers("shortened"), rejection = t?.texts("rejection");
  if (!t || !time || !dt || !reason) return [h("p", { class: "hint" }, "This run has no table of steps.")];
  const counts = new Map<string, number>();
  for (const r of reason) counts.set(r, (counts.get(r) ?? 0) + 1);
  const columns = listedHeaders("steps", t.headers).flatMap((header) => {
    const column = t.numbers(header);
    return column ? [{ text: headOfColumn("steps", header), column }] : [];
  });
  const order = Array.from({ length: t.rows }, (_, i) => i);
  const most = 400, shown = order.length > most ? [...order.slice(0, most / 2), ...order.slice(-most / 2)] : order;
  const tries = (i: number) => {
    const text = triesText(rejected?.[i], shortened?.[i]);
    return text && `${text}: ${rejection?.[i] ?? ""}`;
  };
  const rows = shown.map((i) => [short(time[i]), short(dt[i]), reason[i], tries(i), ...columns.map((c) => short(c.column[i]))]);
  return [
    h("div", { class: "card", style: "margin-top:14px" }, h("h3", {}, "What limited the step size"), bars([...counts.entries()].sort((a, b) => b[1] - a[1]).slice(0, 12).map(([text, n]) => [text, n, `${n}`]))),
    h("details", { class: "more" }, h("summary", {}, shown.length < order.length ? `Steps (the first and the last ${most / 2} of ${order.length})` : `All ${order.length} steps`),
      table(["Time [s]", "Step [s]", "Reason", "Repeated attempts", ...columns.map((c) => c.text)], rows)),
  ];
}

addSection({ id: "steps", title: "Steps", place: 100, build: (page) => (page.runs.some((r) => r.table("steps")?.rows) ? [stepCharts(page), perRun(page, stepTables)] : []) });
