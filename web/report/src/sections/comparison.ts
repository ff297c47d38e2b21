/** Runs side by side: last values of the history and of the criteria. */
import { table } from "../dom";
import { criterion, final } from "../head";
import { headOfColumn } from "../columns";
import { labelOf, short, Unit } from "../quantities";
import type { Page } from "../run";
import { addSection } from "../section";

function comparison(page: Page): Node {
  const headers = [...new Set(page.runs.flatMap((r) => Object.keys(r.summary.final ?? {})))];
  const rows = headers.map((header) => {
    const values = page.runs.map((r) => final(r, header));
    const [a, b] = values;
    const difference = a !== undefined && b !== undefined ? b - a : undefined;
    return [headOfColumn("history", header), ...values.map((v) => (v === undefined ? "–" : short(v))), difference === undefined ? "–" : short(difference)];
  });
  const keys = [...new Set(page.runs.flatMap((r) => Object.keys(r.summary.criteria ?? {})))].filter((k) => /_(min|max)(\[|$)/.test(k));
  for (const key of keys) {
    const match = /^(.*)_(min|max)(?:\[(.*)\])?$/.exec(key)!;
    const values = page.runs.map((r) => criterion(r, match[1], match[2] as "min" | "max"));
    const show = (v?: { value: number; unit: Unit }) => (v ? v.value * v.unit.scale + v.unit.offset : undefined);
    const [a, b] = values.map(show), unit = values.find((v) => v)!.unit;
    rows.push([`${match[2] === "min" ? "least" : "largest"} ${labelOf(match[1]).toLowerCase()}${unit.text ? ` [${unit.text}]` : ""}`, ...values.map((v) => (v ? short(show(v)!) : "–")), a !== undefined && b !== undefined ? short(b - a) : "–"]);
  }
  const difference = page.runs.length > 1 ? "second − first" : "";
  return table(["At the end", ...page.runs.map((r) => r.meta.name), difference], rows);
}

addSection({ id: "comparison", title: "Comparison", place: 10, build: (page) => (page.runs.length > 1 ? [comparison(page)] : []) });
