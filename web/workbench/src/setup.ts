/** The steps before a run: the part, how it is cast, what is placed on it, and what `check` finds. */
import { byId, h } from "../../report/src/dom";
import { conditionList, metres } from "./conditions";
import { bodiesOf, roleByName } from "./stage";
import type { Chill, Choices, Desk, Finding, Gating, Place, Preview, Probe, Riser, State } from "./state";
import { get } from "./state";
import type { SkinBody } from "./skin";

type Children = (Node | string | null | false)[];
type Row = (title: string, close: HTMLElement, ...rows: [string, HTMLElement[]][]) => HTMLElement;
type Point = (id: string, name: string, at: Place, change: (at: Place) => void) => HTMLElement[];
const mm = (v: number) => String(Math.round(v * 1e5) / 100);

/** A label with a field below it. */
export function field(label: string, input: HTMLElement, hint = ""): HTMLElement {
  return h("label", { class: "field" }, h("span", {}, label), input, hint ? h("small", {}, hint) : null);
}
export function select(id: string, options: [string, string][], value: string, change: (value: string) => void, disabled = false): HTMLSelectElement {
  const element = h("select", { id, disabled }, ...options.map(([v, text]) => h("option", { value: v, selected: v === value }, text)));
  element.addEventListener("change", () => change(element.value));
  return element;
}
function number(id: string, label: string, value: number, change: (value: number) => void, disabled: boolean): HTMLInputElement {
  const element = h("input", { id, type: "number", step: "any", value: mm(value), "aria-label": label, disabled });
  element.addEventListener("change", () => element.value !== "" && Number.isFinite(+element.value) && change(+element.value / 1e3));
  return element;
}

/** The risers that stand in the case file, as far as their lengths can be read. */
function risersOf(state: State): Riser[] {
  const found = ((state.case?.document?.mesh as { riser?: Record<string, unknown>[] } | undefined)?.riser ?? []).map((r) => ({
    name: String(r.name), foot: ((r.foot ?? []) as unknown[]).map(metres) as Place, diameter: metres(r.diameter), height: metres(r.height),
    ...Object.fromEntries(["neck_diameter", "neck_height", "sleeve"].filter((key) => key in r).map((key) => [key, metres(r[key])])),
    ...(Array.isArray(r.neck_to) ? { neck_to: r.neck_to.map(metres) as Place } : {}),
  }));
  return found.filter((r) => [...r.foot, ...(r.neck_to ?? []), ...Object.values(r).filter((v) => typeof v === "number")].every((v) => Number.isFinite(v)));
}

/** A preview in words. */
function ahead(p: Preview): string {
  const side = (v: number) => String(+(1e3 * v).toPrecision(3)), box = [0, 1, 2].map((i) => side(p.high[i] - p.low[i])).join(" x "), w = (p.walls ?? []).map(side);
  const mould = p.walls === null ? "The file holds the mould." : p.shell ? `A shell of ${side(p.shell)} mm.`
    : `A mould of ${box} mm, its walls ${w.every((v) => v === w[0]) ? `${w[0]} mm` : `${w.join(", ")} mm (lowest and highest x, y, z; 0: open, or the plane of symmetry)`}.`;
  return `${mould} Elements of ${side(p.size)} mm in the metal, ${side(p.smallest)} mm in its thin walls${p.walls === null ? "" : ` and ${side(p.mould_size)} mm in the mould`}.`;
}

export class Setup {
  constructor(private readonly desk: Desk, private readonly partBodies: () => SkinBody[], private readonly riserOnTop: () => void, private readonly gatingAside: () => void) {}

  /** 1: which part, and what its bodies are. */
  part(state: State): Children {
    const choices = state.choices, bodies = this.partBodies(), busy = !!state.job;
    const roles = ["", ...this.desk.about.roles].map((r): [string, string] => [r, r || "by its name"]);
    return [
      h("p", {}, state.name ? h("b", {}, state.part ?? `${state.name} (the part is not next to it)`) : "Nothing is open.", state.name ? h("small", {}, ` in ${state.folder}`) : null),
      h("div", { class: "buttons" },
        h("button", { id: "load", disabled: busy, click: () => byId("file").click() }, "Load a file …"),
        h("button", { id: "choose-file", disabled: busy, click: () => void this.chooseFile() }, "Open one of this folder …")),
      choices && bodies.length > 1 ? h("table", { class: "plain" }, h("caption", {}, "What the bodies of the file are"), ...bodies.map((body, b) =>
        h("tr", {}, h("th", { scope: "row" }, body.name), h("td", {}, select(`role-${b}`, roles.map(([v, t]) => [v, v ? t : `${roleByName(body.name)} (by its name)`]), choices.roles[body.name] ?? "",
          (role) => void this.desk.choose({ roles: { ...choices.roles, [body.name]: role } }), busy))))) : null,
      choices && /\.(stl|brep|msh|inp|unv|med|bdf|nas|vtu|vtk|mesh)$/i.test(state.part ?? "") ? field("Unit of its lengths", select("unit", [["", "mm"], ["m", "m"], ["cm", "cm"], ["in", "in"]], choices.unit,
        (unit) => void this.desk.choose({ unit }).then((ok) => ok && this.desk.ask("open", { name: state.part })), busy)) : null,
    ];
  }

  private async chooseFile(): Promise<void> {
    const { parts, cases } = await get<{ parts: string[]; cases: string[] }>("files");
    const dialog = byId<HTMLDialogElement>("dialog");
    const entry = (name: string) => h("li", {}, h("button", { class: "link", click: () => { dialog.close(); void this.desk.ask("open", { name }); } }, name));
    dialog.replaceChildren(
      h("h3", {}, "Parts"), h("ul", {}, ...(parts.length ? parts.map(entry) : [h("li", {}, "none")])),
      h("h3", {}, "Cases"), h("ul", {}, ...(cases.length ? cases.map(entry) : [h("li", {}, "none")])), h("form", { method: "dialog" }, h("button", {}, "Close")));
    dialog.showModal();
  }

  /** 2: how it is cast. */
  casting(state: State): Children {
    const c = state.choices, { about } = this.desk, busy = !!state.job;
    if (!c || !state.part) return [h("p", { class: "hint" }, state.name ? "This case stands for itself: the part of which it was made is not next to it." : "Open a part first.")];
    const alloys = about.materials.filter((m) => m.alloy).map((m): [string, string] => [m.name, m.title]);
    const fine: [string, string][] = [["0.7", "coarse, quick"], ["1", "as usual"], ["1.4", "fine"], ["2", "very fine, slow"]];
    if (!fine.some(([v]) => +v === c.fineness)) fine.push([String(c.fineness), `${c.fineness} times`]);
    return [
      field("Alloy", select("alloy", [["", "choose …"], ...alloys], c.alloy, (alloy) => void this.desk.choose({ alloy }), busy)),
      c.alloy ? h("button", { class: "link", id: "sources", click: () => void this.sources(c.alloy) }, "Properties and their sources") : null,
      field("Process", select("process", Object.entries(about.processes), c.process, (process) => void this.desk.choose({ process }), busy)),
      field("Risers", select("risers", Object.entries(about.risers), c.riser, (riser) => void this.desk.choose({ riser: riser as Choices["riser"] }), busy),
        c.riser === "placed" && !c.risers.length ? "Click the part where one shall stand." : ""),
      c.riser === "placed" ? h("button", { class: "link", id: "riser-on-top", disabled: busy, click: this.riserOnTop }, "One more riser, on the highest place") : null,
      c.riser === "auto" && state.made && risersOf(state).length ? h("button", { class: "link", id: "take-risers", disabled: busy, click: () => void this.desk.choose({ riser: "placed", risers: risersOf(state) }) },
        "Change the risers that the rule has chosen") : null,
      h("button", { class: "link", id: "gating-aside", disabled: busy, click: this.gatingAside }, "Gating, at the side of largest x"),
      h("div", { class: "two" },
        field("Symmetry", select("symmetry", [["", "none"], ["x", "half, below the middle in x"], ["y", "half, below the middle in y"], ["z", "half, below the middle in z"]], c.symmetry, (symmetry) => void this.desk.choose({ symmetry }), busy)),
        field("Elements", select("fineness", fine, String(c.fineness), (v) => void this.desk.choose({ fineness: +v }), busy))),
      ...this.placed(c, busy),
      state.thickest.length ? h("details", { open: true }, h("summary", {}, "Hot spots: the thickest places of the part"),
        h("ul", { class: "findings", id: "thickest" }, ...state.thickest.map((f, n) => this.finding(f, `thick-${n}`)))) : null,
      state.preview ? h("p", { class: "hint", id: "ahead" }, ahead(state.preview)) : null,
      h("button", { id: "preview", disabled: busy || !c.alloy, click: () => void this.desk.ask("preview") }, "Show mould and elements"), " ",
      h("button", { class: `main${state.made === true ? "" : " on"}`, id: "make", disabled: busy || !c.alloy, click: () => void this.desk.ask("make") }, state.case ? "Make the case again" : "Make the case"),
      state.case && state.made === false ? h("p", { class: "hint" }, "Something was chosen since the case was made. Making it again replaces the case file; Undo brings the old one back.") : null,
      state.case && state.made !== false ? h("p", { class: "hint" }, `Written to ${state.case.file}; what is changed there by hand is shown here.`) : null,
    ];
  }

  private async sources(name: string): Promise<void> {
    const dialog = byId<HTMLDialogElement>("dialog");
    const { text } = await get<{ text: string }>(`material?name=${encodeURIComponent(name)}`);
    dialog.replaceChildren(h("h3", {}, name), h("pre", { class: "case", tabindex: 0 }, text), h("form", { method: "dialog" }, h("button", {}, "Close")));
    dialog.showModal();
  }

  /** Lists of what was placed, with places and sizes that can be typed. */
  private placed(c: Choices, busy: boolean): Children {
    const point = (id: string, name: string, at: Place, change: (at: Place) => void) =>
      at.map((v, i) => number(`${id}-${"xyz"[i]}`, `${name}: ${"xyz"[i]} in mm`, v, (value) => change(at.map((old, k) => (k === i ? value : old)) as Place), busy));
    const gone = (id: string, name: string, act: () => void) => h("button", { class: "quiet", id, title: `Take ${name} away`, "aria-label": `Take ${name} away`, disabled: busy, click: act }, "✕");
    const risers = (list: Riser[]) => void this.desk.choose({ risers: list }), chills = (list: Chill[]) => void this.desk.choose({ chills: list }), probes = (list: Probe[]) => void this.desk.choose({ probes: list });
    const out: Children = [];
    const row = (title: string, close: HTMLElement, ...rows: [string, HTMLElement[]][]) =>
      h("fieldset", { class: "placed" }, h("legend", {}, title, close), ...rows.map(([label, inputs]) => h("div", { class: "row" }, h("small", {}, label), ...inputs)));
    if (c.riser === "placed") {
      c.risers.forEach((r, n) => {
        const put = (change: Partial<Riser>) => risers(c.risers.map((old, k) => (k === n ? { ...old, ...change } : old)));
        out.push(row(r.name, gone(`riser-${n}-gone`, r.name, () => risers(c.risers.filter((_, k) => k !== n))),
          ["foot [mm]", point(`riser-${n}`, r.name, r.foot, (foot) => put({ foot }))],
          [r.neck_to ? "wide, high, neck [mm]" : "wide, high, sleeve [mm]", [
            number(`riser-${n}-diameter`, `${r.name}: diameter in mm`, r.diameter, (diameter) => put({ diameter }), busy),
            number(`riser-${n}-height`, `${r.name}: height in mm`, r.height, (height) => put({ height }), busy),
            r.neck_to ? number(`riser-${n}-neck`, `${r.name}: diameter of its neck in mm`, r.neck_diameter ?? 0, (neck_diameter) => put({ neck_diameter }), busy)
              : number(`riser-${n}-sleeve`, `${r.name}: thickness of its sleeve in mm`, r.sleeve ?? 0, (sleeve) => put({ sleeve }), busy)]],
          ...(r.neck_to ? [["neck leads to [mm]", point(`riser-${n}-to`, `${r.name}, where its neck leads to`, r.neck_to, (neck_to) => put({ neck_to }))] as [string, HTMLElement[]]] : [])));
      });
      c.chills.forEach((k, n) => {
        const put = (change: Partial<Chill>) => chills(c.chills.map((old, i) => (i === n ? { ...old, ...change } : old)));
        out.push(row(k.name, gone(`chill-${n}-gone`, k.name, () => chills(c.chills.filter((_, i) => i !== n))),
          ["lowest [mm]", point(`chill-${n}-low`, k.name, k.lowest, (lowest) => put({ lowest }))], ["highest [mm]", point(`chill-${n}-high`, k.name, k.highest, (highest) => put({ highest }))]));
      });
    }
    c.gatings.forEach((g, n) => out.push(this.gatingRow(c, g, n, busy, row, point, gone)));
    c.probes.forEach((p, n) => out.push(row(`${p.name}, a probe`, gone(`probe-${n}-gone`, p.name, () => probes(c.probes.filter((_, k) => k !== n))),
      ["place [mm]", point(`probe-${n}`, p.name, p.point, (at) => probes(c.probes.map((old, k) => (k === n ? { ...old, point: at } : old))))])));
    if (c.gate && !c.gatings.some((g) => c.gate!.every((v, i) => Math.abs(v - g.sprue[i]) < 1e-9))) out.push(row("Gate, through which runs fill the mould first", gone("gate-gone", "the gate", () => void this.desk.choose({ gate: null })), ["place [mm]", point("gate", "gate", c.gate, (gate) => void this.desk.choose({ gate }))]));
    return out;
  }

  /** The fields of a sprue with its runner and ingate, and whether the mould is filled through it. */
  private gatingRow(c: Choices, g: Gating, n: number, busy: boolean, row: Row, point: Point, gone: (id: string, name: string, act: () => void) => HTMLElement): HTMLElement {
    const is = (at: Place | null) => at !== null && at.every((v, i) => Math.abs(v - g.sprue[i]) < 1e-9), filled = is(c.gate);
    // A gate at the top of the sprue goes where the sprue goes.
    const put = (change: Partial<Gating>) => {
      const next = { ...g, ...change };
      void this.desk.choose({ gatings: c.gatings.map((old, k) => (k === n ? next : old)), ...(filled ? { gate: next.sprue } : {}) });
    };
    const size = (key: "gate_width" | "gate_height" | "gate_length" | "runner_width" | "runner_height" | "foot_diameter" | "top_diameter", name: string) =>
      number(`gating-${n}-${key}`, `${g.name}: ${name} in mm`, g[key], (value) => put({ [key]: value }), busy);
    const area = (Math.PI / 4) * g.foot_diameter ** 2, ratio = (a: number) => (a / area).toFixed(1);
    const through = h("input", { type: "checkbox", id: `gating-${n}-fill`, checked: filled, disabled: busy });
    through.addEventListener("change", () => void this.desk.choose({ gate: through.checked ? g.sprue : null }));
    return row(`${g.name}, 1 : ${ratio(g.runner_width * g.runner_height)} : ${ratio(g.gate_width * g.gate_height)}`,
      gone(`gating-${n}-gone`, g.name, () => void this.desk.choose({ gatings: c.gatings.filter((_, k) => k !== n), ...(filled ? { gate: null } : {}) })),
      ["ingate ends at [mm]", point(`gating-${n}-gate`, `${g.name}, end of the ingate`, g.gate, (gate) => put({ gate }))],
      ["ingate wide, high, long [mm]", [size("gate_width", "width of the ingate"), size("gate_height", "height of the ingate"), size("gate_length", "length of the ingate")]],
      ["runner wide, high [mm]", [size("runner_width", "width of the runner"), size("runner_height", "height of the runner")]],
      ["top of the sprue [mm]", point(`gating-${n}-sprue`, `${g.name}, top of the sprue`, g.sprue, (sprue) => put({ sprue }))],
      ["sprue wide at foot, top [mm]", [size("foot_diameter", "diameter of the sprue at its foot"), size("top_diameter", "diameter of the sprue at its top")]],
      ["filling", [h("label", {}, through, " fill the mould through it first")]]);
  }

  /** 3: bodies of the case with their materials, and what check finds. */
  check(state: State): Children {
    if (!state.case) return [h("p", { class: "hint" }, "There is no case yet.")];
    const busy = !!state.job, check = state.check, all = this.desk.about.materials.map((m): [string, string] => [m.name, m.title]);
    const bodies = bodiesOf(state);
    const findings = check?.findings ?? [];
    return [
      state.case.error ? h("div", { class: "notice bad" }, state.case.error) : null,
      bodies.length ? h("table", { class: "plain" }, h("caption", {}, "Bodies"), ...bodies.map((body) => {
        const options = all.some(([name]) => name === body.material) ? all : [[body.material, body.material] as [string, string], ...all];
        return h("tr", {}, h("th", { scope: "row" }, h("i", { class: `role ${body.role || "other"}` }), body.name), h("td", {}, select(`material-${body.index}`, options, body.material,
          (material) => void this.desk.ask("set", { path: ["body", body.index, "material"], value: material }), busy)));
      })) : null,
      conditionList(this.desk, state),
      h("div", { class: "buttons" },
        h("button", { id: "check", disabled: busy, class: check?.current ? "" : "on", click: () => void this.desk.ask("check") }, "Check"),
        h("button", { id: "to-keys", click: () => this.desk.openTab("keys") }, "All keys …"), h("button", { id: "to-text", click: () => this.desk.openTab("text") }, "The file …")),
      check && !check.current ? h("p", { class: "hint" }, "The case has changed since it was checked.") : null,
      check ? h("p", { class: check.error ? "bad" : "good", id: "verdict" }, check.error ? "The case is refused." : findings.length ? `The case can run; ${findings.length} to look at.` : "The case is in order.") : null,
      findings.length ? h("ul", { class: "findings", id: "findings" }, ...findings.map((f, n) => this.finding(f, `finding-${n}`))) : null,
      check?.text ? h("details", {}, h("summary", {}, "What the program understands the case to be"), h("pre", { class: "case", tabindex: 0 }, check.text)) : null,
    ];
  }

  finding(f: Finding, id: string): HTMLElement {
    const where = [f.bodies.join(", "), f.line ? `line ${f.line}` : ""].filter(Boolean).join(" · ");
    return h("li", {}, h("button", { class: `finding ${f.severity}`, id, title: "Show where", click: () => this.desk.show(f) },
      h("b", {}, f.severity), ` ${f.message}`, where ? h("small", {}, ` ${where}`) : null));
  }
}
