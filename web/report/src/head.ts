/** The head of the page: titles, how each run ended, its key figures and warnings. */
import { byId, h } from "./dom";
import { duration, place, short, Unit, unitOf, withUnit } from "./quantities";
import type { Answer, CastAnswer, Page, Run } from "./run";
import type { Workbench } from "./workbench";

type Node_ = Node | null;

/** What a number of summary.json is called and in which unit it is read. */
export function criterion(run: Run, name: string, end: "min" | "max"): { value: number; at?: number[]; unit: Unit; si: string } | undefined {
  const all = run.summary.criteria ?? {};
  const key = Object.keys(all).find((k) => k.startsWith(`${name}_${end}[`) || k === `${name}_${end}`);
  if (!key) return undefined;
  const si = /\[(.*)\]$/.exec(key)?.[1] ?? "1";
  const at = all[`${name}_${end}_at[m]`];
  return { value: all[key] as number, at: Array.isArray(at) ? at : undefined, unit: unitOf(name, si), si };
}

export function final(run: Run, header: string): number | undefined {
  const v = run.summary.final?.[header];
  return typeof v === "number" ? v : undefined;
}

const NIYAMA = "K^0.5 s^0.5/m";

interface Figure {
  label: string;
  text: (run: Run) => string | undefined;
  /** What step and mesh may have made of it: "± 1.1 s (step 0.5, mesh 0.65)". */
  error?: (run: Run) => string | undefined;
  place?: (run: Run) => { at: number[]; label: string } | undefined;
}

/** The error of an answer as people read it. */
export function errorText(answer: Answer | undefined, si: string, format: (v: number) => string): string | undefined {
  const of = (part: string) => answer?.[`error${part}[${si}]`];
  const all = of(""), step = of("_of_step"), mesh = of("_of_mesh");
  if (typeof all !== "number" || typeof step !== "number" || typeof mesh !== "number" || all <= 0) return undefined;
  const whole = format(rounded(all)), unit = whole.replace(/^\S+/, "");
  const bare = (part: number) => format(rounded(part)).replace(unit, "");  // the unit is told once
  return `± ${whole} (step ${bare(step)}, mesh ${bare(mesh)})`;
}

/** To two figures, as an error is told. */
function rounded(value: number): number {
  return Number(value.toPrecision(2));
}

/** The castings that are neither risers nor gating; all where there is nothing else. */
function parts(run: Run): CastAnswer[] {
  const all = Object.values(run.summary.answers?.castings ?? {}), found = all.filter((c) => !c.riser && !c.gating);
  return found.length ? found : all;
}

/** The least Niyama value of the parts. */
function leastNiyama(run: Run): { value: number; at: number[]; answer: Answer } | undefined {
  const told = parts(run).map((c) => c.least_niyama).filter((a) => a !== undefined);
  const value = (a: Answer) => a[`value[${NIYAMA}]`] as number;
  if (!told.length) return undefined;
  const answer = told.reduce((least, a) => (value(a) < value(least) ? a : least));
  return { value: value(answer), at: answer["at[m]"] as number[], answer };
}

/** The casting, no riser, whose last melt froze last. */
function lastFrozen(run: Run): Answer | undefined {
  const all = parts(run).map((c) => c.last_melt_froze).filter((a) => a !== undefined);
  return all.reduce((late: Answer | undefined, a) => (late && (late["value[s]"] as number) >= (a["value[s]"] as number) ? late : a), undefined);
}

function figures(): Figure[] {
  const of = (name: string, end: "min" | "max", format: (v: number, u: Unit) => string): Pick<Figure, "text" | "place"> => ({
    text: (r) => {
      const c = criterion(r, name, end);
      return c && format(c.value, c.unit);
    },
    place: (r) => {
      const c = criterion(r, name, end);
      return c?.at && { at: c.at, label: format(c.value, c.unit) };
    },
  });
  const largest = (id: string): Pick<Figure, "text" | "place"> => {
    const find = (r: Run) => {
      const field = r.fields.find((f) => f.id === id), castings = r.castings;
      const all = field?.extremes(r.times.length - 1).filter((e) => castings.length === 0 || castings.includes(e.body)) ?? [];
      return all.length ? { field: field!, most: all.reduce((a, b) => (b.high > a.high ? b : a)) } : undefined;
    };
    return {
      text: (r) => {
        const f = find(r);
        return f && withUnit(f.most.high, f.field.unit);
      },
      place: (r) => {
        const f = find(r);
        return f && { at: f.most.highAt, label: withUnit(f.most.high, f.field.unit) };
      },
    };
  };
  return [
    { label: "Freezes last", text: (r) => {
      const froze = lastFrozen(r);
      return froze ? duration(froze["value[s]"] as number) : of("solidified_at", "max", (v) => duration(v)).text(r);
    }, place: (r) => {
      const froze = lastFrozen(r);
      return froze ? { at: froze["at[m]"] as number[], label: duration(froze["value[s]"] as number) } : of("solidified_at", "max", (v) => duration(v)).place!(r);
    }, error: (r) => errorText(lastFrozen(r), "s", duration) },
    { label: "Longest freezing", ...of("local_solidification_time", "max", (v) => duration(v)),
      error: (r) => errorText(r.summary.answers?.errors_of_criteria?.local_solidification_time_max, "SI", duration) },
    { label: "Least Niyama", text: (r) => {
      const least = leastNiyama(r);
      return least ? withUnit(least.value, unitOf("niyama", NIYAMA)) : of("niyama", "min", (v, u) => withUnit(v, u)).text(r);
    }, place: (r) => {
      const least = leastNiyama(r);
      return least ? { at: least.at, label: withUnit(least.value, unitOf("niyama", NIYAMA)) } : of("niyama", "min", (v, u) => withUnit(v, u)).place!(r);
    }, error: (r) => errorText(leastNiyama(r)?.answer, NIYAMA, (v) => withUnit(v, unitOf("niyama", NIYAMA))) },
    { label: "Porosity (estimate)", ...of("shrinkage_porosity", "max", (v, u) => withUnit(v, u)) },
    { label: "Pores, in all", text: (r) => {
      const pores = r.summary.answers?.pores;
      return pores && withUnit(pores.share_of_casting, unitOf("pore_fraction", "1"));
    }, place: (r) => {
      const pores = r.summary.answers?.pores;
      return pores && { at: pores["at[m]"], label: `densest, ${withUnit(pores["value[1]"], unitOf("pore_fraction", "1"))}` };
    }, error: (r) => errorText(r.summary.answers?.pores, "1", (v) => withUnit(v, unitOf("pore_fraction", "1"))) },
    { label: "Pools closed off", text: (r) => (typeof r.summary.criteria?.closed_off_pools === "number" ? String(r.summary.criteria.closed_off_pools) : undefined) },
    { label: "Von Mises at end", ...largest("von_mises"),
      error: (r) => errorText(r.summary.answers?.largest_von_mises, "Pa", (v) => withUnit(v, unitOf("von_mises", "Pa"))) },
    { label: "Plastic strain", ...largest("equivalent_plastic_strain") },
    { label: "At the end", text: (r) => {
      const low = final(r, "T_min[degC]"), high = final(r, "T_max[degC]");
      return low !== undefined && high !== undefined ? (Math.abs(high - low) < 0.5 ? `${short(Math.round(high))} °C` : `${+low.toFixed(1)} … ${+high.toFixed(1)} °C`.replace(/-/g, "−")) : undefined;
    } },
  ];
}

/** "178.5 MPa" with a small unit; times stay as they are. */
function bold(text: string): HTMLElement {
  const match = /^([−\d.…·⁰¹²³⁴⁵⁶⁷⁸⁹⁻ ]+) (\D.*)$/.exec(text);
  return match && !/ (min|h) /.test(text) ? h("b", {}, match[1], h("i", {}, ` ${match[2]}`)) : h("b", {}, text);
}

function reached(run: Run): number {
  const time = run.table("history")?.numbers("time");
  return run.summary["end_time[s]"] ?? (time?.length ? time[time.length - 1] : run.times[run.times.length - 1] ?? 0);
}

export function buildHead(page: Page, bench: Workbench): void {
  const head = byId("head");
  const titles = [...new Set(page.runs.map((r) => r.meta.title || r.meta.name))];
  document.title = `${titles.join(" | ")} · Solidus`;
  head.append(h("h1", {}, titles.join("  |  ")));
  for (const run of page.runs) {
    const outcome = run.summary.outcome;
    const finished = outcome === "finished";
    const size = run.bodies.reduce((n, b) => n + b.n, 0);
    head.append(h("p", { class: "run-line" },
      h("span", { class: `badge ${finished ? "good" : "bad"}` }, outcome === undefined ? "not ended" : finished ? "finished" : "stopped"), " ",
      [run.meta.name, kindText(run), `${duration(reached(run))} simulated`, computed(run), size ? `${size.toLocaleString("en")} nodes` : ""].filter(Boolean).join(" · ")));
    if (outcome !== undefined && !finished) head.append(h("div", { class: "notice bad" }, `${run.meta.name}: ${outcome}`));
  }
  const box = h("div", { class: "figures" });
  for (const figure of figures()) {
    const texts = page.runs.map((r) => figure.text(r));
    if (texts.every((t) => t === undefined)) continue;
    const at = figure.place?.(page.runs[0]);
    const content: Node_[] = [h("span", {}, figure.label), ...texts.map((t) => bold(t ?? "–"))];
    for (const error of page.runs.map((r) => figure.error?.(r))) if (error !== undefined) content.push(h("em", { class: "error", title: "As far as step and mesh go" }, error));
    if (at && bench.ready)
      box.append(h("button", { class: "figure", title: "Show it in the picture", click: () => bench.fly(at.at, at.label) }, ...content, h("em", {}, `${place(at.at, page.runs[0].dimension)} ↗`)));
    else box.append(h("div", { class: "figure" }, ...content));
  }
  if (box.children.length) head.append(box);
  for (const run of page.runs) {
    const warnings = [...(run.summary.warnings ?? []), ...run.meta.notes];
    if (!warnings.length) continue;
    head.append(h("div", { class: "notice", id: run === page.runs[0] ? "warnings" : undefined },
      h("details", { open: warnings.length === 1 },
        h("summary", {}, h("b", {}, page.runs.length > 1 ? `${run.meta.name}: ` : "", warnings.length === 1 ? "One warning" : `${warnings.length} warnings`)),
        h("ul", {}, ...warnings.map((w) => h("li", {}, w))))));
  }
}

/** "2 rejected, 1 shortened": tries that were repeated with a smaller step, those that ended after heat alone apart. */
export function triesText(rejected = 0, shortened = 0): string {
  return [rejected > 0 ? `${rejected} rejected` : "", shortened > 0 ? `${shortened} shortened` : ""].filter(Boolean).join(", ");
}

/** What it took, and how well the first law held. */
function computed(run: Run): string {
  const s = run.summary, total = s["profile[s]"]?.total ?? s.seconds?.run, defect = s.relative_energy_defect;
  return [
    s.steps !== undefined ? `${s.steps} steps${total !== undefined ? ` in ${duration(total)}` : ""}` : "",
    s.rejected_steps || s.shortened_steps ? `tries repeated: ${triesText(s.rejected_steps, s.shortened_steps)}` : "",
    typeof defect === "number" ? `first law right to ${short(Math.abs(defect))}` : "",
  ].filter(Boolean).join(" · ");
}

function kindText(run: Run): string {
  return { axisymmetric: "axisymmetric", plane_strain: "plane strain", solid: "3-D" }[run.meta.kind] ?? run.meta.kind;
}
