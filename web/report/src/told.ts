/** Sections that the program declares (results/report/page_section.hpp): texts, tables and curves. */
import { chart } from "./charts";
import { h, table } from "./dom";
import { short, unitText } from "./quantities";
import type { Page, Run } from "./run";
import { addSection, ofRuns } from "./section";

interface Curves {
  title: string;
  unit: string;
  x: { label: string; unit: string; values: number[] };
  lines: { label: string; values: number[] }[];
}
type Block = { text: string } | { table: { head: string[]; rows: (string | number)[][] } } | { chart: Curves };
export interface ToldSection {
  id: string;
  title: string;
  place: number;
  blocks: Block[];
}

function block(b: Block): Node {
  if ("text" in b) return h("p", { class: "hint" }, b.text);
  if ("table" in b) return table(b.table.head, b.table.rows.map((row) => row.map((cell) => (typeof cell === "number" ? short(cell) : cell))));
  const { title, unit, x, lines } = b.chart;
  return h("div", { class: "cards" }, chart({
    title, unit: unitText(unit), xLabel: x.label, xUnit: unitText(x.unit), time: x.label === "Time",
    lines: lines.map((line, i) => ({ label: line.label, x: x.values, y: line.values, colour: i })),
  }));
}

/** Sections of the program that this viewer does not know: a section for each title, with the runs that have it. */
export function addTold(page: Page): void {
  const told = new Map<string, ToldSection>();
  for (const run of page.runs) for (const section of run.meta.sections ?? []) told.set(section.id, section);
  for (const { id, title, place } of told.values()) {
    const of = (run: Run) => run.meta.sections?.find((s) => s.id === id);
    addSection({ id, title, place, build: () => ofRuns(page, of, (run) => (of(run)?.blocks ?? []).map(block)) });
  }
}
