/** Computing time by part. */
import { h } from "../dom";
import { duration, short } from "../quantities";
import type { Run } from "../run";
import { addSection, bars, Content, ofRuns } from "../section";

function cost(run: Run): Content[] {
  const profile = run.summary["profile[s]"];
  if (!profile) return [h("p", { class: "hint" }, "This run has no summary.")];
  const entries = Object.entries(profile).filter(([name]) => name !== "total").sort((a, b) => b[1] - a[1]);
  const shown = entries.slice(0, 12);
  const memory = run.summary["peak_memory[bytes]"]?.all_processes;
  const facts = [`${duration(profile.total)} in all`, run.summary.processes ? `${run.summary.processes} process${run.summary.processes > 1 ? "es" : ""}` : "", memory ? `${short(memory / 1e6)} MB at most` : ""].filter(Boolean).join(" · ");
  return [h("div", { class: "card" }, h("p", { class: "hint", style: "margin:0 0 10px" }, facts), bars(shown.map(([name, s]) => [name, s, duration(s)])))];
}

addSection({ id: "cost", title: "Computing time", place: 140, build: (page) => ofRuns(page, (r) => r.summary["profile[s]"], cost) });
