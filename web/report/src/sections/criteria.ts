/** The least and greatest value of each criterion. */
import { byId, h, table } from "../dom";
import { criterion } from "../head";
import { duration, labelOf, withUnit } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, ofRuns } from "../section";
import type { Workbench } from "../workbench";

function criteriaTable(run: Run, index: number, bench: Workbench): Content {
  const all = run.summary.criteria ?? {};
  const names = [...new Set(Object.keys(all).flatMap((k) => /^(.*)_(?:min|max)(?:\[|$)/.exec(k)?.[1] ?? []))];
  if (!names.length) return null;
  const cell = (name: string, end: "min" | "max"): [string, Node | string] => {
    const c = criterion(run, name, end);
    if (!c) return ["–", ""];
    const text = c.unit.text === "s" ? duration(c.value) : withUnit(c.value, c.unit);
    return [text, c.at ? bench.placeButton(c.at, text, index) : ""];
  };
  const rows = names.map((name) => {
    const least = cell(name, "min"), most = cell(name, "max");
    const paint = run.fields.some((f) => f.id === name) && bench.ready
      ? h("button", { class: "link", title: "Paint it in the picture", click: () => {
        bench.setField(name);
        byId("view").scrollIntoView({ behavior: "smooth" });
      } }, labelOf(name))
      : labelOf(name);
    return [paint, least[0], least[1], most[0], most[1]];
  });
  return table(["Criterion", "Least", "at", "Greatest", "at"], rows);
}

addSection({ id: "criteria", title: "Criteria", place: 60, build: (page, bench) => ofRuns(page, (r) => r.summary.criteria, (r, i) => [criteriaTable(r, i, bench)]) });
