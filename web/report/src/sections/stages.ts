/** What each stage has left in the bodies: temperatures, stress and distortion at its end. */
import { byId, h, table } from "../dom";
import { duration, short, unitOf, withUnit } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, perRun } from "../section";
import type { Workbench } from "../workbench";

interface Stage {
  name: string;
  cycle: number;
  "end[s]": number;
  "lowest_temperature[K]"?: number;
  "highest_temperature[K]"?: number;
  "largest_von_mises[Pa]"?: number;
  "mean_von_mises[Pa]"?: number;
  "largest_distortion[m]"?: number;
}
const stagesOf = (run: Run): Stage[] => (run.summary.answers?.stages as Stage[] | undefined) ?? [];

function stages(run: Run, bench: Workbench): Content[] {
  const all = stagesOf(run);
  if (!all.length) return [h("p", { class: "hint" }, "No stage of this run is over.")];
  const shown = (value: number | undefined, field: string, si: string) => (value === undefined ? "–" : withUnit(value, unitOf(field, si)));
  const end = (at: number) => (bench.ready ? h("button", { class: "link", title: "Show its end in the picture", click: () => {
    bench.goTo(at);
    byId("view").scrollIntoView({ behavior: "smooth" });
  } }, duration(at)) : duration(at));
  const degrees = (stage: Stage) => {
    const [coldest, hottest] = [stage["lowest_temperature[K]"], stage["highest_temperature[K]"]];
    if (coldest === undefined || hottest === undefined) return "–";
    const [low, high] = [coldest, hottest].map((kelvin) => short(kelvin - 273.15));
    return `${low === high ? low : `${low} to ${high}`} °C`;
  };
  const cycles = all.some((stage) => stage.cycle > 0);
  const rows = all.map((stage) => [
    stage.name, ...(cycles ? [stage.cycle ? String(stage.cycle) : ""] : []), end(stage["end[s]"]), degrees(stage),
    shown(stage["largest_von_mises[Pa]"], "von_mises", "Pa"), shown(stage["mean_von_mises[Pa]"], "von_mises", "Pa"),
    shown(stage["largest_distortion[m]"], "distortion", "m"),
  ]);
  return [table(["Stage", ...(cycles ? ["Cycle"] : []), "Ends at", "Temperature", "Largest von Mises stress", "In the mean", "Largest distortion"], rows),
    h("p", { class: "hint" }, "Of what is cast; where nothing of it is there, of all bodies that are.")];
}

addSection({ id: "stages", title: "Stages", place: 45, build: (page, bench) => (page.runs.some((r) => stagesOf(r).length) ? [perRun(page, (r) => stages(r, bench))] : []) });
