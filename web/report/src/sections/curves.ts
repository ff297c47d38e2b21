/** All columns of the history that have no chart of their own, by their unit. */
import { chart } from "../charts";
import { columnOf, constantZero, headersOf, labelOfColumn, linesOf, split } from "../columns";
import { h } from "../dom";
import { measureOf, unitText } from "../quantities";
import type { Page } from "../run";
import { addSection, Content } from "../section";

function curves(page: Page): Content[] {
  const groups = new Map<string, string[]>();
  const silent: string[] = [];
  for (const header of headersOf(page, "history")) {
    const { unit } = split(header);
    if (columnOf("history", header)?.chart) continue;  // it has one of its own
    const columns = page.runs.map((r) => r.table("history")?.numbers(header)).filter((c) => c && c.length);
    if (!columns.length) continue;
    if (columns.every((c) => constantZero(c!))) {
      silent.push(labelOfColumn("history", header));
      continue;
    }
    // Numbers of things would flatten shares.
    const counts = unit === "1" && columns.some((c) => Array.prototype.some.call(c, (v: number) => Math.abs(v) > 1.5));
    const group = counts ? "counts" : unit;
    groups.set(group, [...(groups.get(group) ?? []), header]);
  }
  const cards: Node[] = [];
  for (const [unit, headers] of groups) {
    const size = unit === "N" || unit === "J" || unit === "N m" ? 5 : 8;
    for (let i = 0; i < headers.length; i += size) {
      const lines = headers.slice(i, i + size).flatMap((header, k) => linesOf(page, "history", header, k, columnOf("history", header)?.background && headers.length > 4));
      cards.push(chart({ title: unit === "counts" ? "Numbers" : measureOf(unit), unit: unit === "counts" ? "" : unitText(unit), lines, time: true }));
    }
  }
  return cards.length ? [
    h("p", { class: "hint" }, "Drag over a chart to zoom in, double-click to zoom out; click goes to that moment in the picture; a name in the legend turns its curve off."),
    h("div", { class: "cards" }, ...cards),
    silent.length ? h("p", { class: "hint" }, `Zero throughout: ${silent.join(", ")}.`) : null,
  ] : [];
}

addSection({ id: "curves", title: "Curves", place: 30, build: curves });
