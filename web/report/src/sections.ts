/** What is below the picture: curves, criteria, pools, steps, energy, materials, the case. */
import { byId, h, save, svg, table } from "./dom";
import { chart, Line } from "./charts";
import { duration, labelOf, PERCENT, short, Unit, unitOfValue, unitText, withUnit } from "./quantities";
import { fillingSection } from "./filling";
import { criterion, errorText, final, triesText } from "./head";
import type { Answer, Page, Run } from "./run";
import type { Workbench } from "./workbench";

type Node_ = Node | null;

/** A chosen one of the runs where there are several. */
function perRun(page: Page, build: (run: Run, index: number) => Node_[]): HTMLElement {
  const box = h("div");
  const show = (i: number) => box.replaceChildren(...build(page.runs[i], i).filter((n): n is Node => n !== null));
  show(0);
  if (page.runs.length === 1) return box;
  const select = h("select", { "aria-label": "Run", change: () => show(+select.value) }, ...page.runs.map((r, i) => h("option", { value: i }, r.meta.name)));
  return h("div", {}, h("div", { class: "pick-run" }, h("span", { class: "muted" }, "Run"), select), box);
}

/** Returns what the navigation lists. */
export function buildSections(page: Page, bench: Workbench): [string, string][] {
  const out: [string, string][] = [];
  const add = (id: string, title: string, content: (Node | null)[]) => {
    const there = content.filter((n): n is Node => n !== null);
    if (!there.length) return;
    byId("sections").append(h("section", { id }, h("h2", {}, title), ...there));
    out.push([id, title]);
  };
  if (page.runs.length > 1) add("comparison", "Comparison", [comparison(page)]);
  add("filling", "Filling", page.runs.some((r) => r.meta.filling_text) ? [perRun(page, fillingSection)] : []);
  add("curves", "Curves", curves(page));
  add("castings", "Castings", page.runs.some((r) => Object.keys(r.summary.answers?.castings ?? {}).length > 1) ? [perRun(page, (r, i) => castings(r, i, bench))] : []);
  add("uncertain", "Uncertain data", page.runs.some((r) => r.uncertain?.answers?.length) ? [perRun(page, (r) => uncertain(r))] : []);
  add("criteria", "Criteria", page.runs.some((r) => r.summary.criteria) ? [perRun(page, (r, i) => [criteriaTable(r, i, bench)])] : []);
  add("pools", "Pools of melt", page.runs.some((r) => (r.table("pools")?.rows ?? 0) > 0) ? [perRun(page, (r, i) => pools(r, i, bench))] : []);
  add("shots", "Shots", page.runs.some((r) => (r.table("shots")?.rows ?? 0) > 0) ? [shotCharts(page), perRun(page, (r) => shots(r, bench))] : []);
  add("energy", "Energy and 𝓛", energy(page));
  add("steps", "Steps", page.runs.some((r) => (r.table("steps")?.rows ?? 0) > 0) ? [stepCharts(page), perRun(page, (r) => stepTables(r))] : []);
  add("understood", "Bodies", page.runs.some((r) => r.summary.understood?.bodies?.length) ? [perRun(page, (r) => understood(r))] : []);
  add("materials", "Materials", page.runs.some((r) => r.meta.materials.length) ? [perRun(page, materials)] : []);
  add("case", "Case", [perRun(page, caseText)]);
  add("cost", "Computing time", page.runs.some((r) => r.summary["profile[s]"]) ? [perRun(page, cost)] : []);
  return out;
}

const ENERGIES = new Set(["stored_heat", "heat_in", "structural_energy", "work", "contact_energy", "numerical_dissipation", "kinetic_energy", "viscous_dissipation", "plastic_work", "plastic_dissipation", "hardening_energy", "heat_exchanged"]);
const OTHER_AUDITS = new Set(["energy_defect", "lyapunov", "lyapunov_mechanical", "lyapunov_thermal", "entropy", "entropy_production"]);
const QUANTITY: Record<string, string> = { s: "Times", degC: "Temperatures", K: "Temperatures", mm: "Lengths", um: "Lengths", m: "Lengths", W: "Heat flow", N: "Forces", kN: "Forces", "1": "Fractions", counts: "Numbers", percent: "Strains and shares", MPa: "Stresses", Pa: "Stresses", J: "Energies", "N m": "Moments" };

function split(header: string): { name: string; unit: string } {
  const match = /^(.*)\[(.*)\]$/.exec(header);
  return match ? { name: match[1], unit: match[2] } : { name: header, unit: "" };
}

const constantZero = (values: ArrayLike<number>) => Array.prototype.every.call(values, (v: number) => v === 0);

/** Lines of one column in all runs. */
function linesOf(page: Page, tableName: string, header: string, colour: number, off = false): Line[] {
  return page.runs.flatMap((run, r) => {
    const t = run.table(tableName), x = t?.numbers("time"), y = t?.numbers(header);
    if (!x || !y || !y.length) return [];
    const name = split(header).name.replace(/_/g, " ");
    return [{ label: page.runs.length > 1 ? `${name} · ${run.meta.name}` : name, x, y, colour, dashed: r > 0, off: off || r > 1 }];
  });
}

function headersOf(page: Page, tableName: string): string[] {
  return [...new Set(page.runs.flatMap((r) => r.table(tableName)?.headers ?? []))].filter((x) => !/^(time|stage|cycle)\[/.test(x));
}

function curves(page: Page): Node_[] {
  const groups = new Map<string, string[]>();
  const silent: string[] = [];
  for (const header of headersOf(page, "history")) {
    const { name, unit } = split(header);
    if ((ENERGIES.has(name) || OTHER_AUDITS.has(name)) && /J/.test(unit)) continue;
    const columns = page.runs.map((r) => r.table("history")?.numbers(header)).filter((c) => c && c.length);
    if (!columns.length) continue;
    if (columns.every((c) => constantZero(c!))) {
      silent.push(name.replace(/_/g, " "));
      continue;
    }
    // Numbers of things would flatten shares.
    const counts = unit === "1" && columns.some((c) => Array.prototype.some.call(c, (v: number) => Math.abs(v) > 1.5));
    const group = counts ? "counts" : unit;
    groups.set(group, [...(groups.get(group) ?? []), header]);
  }
  const cards: Node[] = [];
  for (const [unit, headers] of groups) {
    const size = unit === "N" || unit === "J" || unit === "N m" ? 5 : 8;
    for (let i = 0; i < headers.length; i += size) {
      const lines = headers.slice(i, i + size).flatMap((header, k) => linesOf(page, "history", header, k, unit === "degC" && /^T_(min|max)\[/.test(header) && headers.length > 4));
      cards.push(chart({ title: QUANTITY[unit] ?? unitText(unit), unit: unit === "counts" ? "" : unitText(unit), lines, time: true }));
    }
  }
  return cards.length ? [
    h("p", { class: "hint" }, "Drag over a chart to zoom in, double-click to zoom out; click goes to that moment in the picture; a name in the legend turns its curve off."),
    h("div", { class: "cards" }, ...cards),
    silent.length ? h("p", { class: "hint" }, `Zero throughout: ${silent.join(", ")}.`) : null,
  ] : [];
}

function energy(page: Page): Node_[] {
  const there = headersOf(page, "history").filter((x) => {
    const columns = page.runs.map((r) => r.table("history")?.numbers(x));
    return columns.some((c) => c && !constantZero(c));
  });
  const pick = (names: string[] | Set<string>) => there.filter((x) => new Set(names).has(split(x).name) && /J/.test(split(x).unit));
  const make = (title: string, headers: string[], unit: string) =>
    headers.length ? chart({ title, unit, lines: headers.flatMap((x, i) => linesOf(page, "history", x, i)), time: true }) : null;
  const cards = [
    make("Heat", pick(["stored_heat", "heat_in", "heat_exchanged"]), "J"),
    make("Mechanical energies", pick(["structural_energy", "work", "contact_energy", "kinetic_energy", "viscous_dissipation", "plastic_work", "plastic_dissipation", "hardening_energy"]), "J"),
    make("Energy imbalance", pick(["energy_defect"]), "J"),
    make("Functional 𝓛 of stability", pick(["lyapunov"]), "J"),
    make("Change of 𝓛 in a step, by phase", pick(["lyapunov_mechanical", "lyapunov_thermal"]), "J"),
    make("Entropy", pick(["entropy", "entropy_production"]), "J/K"),
  ].filter((c): c is HTMLElement => c !== null);
  if (!cards.length) return [];
  return [
    h("p", { class: "hint" }, "Sums since the start. 𝓛 is the work that the bodies could still deliver in surroundings at the ambient temperature; without supply from outside it falls in every step (monograph 2.24)."),
    h("div", { class: "cards" }, ...cards),
  ];
}

function comparison(page: Page): Node {
  const headers = [...new Set(page.runs.flatMap((r) => Object.keys(r.summary.final ?? {})))];
  const rows = headers.map((header) => {
    const { name, unit } = split(header);
    const values = page.runs.map((r) => final(r, header));
    const [a, b] = values;
    const difference = a !== undefined && b !== undefined ? b - a : undefined;
    return [`${name.replace(/_/g, " ")}${unit && unit !== "1" ? ` [${unitText(unit)}]` : ""}`, ...values.map((v) => (v === undefined ? "–" : short(v))), difference === undefined ? "–" : short(difference)];
  });
  const keys = [...new Set(page.runs.flatMap((r) => Object.keys(r.summary.criteria ?? {})))].filter((k) => /_(min|max)(\[|$)/.test(k));
  for (const key of keys) {
    const match = /^(.*)_(min|max)(?:\[(.*)\])?$/.exec(key)!;
    const values = page.runs.map((r) => criterion(r, match[1], match[2] as "min" | "max"));
    const show = (v?: { value: number; unit: Unit }) => (v ? v.value * v.unit.scale + v.unit.offset : undefined);
    const [a, b] = values.map(show), unit = values.find((v) => v)!.unit;
    rows.push([`${match[2] === "min" ? "least" : "largest"} ${labelOf(match[1]).toLowerCase()}${unit.text ? ` [${unit.text}]` : ""}`, ...values.map((v) => (v ? short(show(v)!) : "–")), a !== undefined && b !== undefined ? short(b - a) : "–"]);
  }
  const difference = page.runs.length > 1 ? "second − first" : "";
  return table(["At the end", ...page.runs.map((r) => r.meta.name), difference], rows);
}

/** What was cast, body by body: parts, risers, gating. */
function castings(run: Run, index: number, bench: Workbench): Node_[] {
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

/** A tornado for each answer: from what it falls to what it rises where each datum goes to its ends. */
function uncertain(run: Run): Node_[] {
  const all = run.uncertain;
  if (!all?.answers?.length) return [h("p", { class: "hint" }, "This run belongs to no `solidus uncertain`.")];
  const most = 8, wide = 420, row = 22;
  const boxes = all.answers.map((answer) => {
    const parts = answer.parts.slice(0, most);
    const ends = parts.map((p) => [p.down ?? 2 * answer.value - (p.up ?? answer.value), p.up ?? answer.value]);
    const band = answer.step_and_mesh ?? 0;
    const low = Math.min(answer.value - band, ...ends.flat()), high = Math.max(answer.value + band, ...ends.flat()), span = high - low || 1;
    const x = (v: number) => ((v - low) / span) * wide;
    const bars = parts.map((p, i) => {
      const [a, b] = ends[i];
      return svg("g", {}, svg("rect", { x: x(Math.min(a, b)), y: i * row + 4, width: Math.max(1, Math.abs(x(b) - x(a))), height: row - 8, class: "tornado" }),
        svg("title", {}, `${p.label}: ${short(a)} to ${short(b)} ${answer.unit}`));
    });
    if (band > 0) bars.push(svg("rect", { x: x(answer.value - band), y: parts.length * row + 4, width: Math.max(1, x(answer.value + band) - x(answer.value - band)), height: row - 8, class: "tornado-band" }));
    const n = bars.length, names = [...parts.map((p) => `${p.label} ± ${short(p.plus_minus)}`), ...(band > 0 ? [`step and mesh ± ${short(band)}`] : [])];
    const labels = names.map((name, i) => svg("text", { x: wide + 10, y: i * row + row / 2 + 4, class: "tornado-text" }, name));
    const picture = svg("svg", { viewBox: `0 0 ${wide + 400} ${n * row + 4}`, class: "tornado-picture", role: "img", "aria-label": `What moves ${answer.name}` },
      ...bars, svg("line", { x1: x(answer.value), x2: x(answer.value), y1: 0, y2: n * row, class: "tornado-middle" }), ...labels);
    return h("div", { class: "tornado-box" }, h("h3", {}, `${answer.name}: ${short(answer.value)} ± ${short(answer.plus_minus)} ${answer.unit}`), picture,
      answer.jumps ? h("p", { class: "hint" }, "About as much by whatever is moved: steps and mesh more than data.") : null);
  });
  return [h("p", { class: "hint" }, `± holds ${short(100 * (all.coverage ?? 0.95))} %. Bars: from one end of a datum to the other; the line is the answer as computed.`), ...boxes,
    ...(all.remarks ?? []).map((r) => h("p", { class: "hint" }, r))];
}

function criteriaTable(run: Run, index: number, bench: Workbench): Node_ {
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

function pools(run: Run, index: number, bench: Workbench): Node_[] {
  const t = run.table("pools");
  const time = t?.numbers("time"), number = t?.numbers("pool"), parent = t?.numbers("parent"), closed = t?.numbers("closed_off_since"), frozen = t?.numbers("frozen_at");
  const volume = t?.numbers("volume"), x = t?.numbers("x"), y = t?.numbers("y"), z = t?.numbers("z");
  if (!t || !time || !number || !parent || !closed || !frozen || !volume || !x || !y || !z) return [h("p", { class: "hint" }, "This run has no table of pools.")];
  interface Pool { number: number; parent: number; from: number; to: number; closed: number; frozen: number; volume: number; at: number[] }
  const all = new Map<number, Pool>();
  for (let i = 0; i < t.rows; ++i) {
    const p = all.get(number[i]) ?? { number: number[i], parent: parent[i], from: time[i], to: time[i], closed: -1, frozen: -1, volume: 0, at: [] };
    p.to = time[i];
    if (closed[i] >= 0) p.closed = closed[i];
    if (frozen[i] >= 0) p.frozen = frozen[i];
    p.volume = Math.max(p.volume, volume[i]);
    p.at = [x[i], y[i], z[i]];
    all.set(p.number, p);
  }
  const list = [...all.values()];
  const rows = list.map((p) => [
    `${p.number}`, p.parent > 0 ? `${p.parent}` : "–", duration(p.from), p.closed >= 0 ? duration(p.closed) : "fed to the end", p.frozen >= 0 ? duration(p.frozen) : "left as melt or still there",
    withUnit(p.volume, unitOfValue("m3")), bench.placeButton(p.at, `pool ${p.number}`, index),
  ]);
  return [h("div", { class: "card" }, gantt(list)), h("div", { style: "height:12px" }), table(["Pool", "Split off from", "Since", "Closed off since", "Frozen at", "Largest volume", "Last melt at"], rows)];
}

function gantt(pools: { number: number; from: number; to: number; closed: number; frozen: number }[]): Node {
  const shown = pools.slice(0, 30), end = Math.max(...pools.map((p) => Math.max(p.to, p.frozen))) || 1;
  const left = 62, width = 1000, row = 22, at = (t: number) => left + ((width - left - 20) * t) / end;
  const height = shown.length * row + 30;
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((s) => s * end);
  return svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "gantt", role: "img", "aria-label": "Life of the pools: orange fed, red closed off" },
    ...ticks.flatMap((t) => [svg("line", { x1: at(t), x2: at(t), y1: 0, y2: height - 22 }), svg("text", { x: at(t), y: height - 6, class: "axis", "text-anchor": t === end ? "end" : "middle" }, duration(t))]),
    ...shown.flatMap((p, i) => {
      const y = i * row + 4, stop = p.frozen >= 0 ? p.frozen : p.to, open = p.closed >= 0 ? Math.min(p.closed, stop) : stop;
      return [
        svg("text", { x: 0, y: y + 12 }, `pool ${p.number}`),
        svg("rect", { x: at(p.from), y, width: Math.max(1.5, at(open) - at(p.from)), height: row - 8, rx: 3, class: "open" }, svg("title", {}, "fed")),
        ...(p.closed >= 0 ? [svg("rect", { x: at(open), y, width: Math.max(3, at(stop) - at(open)), height: row - 8, rx: 3, class: "closed" }, svg("title", {}, "closed off"))] : []),
      ];
    }));
}

/** A value a shot, over the number of the shot. */
function shotLines(page: Page, names: [string, string][]): Line[] {
  return page.runs.flatMap((r, run) => names.flatMap(([name, label], i) => {
    const t = r.table("shots"), x = t?.numbers("shot"), y = t?.numbers(name);
    const shown = page.runs.length > 1 ? `${label} · ${r.meta.name}` : label;
    return x && y ? [{ label: shown, x, y: Array.from(y, (v) => (name === "time_to_solidify" && v < 0 ? NaN : v)), colour: i, dashed: run > 0 }] : [];
  }));
}

function shotCharts(page: Page): Node {
  const make = (title: string, unit: string, names: [string, string][]) => {
    const lines = shotLines(page, names).filter((l) => Array.from(l.y).some((v) => Number.isFinite(v)));
    return lines.length ? chart({ title, unit, lines, xLabel: "Shot", xUnit: "" }) : null;
  };
  return h("div", { class: "cards" },
    make("From the pour to the last melt", "s", [["time_to_solidify", "time to solidify"]]),
    make("The die when a shot begins", "°C", [["die_at_start_max", "hottest place"], ["die_at_start_mean", "mean"], ["die_at_start_min", "coldest place"]]));
}

function shots(run: Run, bench: Workbench): Node_[] {
  const t = run.table("shots"), n = t?.numbers("shot"), end = t?.numbers("time"), poured = t?.numbers("poured_at");
  if (!t || !n || !end || !poured) return [h("p", { class: "hint" }, "This run has no shots.")];
  const cell = (name: string, i: number, unit: string) => {
    const v = t.numbers(name)?.[i];
    return v === undefined ? "–" : `${short(v)} ${unit}`;
  };
  const rows = Array.from({ length: t.rows }, (_, i) => {
    const solid = t.numbers("time_to_solidify")?.[i] ?? -1;
    const go = bench.ready ? h("button", { class: "link", title: "Show its end in the picture", click: () => {
      bench.goTo(end[i]);
      byId("view").scrollIntoView({ behavior: "smooth" });
    } }, duration(end[i])) : duration(end[i]);
    return [`${n[i]}`, duration(poured[i]), go, solid < 0 ? "left with melt" : duration(solid), cell("die_at_start_mean", i, "°C"), cell("die_at_end_mean", i, "°C"), cell("largest_change", i, "K"),
      t.numbers("periodic")?.[i] ? "periodic" : ""];
  });
  return [h("div", { style: "height:12px" }), table(["Shot", "Poured at", "Ends at", "Solid after", "Die at its start, mean", "Die at its end, mean", "Largest change of a place", ""], rows)];
}

function stepCharts(page: Page): Node {
  const headers = headersOf(page, "steps");
  const pick = (names: string[]) => headers.filter((x) => names.includes(split(x).name)).filter((x) => page.runs.some((r) => {
    const c = r.table("steps")?.numbers(x);
    return c && !constantZero(c);
  }));
  const make = (title: string, unit: string, names: string[], logarithmic: boolean) => {
    const chosen = pick(names);
    return chosen.length ? chart({ title, unit, lines: chosen.flatMap((x, i) => linesOf(page, "steps", x, i)), time: true, logarithmic, steps: !logarithmic && unit === "" }) : null;
  };
  return h("div", { class: "cards" }, make("Step", "s", ["dt"], true), make("Iterations per step", "", ["heat_iterations", "mechanics_iterations", "coupling_iterations"], false), make("Computing time per step", "s", ["heat_seconds", "mechanics_seconds"], false));
}

function stepTables(run: Run): Node_[] {
  const t = run.table("steps");
  const reason = t?.texts("reason"), time = t?.numbers("time"), dt = t?.numbers("dt"), rejected = t?.numbers("rejected"), shortened = t?.numbers("shortened"), rejection = t?.texts("rejection");
  if (!t || !time || !dt || !reason) return [h("p", { class: "hint" }, "This run has no table of steps.")];
  const counts = new Map<string, number>();
  for (const r of reason) counts.set(r, (counts.get(r) ?? 0) + 1);
  const numbers: [string, string][] = [["heat_iterations", "Heat, it."], ["mechanics_iterations", "Mechanics, it."], ["temperature_error", "Error of T [K]"], ["T_min", "T min [°C]"], ["T_max", "T max [°C]"], ["solid_fraction", "Solid"]];
  const columns = numbers.flatMap(([name, text]) => {
    const column = t.numbers(name);
    return column ? [{ text, column }] : [];
  });
  const order = Array.from({ length: t.rows }, (_, i) => i);
  const most = 400, shown = order.length > most ? [...order.slice(0, most / 2), ...order.slice(-most / 2)] : order;
  const tries = (i: number) => {
    const text = triesText(rejected?.[i], shortened?.[i]);
    return text && `${text}: ${rejection?.[i] ?? ""}`;
  };
  const rows = shown.map((i) => [short(time[i]), short(dt[i]), reason[i], tries(i), ...columns.map((c) => short(c.column[i]))]);
  return [
    h("div", { class: "card", style: "margin-top:14px" }, h("h3", {}, "What limited the step size"), bars([...counts.entries()].sort((a, b) => b[1] - a[1]).slice(0, 12).map(([text, n]) => [text, n, `${n}`]))),
    h("details", { class: "more" }, h("summary", {}, shown.length < order.length ? `Steps (the first and the last ${most / 2} of ${order.length})` : `All ${order.length} steps`),
      table(["Time [s]", "Step [s]", "Reason", "Repeated attempts", ...columns.map((c) => c.text)], rows)),
  ];
}

function bars(entries: [string, number, string][]): Node {
  const most = Math.max(...entries.map((e) => e[1]), 1e-30);
  return h("div", { class: "bars" }, ...entries.flatMap(([text, n, value]) => [h("span", {}, text), h("i", { style: `width:${(100 * n) / most}%` }), h("output", {}, value)]));
}

function understood(run: Run): Node_[] {
  const bodies = run.summary.understood?.bodies ?? [], poured = run.summary.understood?.poured ?? [], skins = run.summary.understood?.skins ?? [];
  const number = (o: Record<string, unknown>, key: string, scale = 1, unit = "") => (typeof o[key] === "number" ? `${short((o[key] as number) * scale)}${unit && ` ${unit}`}` : "–");
  const size = (o: Record<string, unknown>) => {
    const low = o["low[m]"], high = o["high[m]"];
    return Array.isArray(low) && Array.isArray(high) ? (high as number[]).map((v, i) => v - (low as number[])[i]).slice(0, run.dimension).map((v) => short(v * 1e3)).join(" × ") + " mm" : "–";
  };
  return [
    table(["Body", "Material", "Size", "Mass", "Volume", "Surface", "Elements' edges"], bodies.map((o) => [
      String(o.name ?? ""), String(o.material ?? ""), size(o), number(o, "mass[kg]", 1, "kg"), number(o, "volume[m3]", 1e6, "cm³"), number(o, "skin[m2]", 1e4, "cm²"),
      `${number(o, "shortest_edge[m]", 1e3)} … ${number(o, "longest_edge[m]", 1e3)} mm`])),
    poured.length ? h("h3", { style: "margin-top:18px" }, "Poured bodies, as estimated before the run") : null,
    poured.length ? table(["Body", "Poured at", "Liquidus", "Solidus", "Modulus V/A", "Expected solid after", "Governed by"], poured.map((o) => {
      const celsius = (key: string) => (typeof o[key] === "number" ? `${short((o[key] as number) - 273.15)} °C` : "–");
      return [String(o.body ?? ""), celsius("pouring[K]"), celsius("liquidus[K]"), celsius("solidus[K]"), number(o, "modulus[m]", 1e3, "mm"), typeof o["freezing_time[s]"] === "number" ? duration(o["freezing_time[s]"] as number) : "–", String(o.governed_by ?? "–")];
    })) : null,
    skins.length ? h("h3", { style: "margin-top:18px" }, "Surfaces and what they touch") : null,
    skins.length ? table(["Name", "Surface", "Faces", "Area", "Paired"], skins.map((o) => [String(o.name ?? ""), String(o.surface ?? ""), String(o.faces ?? ""), number(o, "area[m2]", 1e4, "cm²"), number(o, "paired[m2]", 1e4, "cm²")])) : null,
  ];
}

function materials(run: Run): Node_[] {
  const cards = run.meta.materials.map(({ body, material, card, missing }) => {
    const head = h("h3", {}, material, h("small", {}, ` · ${body}`));
    if (!card) return h("div", { class: "card" }, head, h("p", { class: "hint" }, `The card cannot be read: ${missing ?? "it is not there"}`));
    const properties = card.properties.map((p) => {
      const unit = p.unit === "Pa" ? { text: "MPa", scale: 1e-6 } : { text: unitText(p.unit), scale: 1 };
      const values = p.values.map((v) => v * unit.scale);
      const low = Math.min(...values), high = Math.max(...values);
      return [p.name.replace(/_/g, " "), values.length > 1 ? spark(p["temperature[K]"], values) : "", (low === high ? short(low) : `${short(low)} … ${short(high)}`) + (unit.text ? ` ${unit.text}` : "")];
    });
    const changes = card.phase_changes.map((c) => {
      const celsius = (key: string) => `${short(Number(c[key]) - 273.15)} °C`;
      return h("p", { class: "hint" }, `${c.name}: ${celsius("solidus[K]")} to ${celsius("liquidus[K]")}, latent heat ${short(Number(c["latent_heat[J/kg]"]) / 1e3)} kJ/kg, volume change ${short(Number(c["volume_change[1]"]) * 100)} %`);
    });
    const sources = card.sources.map((s) => {
      const valid = s["valid_to[K]"] !== undefined ? `${short(s["valid_from[K]"]! - 273.15)} to ${short(s["valid_to[K]"] - 273.15)} °C` : "";
      return [s.property.replace(/_/g, " "), s.source || "no source given", valid];
    });
    return h("div", { class: "card" }, head, h("p", { class: "hint" }, card.title), table(["Property", "", "Value"], [["density", "", `${short(card["density[kg/m3]"])} kg/m³`], ...properties]), ...changes,
      sources.length ? h("details", { class: "more" }, h("summary", {}, `Sources (${sources.length})`), table(["Property", "Source", "Valid"], sources)) : h("p", { class: "hint" }, "The card gives no sources."));
  });
  return [h("p", { class: "hint" }, "As the library has them at the time of the report; small curves are over temperature."), h("div", { class: "cards" }, ...cards)];
}

function spark(x: number[], y: number[]): Node {
  const [x0, x1] = [Math.min(...x), Math.max(...x)], [y0, y1] = [Math.min(...y), Math.max(...y)];
  const points = x.map((v, i) => `${(2 + (86 * (v - x0)) / (x1 - x0 || 1)).toFixed(1)},${(19 - (16 * (y[i] - y0)) / (y1 - y0 || 1)).toFixed(1)}`).join(" ");
  return svg("svg", { width: 90, height: 22, role: "img", "aria-label": `from ${short(x0 - 273.15)} to ${short(x1 - 273.15)} °C` },
    svg("polyline", { points, fill: "none", stroke: "var(--accent)", "stroke-width": 1.6 }), svg("title", {}, `${short(x0 - 273.15)} … ${short(x1 - 273.15)} °C`));
}

function caseText(run: Run): Node_[] {
  const pre = h("pre", { class: "case", tabindex: 0 });
  for (const line of run.meta.case_text.split("\n")) {
    if (/^\s*#/.test(line)) pre.append(h("span", { class: "c" }, line));
    else if (/^\s*\[/.test(line)) pre.append(h("span", { class: "s" }, line));
    else {
      const match = /^(\s*[A-Za-z0-9_]+\s*=)(.*)$/.exec(line);
      if (match) pre.append(h("span", { class: "k" }, match[1]), match[2]);
      else pre.append(line);
    }
    pre.append("\n");
  }
  return [
    h("p", { class: "hint" }, "As it was read, every default filled in; it runs again as it is. ",
      h("button", { class: "link", click: () => save("case.toml", run.meta.case_text) }, "Save case.toml")),
    pre,
  ];
}

function cost(run: Run): Node_[] {
  const profile = run.summary["profile[s]"];
  if (!profile) return [h("p", { class: "hint" }, "This run has no summary.")];
  const entries = Object.entries(profile).filter(([name]) => name !== "total").sort((a, b) => b[1] - a[1]);
  const shown = entries.slice(0, 12);
  const memory = run.summary["peak_memory[bytes]"]?.all_processes;
  const facts = [`${duration(profile.total)} in all`, run.summary.processes ? `${run.summary.processes} process${run.summary.processes > 1 ? "es" : ""}` : "", memory ? `${short(memory / 1e6)} MB at most` : ""].filter(Boolean).join(" · ");
  return [h("div", { class: "card" }, h("p", { class: "hint", style: "margin:0 0 10px" }, facts), bars(shown.map(([name, s]) => [name, s, duration(s)])))];
}

