/** Columns of the tables of a run, as the program declares them: labels, charts, marks for "no value". */
import type { Line } from "./charts";
import type { Page } from "./run";
import { unitText } from "./quantities";

/** A row of the program's declarations (quantities/column.hpp). */
export interface Column {
  /** One that begins with "_" is of each contact, channel or source, whose name stands before it. */
  name: string;
  unit: string;
  label: string;
  chart?: string;
  no_value?: number;
  background?: boolean;
  logarithmic?: boolean;
  /** The list of steps or shots shows it, row by row. */
  listed?: boolean;
}
export interface Declared {
  tables: Record<string, Column[]>;
  charts: string[];
}

const tables = new Map<string, Column[]>();
let titles: string[] = [];

/** Takes the declarations that a run brings. */
export function declareColumns(declared?: Declared): void {
  if (!declared) return;
  for (const [name, rows] of Object.entries(declared.tables)) tables.set(name, rows);
  titles = declared.charts;
}

export function split(header: string): { name: string; unit: string } {
  const match = /^(.*)\[(.*)\]$/.exec(header);
  return match ? { name: match[1], unit: match[2] } : { name: header, unit: "" };
}

/** The declaration of a column; nothing for a probe. */
export function columnOf(table: string, header: string): Column | undefined {
  const { name, unit } = split(header), rows = (tables.get(table) ?? []).filter((row) => row.unit === unit);
  return rows.find((row) => row.name === name) ?? rows.filter((row) => row.name.startsWith("_") && name.endsWith(row.name)).sort((a, b) => b.name.length - a.name.length)[0];
}

/** "Stored heat"; of a contact "interface: normal force"; of a probe its name. */
export function labelOfColumn(table: string, header: string): string {
  const { name } = split(header), row = columnOf(table, header);
  if (!row) return name.replace(/_/g, " ");
  return row.name === name ? row.label : `${name.slice(0, -row.name.length).replace(/_/g, " ")}: ${row.label}`;
}

/** The label with its unit, for the head of a table. */
export function headOfColumn(table: string, header: string): string {
  const unit = unitText(split(header).unit);
  return labelOfColumn(table, header) + (unit ? ` [${unit}]` : "");
}

/** Headers of a table that its list of rows shows, in the order of the file. */
export function listedHeaders(table: string, headers: string[]): string[] {
  return headers.filter((header) => columnOf(table, header)?.listed === true);
}

/** Headers of all runs but those of time, stage and cycle. */
export function headersOf(page: Page, table: string): string[] {
  return [...new Set(page.runs.flatMap((r) => r.table(table)?.headers ?? []))].filter((x) => !/^(time|stage|cycle)\[/.test(x));
}

export const constantZero = (values: ArrayLike<number>) => Array.prototype.every.call(values, (v: number) => v === 0);

/** Lines of one column in all runs, over another column of the table. */
export function linesOf(page: Page, table: string, header: string, colour: number, off = false, abscissa = "time"): Line[] {
  const none = columnOf(table, header)?.no_value;
  return page.runs.flatMap((run, r) => {
    const t = run.table(table), x = t?.numbers(abscissa), y = t?.numbers(header);
    if (!x || !y || !y.length) return [];
    const label = labelOfColumn(table, header);
    return [{ label: page.runs.length > 1 ? `${label} · ${run.meta.name}` : label, x, y: none === undefined ? y : Array.from(y, (v) => (v === none ? NaN : v)), colour, dashed: r > 0, off: off || r > 1 }];
  });
}

/** The charts that declarations name, with the columns of a table for each that say something in some run. */
export function charts(page: Page, table: string): { title: string; unit: string; logarithmic: boolean; headers: string[] }[] {
  const there = headersOf(page, table).filter((x) => page.runs.some((r) => {
    const values = r.table(table)?.numbers(x), none = columnOf(table, x)?.no_value;
    return values && !constantZero(values) && (none === undefined || Array.prototype.some.call(values, (v: number) => v !== none));
  }));
  return titles.flatMap((title) => {
    const headers = there.filter((x) => columnOf(table, x)?.chart === title);
    return headers.length ? [{ title, unit: split(headers[0]).unit, logarithmic: columnOf(table, headers[0])!.logarithmic === true, headers }] : [];
  });
}
