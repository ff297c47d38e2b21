/** The head of the page: titles, how each run ended, its key figures and warnings. */
import { byId, h } from "./dom";
import { duration, headlines, PERCENT, place, Quantity, quantityOf, short, Unit, unitOf, withUnit } from "./quantities";
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

/** The end of a quantity's range that matters, as findings and as answers are named. */
function worst(of: Quantity): { end: "min" | "max"; answer: string } {
  return of.worst === "least" ? { end: "min", answer: `least_${of.name}` } : { end: "max", answer: `largest_${of.name}` };
}

/** The worst of what the answers say of a quantity for each part. */
function worstOfParts(run: Run, of: Quantity): { value: number; answer: Answer } | undefined {
  const key = worst(of).answer, sign = of.worst === "least" ? 1 : -1, si = of.root_unit ?? of.unit;
  const told = parts(run).map((c) => c[key] as Answer | undefined).filter((a): a is Answer => a !== undefined).map((answer) => ({ answer, value: answer[`value[${si}]`] as number }));
  return told.length ? told.reduce((a, b) => (sign * b.value < sign * a.value ? b : a)) : undefined;
}

/** The worst of what the answers say of a quantity for the whole run, of all contacts where they say it of each. */
function worstOfWhole(run: Run, of: Quantity): { found: { value: number; at?: number[] }; answer: Answer } | undefined {
  const { answer: key } = worst(of), all = run.summary.answers, sign = of.worst === "least" ? 1 : -1, value = `value[${of.root_unit ?? of.unit}]`;
  const answers = [all?.[key], ...Object.values((all?.[`${key}s`] as object | undefined) ?? {})] as (Answer | undefined)[];
  const told = answers.filter((a): a is Answer => typeof a?.[value] === "number");
  if (!told.length) return undefined;
  const answer = told.reduce((a, b) => (sign * (b[value] as number) < sign * (a[value] as number) ? b : a));
  return { found: { value: answer[value] as number, at: answer["at[m]"] as number[] | undefined }, answer };
}

/** The casting, no riser, whose last melt froze last. */
function lastFrozen(run: Run): Answer | undefined {
  const all = parts(run).map((c) => c.last_melt_froze).filter((a) => a !== undefined);
  return all.reduce((late: Answer | undefined, a) => (late && (late["value[s]"] as number) >= (a["value[s]"] as number) ? late : a), undefined);
}

function textOf(value: number, unit: Unit): string {
  return unit.text === "s" ? duration(value) : withUnit(value, unit);
}

/** The figure of a quantity: what the answers say of the parts, else what the criteria found, else the largest in the elements at the end. */
function figureOf(of: Quantity): Figure {
  const { end } = worst(of), si = of.root_unit ?? of.unit, unit = unitOf(of.name, of.unit);
  const find = (r: Run): { value: number; at?: number[] } | undefined => {
    const told = worstOfParts(r, of);
    if (told) return { value: told.value, at: told.answer["at[m]"] as number[] };
    const found = criterion(r, of.name, end) ?? worstOfWhole(r, of)?.found;
    if (found) return found;
    const field = r.fields.find((f) => f.id === of.name), castings = r.castings;
    if (!field?.ofElements) return undefined;
    const all = field.extremes(r.times.length - 1).filter((e) => castings.length === 0 || castings.includes(e.body));
    if (!all.length) return undefined;
    const most = all.reduce((a, b) => (end === "max" ? b.high > a.high : b.low < a.low) ? b : a);
    return end === "max" ? { value: most.high, at: most.highAt } : { value: most.low, at: most.lowAt };
  };
  const shown = (v: number) => textOf(v, unit);
  return {
    label: of.headline!,
    text: (r) => {
      const found = find(r);
      return found && shown(found.value);
    },
    place: (r) => {
      const found = find(r);
      return found?.at && { at: found.at, label: shown(found.value) };
    },
    error: (r) => {
      const all = r.summary.answers, found = all?.errors_of_criteria?.[`${of.name}_${end}`];
      return errorText(worstOfParts(r, of)?.answer, si, shown) ?? errorText(found, "SI", shown) ?? errorText(worstOfWhole(r, of)?.answer, si, shown);
    },
  };
}

function figures(): Figure[] {
  // The answers tell these two better than a field does.
  const frozen = quantityOf("solidified_at"), porous = quantityOf("pore_fraction");
  const others = headlines().filter((q) => q !== frozen && q !== porous), share = PERCENT;
  return [
    { label: "Freezes last", text: (r) => {
      const froze = lastFrozen(r);
      return froze ? duration(froze["value[s]"] as number) : frozen && figureOf(frozen).text(r);
    }, place: (r) => {
      const froze = lastFrozen(r);
      return froze ? { at: froze["at[m]"] as number[], label: duration(froze["value[s]"] as number) } : frozen && figureOf(frozen).place!(r);
    }, error: (r) => errorText(lastFrozen(r), "s", duration) },
    ...others.filter((q) => q.group === "criteria").map(figureOf),
    { label: "Pores, in all", text: (r) => {
      const pores = r.summary.answers?.pores;
      return pores && withUnit(pores.share_of_casting, share);
    }, place: (r) => {
      const pores = r.summary.answers?.pores;
      return pores && { at: pores["at[m]"], label: `densest, ${withUnit(pores["value[1]"], share)}` };
    }, error: (r) => errorText(r.summary.answers?.pores, "1", (v) => withUnit(v, share)) },
    { label: "Pools closed off", text: (r) => (typeof r.summary.criteria?.closed_off_pools === "number" ? String(r.summary.criteria.closed_off_pools) : undefined) },
    ...others.filter((q) => q.group !== "criteria").map(figureOf),
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

/** "2 rejected, 1 shortened": attempts that were repeated with a smaller step, those that ended after heat alone apart. */
export function triesText(rejected = 0, shortened = 0): string {
  return [rejected > 0 ? `${rejected} rejected` : "", shortened > 0 ? `${shortened} shortened` : ""].filter(Boolean).join(", ");
}

/** Steps, computing time and how well energy was conserved. */
function computed(run: Run): string {
  const s = run.summary, total = s["profile[s]"]?.total ?? s.seconds?.run, defect = s.relative_energy_defect;
  return [
    s.steps !== undefined ? `${s.steps} steps${total !== undefined ? ` in ${duration(total)}` : ""}` : "",
    s.rejected_steps || s.shortened_steps ? `repeated attempts: ${triesText(s.rejected_steps, s.shortened_steps)}` : "",
    typeof defect === "number" ? `energy conserved to ${short(Math.abs(defect))}` : "",
  ].filter(Boolean).join(" · ");
}

function kindText(run: Run): string {
  return { axisymmetric: "axisymmetric", plane_strain: "plane strain", solid: "3-D" }[run.meta.kind] ?? run.meta.kind;
}
