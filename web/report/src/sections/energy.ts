/** Balances of energy and entropy: the columns of the history that have charts of their own. */
import { chart } from "../charts";
import { charts, linesOf } from "../columns";
import { h } from "../dom";
import { unitText } from "../quantities";
import type { Page } from "../run";
import { addSection, Content } from "../section";

function energy(page: Page): Content[] {
  const cards = charts(page, "history").map((c) =>
    chart({ title: c.title, unit: unitText(c.unit), lines: c.headers.flatMap((x, i) => linesOf(page, "history", x, i)), time: true, logarithmic: c.logarithmic }));
  if (!cards.length) return [];
  return [
    h("p", { class: "hint" }, "Sums since the start. 𝓛 is the work that the bodies could still deliver in surroundings at the ambient temperature; without supply from outside it falls in every step (monograph 2.24)."),
    h("div", { class: "cards" }, ...cards),
  ];
}

addSection({ id: "energy", title: "Energy and 𝓛", place: 90, build: energy });
