/** Castings and the die from shot to shot. */
import { chart } from "../charts";
import { charts, columnOf, labelOfColumn, linesOf, listedHeaders, split } from "../columns";
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
  const t = run.table("shots");
  if (!t?.rows) return [h("p", { class: "hint" }, "This run has no shots.")];
  // The shot leads its row; the end of a shot goes to that moment in the picture.
  const heads = ["shot[1]", ...listedHeaders("shots", t.headers).filter((x) => x !== "shot[1]")];
  const cell = (header: string, i: number) => {
    const value = t.numbers(header)?.[i], { name, unit } = split(header);
    if (value === undefined) return "–";
    if (value === columnOf("shots", header)?.no_value) return name === "time_to_solidify" ? "left with melt" : "–";
    if (name === "time" && bench.ready) return h("button", { class: "link", title: "Show its end in the picture", click: () => {
      bench.goTo(value);
      byId("view").scrollIntoView({ behavior: "smooth" });
    } }, duration(value));
    return unit === "s" ? duration(value) : unit === "1" ? short(value) : `${short(value)} ${unitText(unit)}`;
  };
  const rows = Array.from({ length: t.rows }, (_, i) => [...heads.map((x) => cell(x, i)), t.numbers("periodic")?.[i] ? "periodic" : ""]);
  return [h("div", { style: "height:12px" }), table([...heads.map((x) => labelOfColumn("shots", x)), ""], rows)];
}

addSection({ id: "shots", title: "Shots", place: 80, build: (page, bench) => (page.runs.some((r) => r.table("shots")?.rows) ? [shotCharts(page), perRun(page, (r) => shots(r, bench))] : []) });
