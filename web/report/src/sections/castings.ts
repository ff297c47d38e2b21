/** What was cast, body by body. */
import { h, table } from "../dom";
import { errorText } from "../head";
import { duration, PERCENT, short, unitOfValue, withUnit } from "../quantities";
import type { Answer, Run } from "../run";
import { addSection, Content, ofRuns } from "../section";
import type { Workbench } from "../workbench";

/** What was cast, body by body: parts, risers, gating. */
function castings(run: Run, index: number, bench: Workbench): Content[] {
  const answers = run.summary.answers, all = Object.entries(answers?.castings ?? {});
  const cell = (answer: Answer | undefined, si: string, format: (v: number) => string): Node | string => {
    if (!answer) return "–";
    const text = format(answer[`value[${si}]`] as number), error = errorText(answer, si, format);
    return h("span", {}, `${text} `, h("small", {}, error ?? ""), " ", bench.placeButton(answer["at[m]"] as number[], text, index));
  };
  const root = "K^0.5 s^0.5/m", niyama = unitOfValue(root), share = PERCENT;
  const part = Math.max(...all.filter(([, c]) => !c.riser && !c.gating).map(([, c]) => (c.last_melt_froze?.["value[s]"] as number) ?? NaN));
  const rows = all.map(([name, c]) => {
    const mass = c["mass[kg]"], froze = c.last_melt_froze?.["value[s]"] as number | undefined;
    const margin = c.riser && froze !== undefined ? froze - part : NaN, error = (c.last_melt_froze?.["error[s]"] as number) ?? 0;
    const verdict = Number.isNaN(margin) ? "" : Math.abs(margin) < error ? "too close to tell" : margin > 0 ? `outlived the part by ${duration(margin)}` : `froze ${duration(-margin)} before the part`;
    const lost = (key: string): number => (c[key] as number | undefined) ?? 0;
    const holes = c["holes[m3]"] === undefined ? "–" : `${short(lost("holes[m3]") * 1e6)} cm³`;
    const pores = c["holes[m3]"] !== undefined ? `${short((lost("unfed_pores[m3]") + lost("gas_pores[m3]")) * 1e6)} cm³` : c.pores ? `${short((c.pores["volume[m3]"] as number) * 1e6)} cm³, ${withUnit(c.pores.share_of_casting as number, share)}` : "–";
    return [name, c.riser ? "riser" : c.gating ? "gating" : "part", mass === undefined ? "–" : `${short(mass)} kg`, cell(c.last_melt_froze, "s", duration), cell(c.least_niyama, root, (v) => withUnit(v, niyama)), holes, pores, verdict];
  });
  const told = typeof answers?.yield === "number" ? h("p", { class: "hint" }, `${short(100 * answers.yield)} % of what is poured is part.`) : null;
  return [table(["Body", "", "Mass", "Frozen after", "Least Niyama", "Holes", "Pores", "Verdict"], rows), told];
}

addSection({ id: "castings", title: "Castings", place: 40, build: (page, bench) => ofRuns(page, (r) => Object.keys(r.summary.answers?.castings ?? {}).length > 1, (r, i) => castings(r, i, bench)) });
