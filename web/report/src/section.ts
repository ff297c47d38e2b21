/** Sections of the page below the picture. Each is a file of sections/ that adds itself; build.mjs finds the files. */
import { h } from "./dom";
import type { Page, Run } from "./run";
import type { Workbench } from "./workbench";

export type Content = Node | null;

export interface Section {
  /** Of the element, and of links to it. */
  id: string;
  title: string;
  /** The order of sections; built-in ones have multiples of five. */
  place: number;
  /** What it shows; nothing, or null alone, where the runs have nothing for it: then there is no section. */
  build: (page: Page, bench: Workbench) => Content[];
}

const all: Section[] = [];

export function addSection(section: Section): void {
  all.push(section);
}

/** All sections in their order. */
export function sections(): Section[] {
  return [...all].sort((a, b) => a.place - b.place);
}

/** A chosen one of the runs where there are several. */
export function perRun(page: Page, build: (run: Run, index: number) => Content[]): HTMLElement {
  const box = h("div");
  const show = (i: number) => box.replaceChildren(...build(page.runs[i], i).filter((n): n is Node => n !== null));
  show(0);
  if (page.runs.length === 1) return box;
  const select = h("select", { "aria-label": "Run", change: () => show(+select.value) }, ...page.runs.map((r, i) => h("option", { value: i }, r.meta.name)));
  return h("div", {}, h("div", { class: "pick-run" }, h("span", { class: "muted" }, "Run"), select), box);
}

/** Of runs some of which have something to show. */
export function ofRuns(page: Page, has: (run: Run) => unknown, build: (run: Run, index: number) => Content[]): Content[] {
  return page.runs.some(has) ? [perRun(page, build)] : [];
}

export function bars(entries: [string, number, string][]): Node {
  const most = Math.max(...entries.map((e) => e[1]), 1e-30);
  return h("div", { class: "bars" }, ...entries.flatMap(([text, n, value]) => [h("span", {}, text), h("i", { style: `width:${(100 * n) / most}%` }), h("output", {}, value)]));
}
