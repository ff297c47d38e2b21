/** Conditions on faces: what can be put where one clicks, and those that a case has. All of them are sections of its file. */
import { h } from "../../report/src/dom";
import { freeName } from "./placing";
import type { Pick } from "./scene";
import type { Desk, Document, Key, Place, State } from "./state";

type Section = "thermal_condition" | "mechanical_condition";
type Values = Record<string, unknown>;
interface Kind {
  id: string;
  /** Its button, and the name of a new one. */
  text: string;
  stem: string;
  section: Section;
  /** Its keys with what they start with; none where it cannot be put there. */
  values: (hit: Pick) => Values | undefined;
  refused?: string;
}

const axisOf = (hit: Pick) => [0, 1, 2].find((i) => Math.abs(hit.normal[i]) > 0.9998);
export const KINDS: Kind[] = [
  { id: "film", text: "Film", stem: "film", section: "thermal_condition", values: () => ({ kind: "film", coefficient: "100 W/m2/K", ambient: "20 degC" }) },
  { id: "radiation", text: "Radiation", stem: "radiation", section: "thermal_condition", values: () => ({ kind: "radiation", emissivity: 0.8, ambient: "20 degC" }) },
  { id: "temperature", text: "Temperature", stem: "temperature", section: "thermal_condition", values: () => ({ kind: "temperature", temperature: "20 degC" }) },
  { id: "flux", text: "Heat flux", stem: "flux", section: "thermal_condition", values: () => ({ kind: "flux", flux: "-10000 W/m2" }) },
  { id: "held", text: "Held", stem: "support", section: "mechanical_condition", values: () => ({ kind: "displacement", ux: "0 mm", uy: "0 mm", uz: "0 mm" }) },
  {
    id: "guided", text: "Held along its normal", stem: "guide", section: "mechanical_condition", refused: "click a flat face that is normal to an axis",
    values: (hit) => (axisOf(hit) === undefined ? undefined : { kind: "displacement", [`u${"xyz"[axisOf(hit)!]}`]: "0 mm" }),
  },
  { id: "pressure", text: "Pressure", stem: "pressure", section: "mechanical_condition", values: () => ({ kind: "pressure", pressure: "1 MPa" }) },
];
/** Keys whose values stand next to a condition, as far as it has them. */
const SHOWN = ["temperature", "flux", "coefficient", "emissivity", "ambient", "ux", "uy", "uz", "pressure"];
const KIND_WORDS: Record<string, string> = { displacement: "support", flux: "heat flux" };

interface Condition { section: Section; index: number; name: string; group: string; kind: string; values: Values; at: Place | null; owner: string }
const LENGTH = /^\s*([-+\d.e]+)\s*(mm|cm|m)\s*$/i;
/** A length of a case file [m]; NaN where its unit is another one. */
export function metres(text: unknown): number {
  const match = LENGTH.exec(String(text));
  return match ? +match[1] * { mm: 1e-3, cm: 1e-2, m: 1 }[match[2].toLowerCase() as "mm" | "cm" | "m"] : NaN;
}
const entries = (document: Document | null | undefined, name: string): Values[] => (Array.isArray(document?.[name]) ? (document[name] as Values[]) : []);
const groupsOf = (document: Document | null | undefined): Values[] => entries(document?.mesh as Document | undefined, "group");
const placeOf = (value: unknown): Place | null => {
  const at = Array.isArray(value) && value.length === 3 ? value.map(metres) : [NaN];
  return at.every(Number.isFinite) ? (at as Place) : null;
};

/** The conditions of a case in the order of its file. */
function conditionsOf(document: Document | null | undefined): Condition[] {
  return (["thermal_condition", "mechanical_condition"] as const).flatMap((section) => entries(document, section).map((values, index) => {
    const group = groupsOf(document).find((g) => g.name === values.group);
    return { section, index, name: String(values.name), group: String(values.group), kind: String(values.kind), values, at: placeOf(group?.nearest), owner: bodyOf(document, String(group?.owner ?? "")) };
  }));
}
/** The name in the case of the body of a group. */
function bodyOf(document: Document | null | undefined, group: string): string {
  return String(entries(document, "body").find((b) => b.group === group)?.name ?? group);
}
/** The group of a body that the picture calls by its name in the case. */
function groupOf(document: Document | null | undefined, body: string): string {
  return String(entries(document, "body").find((b) => b.name === body)?.group ?? body);
}

/** What is placed in a case: its conditions on faces that were chosen by a place, and its probes. */
export function placedInCase(state: State): { at: Place; label: string }[] {
  const document = state.case?.document;
  const found = [...conditionsOf(document).map(({ at, name }) => ({ at, label: name })), ...entries(document, "probe").map((p) => ({ at: placeOf(p.point), label: String(p.name) }))];
  return found.filter((mark): mark is { at: Place; label: string } => mark.at !== null);
}

/** Why a condition cannot be put on a face now; empty: it can. */
export function refusal(kind: Kind, hit: Pick, state: State): string {
  const physics = (state.case?.document?.analysis as Document | undefined)?.physics;
  if (state.job) return "wait for what is computed";
  if (!state.case?.document) return "there is no case that can be read";
  if (kind.section === "mechanical_condition" && physics === "heat") return "this case computes heat alone";
  return kind.values(hit) ? "" : (kind.refused ?? "");
}

/** Puts a condition on the smooth face that is nearest to a place of a body: a group by rule, and the condition, whose first value can then be typed. */
export async function addCondition(desk: Desk, kind: Kind, body: string, hit: Pick): Promise<void> {
  const { document } = desk.state.case ?? {}, taken = [...groupsOf(document), ...entries(document, "thermal_condition"), ...entries(document, "mechanical_condition"), ...entries(document, "body")] as { name: string }[];
  const name = freeName(kind.stem, taken), nearest = hit.place.map((v) => `${Math.round(v * 1e7) / 1e4} mm`);
  const made = await desk.ask("add", { sections: [
    { path: ["mesh", "group"], values: { name, owner: groupOf(document, body), nearest } },
    { path: [kind.section], values: { name, group: name, ...kind.values(hit) } }] });
  if (made) focusOn(`condition-${name}`);
}
function focusOn(id: string): void {
  const field = globalThis.document.querySelector<HTMLInputElement>(`#${id} input`);
  field?.scrollIntoView({ block: "center" });
  field?.select();
}

/** The list of a case's conditions with their values, for the panel of step 3. */
export function conditionList(desk: Desk, state: State): HTMLElement | null {
  const document = state.case?.document, all = conditionsOf(document), busy = !!state.job;
  if (!all.length) return null;
  return h("details", { id: "conditions", open: all.length <= 12 }, h("summary", {}, `Conditions on faces: ${all.length}`), ...all.map((c) => one(desk, document!, c, busy)));
}
function one(desk: Desk, document: Document, c: Condition, busy: boolean): HTMLElement {
  const where = c.at ? { places: [c.at], bodies: [] } : { places: [], bodies: entries(document, "body").map((b) => String(b.name)).filter((name) => c.group.startsWith(`${name}_`)) };
  const show = () => desk.show({ severity: "note", message: c.name, ...where });
  const fields = SHOWN.filter((key) => typeof c.values[key] === "string" || typeof c.values[key] === "number").map((key) => {
    const was = c.values[key], input = h("input", { type: "text", value: String(was), disabled: busy, "aria-label": `${c.name}: ${key}`, spellcheck: "false" });
    const value = () => (typeof was === "number" && Number.isFinite(+input.value) ? +input.value : input.value);
    input.addEventListener("change", () => input.value.trim() && void desk.ask("set", { path: [c.section, c.index, key], value: value() }));
    return h("label", { class: "row" }, h("small", {}, key), input);
  });
  return h("fieldset", { class: "placed", id: `condition-${c.name}` },
    h("legend", {}, h("button", { class: "link", title: "Show where", click: show }, c.name), ` ${KIND_WORDS[c.kind] ?? c.kind} on ${c.at ? c.owner : c.group}`,
      h("button", { class: "quiet", title: "All its keys", "aria-label": `All keys of ${c.name}`, click: () => desk.openKeys(`${c.section}.${c.index + 1}`) }, "…"),
      h("button", { class: "quiet", title: `Take ${c.name} away`, "aria-label": `Take ${c.name} away`, disabled: busy, click: () => void desk.ask("remove", { paths: without(document, c) }) }, "✕")),
    ...fields);
}

/** What goes with a condition: itself, and its group where nothing else names that. */
function without(document: Document, c: Condition): Key[][] {
  const group = groupsOf(document).findIndex((g) => g.name === c.group && g.nearest !== undefined);
  const named = (value: unknown): number => (value === c.group ? 1 : value && typeof value === "object" ? Object.values(value).reduce((sum: number, v) => sum + named(v), 0) : 0);
  // The group says its name once, the condition says it as its group, and as its own name where both are called the same.
  const own = 2 + (c.name === c.group ? 1 : 0), path: Key[] = [c.section, c.index];
  return group >= 0 && named(document) === own ? [path, ["mesh", "group", group]] : [path];
}
