/** Names and units as a foundry engineer reads them. Everything in a page is SI; here it is turned for the eye. */

export interface Unit {
  text: string;
  scale: number;
  offset: number;
}

/** What the program says of a field: a row of its declarations, in SI. */
export interface Quantity {
  name: string;
  unit: string;
  root_unit?: string;
  label: string;
  group: string;
  worst: "none" | "least" | "greatest";
  headline?: string;
  colours: "sequential" | "hot" | "share" | "by_sign";
  shown: ShownUnit;
}
export interface ShownUnit {
  text: string;
  factor: number;
  offset: number;
}

const quantities = new Map<string, Quantity>(), units = new Map<string, Unit>();
export const PERCENT: Unit = { text: "%", scale: 100, offset: 0 };

function asUnit(shown: ShownUnit): Unit {
  return { text: shown.text.replace(/ /g, "\u00a0"), scale: shown.factor, offset: shown.offset };
}

/** Takes the declarations that a run brings; those of a later run count where both have one. */
export function declare(rows: Quantity[], shown: Record<string, ShownUnit>): void {
  for (const [si, unit] of Object.entries(shown)) units.set(si, asUnit(unit));
  for (const row of rows) {
    quantities.set(row.name, row);
    if (row.root_unit) units.set(row.root_unit, asUnit(row.shown));
  }
}

export function quantityOf(field: string): Quantity | undefined {
  return quantities.get(field);
}

/** Quantities that have a figure at the head of the page. */
export function headlines(): Quantity[] {
  return [...quantities.values()].filter((row) => row.headline);
}

/** The unit in which people read values of a SI unit. */
export function unitOfValue(si: string): Unit {
  return units.get(si) ?? { text: si, scale: 1, offset: 0 };
}

/** The unit in which people read a field. */
export function unitOf(field: string, si: string): Unit {
  const row = quantities.get(field);
  return row && (row.unit === si || row.root_unit === si) ? asUnit(row.shown) : unitOfValue(si);
}

export function labelOf(name: string): string {
  const text = quantities.get(name)?.label ?? name.replace(/_/g, " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** The heading of a field in the menu. */
export function groupOf(name: string): string {
  const group = quantities.get(name)?.group ?? "other";
  return group.charAt(0).toUpperCase() + group.slice(1);
}

/** About four digits, without noise. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return tidyExponent(value.toExponential(2));
  if (size >= 1e5) return value.toFixed(0);
  return String(+value.toPrecision(4)).replace("-", "−");
}

function tidyExponent(text: string): string {
  const [digits, power] = text.split("e");
  const raised = String(+power).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  return `${String(+digits).replace("-", "−")}·10${raised}`;
}

export function withUnit(value: number, unit: Unit): string {
  return short(value * unit.scale + unit.offset) + (unit.text ? ` ${unit.text}` : "");
}

/** "14.0 s", "7 min 45 s", "2 h 3 min". */
export function duration(seconds: number): string {
  if (!Number.isFinite(seconds)) return "–";
  if (Math.abs(seconds) < 120) return `${short(seconds)} s`;
  const whole = Math.round(seconds);
  if (whole < 7200) return `${Math.floor(whole / 60)} min${whole % 60 ? ` ${whole % 60} s` : ""}`;
  const minutes = Math.round(whole / 60);
  return `${Math.floor(minutes / 60)} h${minutes % 60 ? ` ${minutes % 60} min` : ""}`;
}

/** Coordinates in mm, to a tenth; small parts to two digits. */
export function place(x: ArrayLike<number>, dimension = 3): string {
  const one = (metres: number) => {
    const v = metres * 1e3, text = Math.abs(v) >= 1 ? v.toFixed(1) : v.toPrecision(2);
    return String(Math.abs(v) < 5e-4 ? 0 : +text).replace("-", "−");
  };
  return `(${Array.from(x).slice(0, dimension).map(one).join(", ")}) mm`;
}

/** A unit of columns and answers, as the program names it: "m²", which measures an area. */
export interface UnitName {
  text: string;
  measures: string;
}
const names = new Map<string, UnitName>();

export function nameUnits(rows: Record<string, UnitName> = {}): void {
  for (const [unit, name] of Object.entries(rows)) names.set(unit, name);
}

/** "degC" of the tables as "°C". */
export function unitText(unit: string): string {
  return names.get(unit)?.text ?? unit.replace("m2", "m²").replace("m3", "m³");
}

/** What a unit measures, as the title of a chart: "Temperature". */
export function measureOf(unit: string): string {
  return names.get(unit)?.measures ?? unitText(unit);
}
