/** What is below the picture: the sections that have something to show. */
import "all-sections";
import { byId, h } from "./dom";
import type { Page } from "./run";
import { sections } from "./section";
import { addTold } from "./told";
import type { Workbench } from "./workbench";

/** Returns what the navigation lists. */
export function buildSections(page: Page, bench: Workbench): [string, string][] {
  const out: [string, string][] = [];
  addTold(page);
  for (const { id, title, build } of sections()) {
    const there = build(page, bench).filter((n): n is Node => n !== null);
    if (!there.length) continue;
    byId("sections").append(h("section", { id }, h("h2", {}, title), ...there));
    out.push([id, title]);
  }
  return out;
}
