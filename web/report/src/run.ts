/** A run as the page holds it: meshes, fields over the written moments, tables. */
import { blockJson, doubles, PackedValues, risingNumbers, smallNumbers, STEPS, Values } from "./blocks";
import { Declared, declareColumns } from "./columns";
import { declare, groupOf, labelOf, nameUnits, Quantity, ShownUnit, Unit, UnitName, unitOf } from "./quantities";
import type { ToldSection } from "./told";

interface BodyMeta {
  name: string;
  material?: string;
  nodes: number;
  corners: number;
  simplices: number;
  points: PackedValues[];
  numbers: number;
  skin?: number;
  cells?: [number, number];
}
interface FieldMeta {
  name: string;
  component: string;
  unit: string;
  of_elements: boolean;
  at_end: boolean;
  values: PackedValues[];
  extremes?: ([] | [number, number[], number, number[]])[][];
}
interface TableMeta {
  rows: number;
  rows_in_file: number;
  columns: { header: string; block?: number; texts?: string[] }[];
}
export interface Card {
  title: string;
  "density[kg/m3]": number;
  properties: { name: string; unit: string; "temperature[K]": number[]; values: number[] }[];
  phase_changes: Record<string, number | string>[];
  sources: { property: string; source: string; "valid_from[K]"?: number; "valid_to[K]"?: number }[];
}
interface RunMeta {
  name: string;
  title: string;
  kind: string;
  physics: string;
  case_text: string;
  summary_text?: string;
  uncertain_text?: string;
  calibrated_text?: string;
  filling_text?: string;
  /** Block of the bytes of the filling. */
  filling?: number;
  materials: { body: string; material: string; card?: Card; missing?: string }[];
  tables: Record<string, TableMeta>;
  mesh?: { dimension: number; bodies: BodyMeta[] };
  moments?: { time: number; present: boolean[] }[];
  fields?: FieldMeta[];
  quantities: Quantity[];
  units: Record<string, ShownUnit>;
  unit_names?: Record<string, UnitName>;
  declared?: Declared;
  sections?: ToldSection[];
  notes: string[];
}
interface PageMeta {
  format: number;
  solidus: string;
  made: string;
  runs: RunMeta[];
}

export class Body {
  readonly name: string;
  readonly material: string;
  readonly n: number;
  readonly corners: number;
  private kept: { x?: Float32Array; skin?: Uint32Array; cells?: Uint32Array; numbers?: Int32Array } = {};

  constructor(private readonly meta: BodyMeta) {
    this.name = meta.name;
    this.material = meta.material ?? "";
    this.n = meta.nodes;
    this.corners = meta.corners;
  }
  /** [node][3] in metres. */
  get x(): Float32Array {
    if (this.kept.x) return this.kept.x;
    const x = new Float32Array(3 * this.n);
    this.meta.points.forEach((axis, i) => {
      const along = new Values(axis, this.n, 1).at(0);
      for (let k = 0; k < this.n; ++k) x[3 * k + i] = along[k];
    });
    return (this.kept.x = x);
  }
  /** Least and greatest coordinates: those of the packed axes. */
  get box(): [[number, number, number], [number, number, number]] {
    const axes = this.meta.points.map((axis) => new Values(axis, this.n, 1));
    return [axes.map((a) => a.low), axes.map((a) => a.high)] as [[number, number, number], [number, number, number]];
  }
  /** Numbers of the nodes in the mesh file. */
  get numbers(): Int32Array {
    return (this.kept.numbers ??= risingNumbers(this.meta.numbers));
  }
  /** Triangles of the skin of a solid. */
  get skin(): Uint32Array {
    return (this.kept.skin ??= this.meta.skin === undefined ? new Uint32Array() : Uint32Array.from(risingNumbers(this.meta.skin)));
  }
  /** Whether it can be cut: a body of very many cells is there by its skin alone. */
  get hasCells(): boolean {
    return this.meta.cells !== undefined;
  }
  /** [cell][corner]: tetrahedra, in the plane triangles. */
  get cells(): Uint32Array {
    if (this.kept.cells) return this.kept.cells;
    if (!this.meta.cells) return new Uint32Array();
    const first = risingNumbers(this.meta.cells[0]), others = smallNumbers(this.meta.cells[1]);
    const n = first.length, corners = this.corners;
    const cells = new Uint32Array(corners * n);
    for (let c = 0; c < n; ++c) {
      cells[corners * c] = first[c];
      for (let k = 1; k < corners; ++k)
        cells[corners * c + k] = cells[corners * c + k - 1] + others[(k - 1) * n + c];
    }
    return (this.kept.cells = cells);
  }
}

export interface Extreme {
  body: number;
  low: number;
  lowAt: number[];
  high: number;
  highAt: number[];
}

/** A scalar that can be painted: a number, a component or the size of a vector. */
export class Field {
  readonly label: string;
  readonly unit: Unit;
  readonly group: string;
  /** Sizes of a vector, as last asked for: by body. */
  private readonly sizes: { parts: Float32Array[]; values: Float32Array }[] = [];

  constructor(
    readonly id: string,
    readonly name: string,
    readonly component: string,
    private readonly metas: FieldMeta[],
    private readonly columns: Values[][],
  ) {
    this.label = labelOf(name) + (component ? ` ${component}` : "");
    this.unit = unitOf(name, metas[0].unit);
    this.group = groupOf(name);
  }
  get ofElements(): boolean {
    return this.metas[0].of_elements;
  }
  /** Of the whole run so far: the same at every moment. */
  get atEnd(): boolean {
    return this.metas[0].at_end;
  }
  has(body: number): boolean {
    return this.columns.some((c) => c[body] && !c[body].none);
  }
  /** Whether some place has no value at some moment. */
  partial(body: number): boolean {
    return this.columns.some((c) => c[body]?.partial);
  }
  values(body: number, moment: number): Float32Array {
    const parts = this.columns.map((c) => c[body].at(moment));
    if (parts.length === 1) return parts[0];
    const kept = this.sizes[body];
    if (kept && kept.parts.every((part, i) => part === parts[i])) return kept.values;
    const out = new Float32Array(parts[0].length);
    for (const part of parts) for (let i = 0; i < out.length; ++i) out[i] += part[i] * part[i];
    for (let i = 0; i < out.length; ++i) out[i] = Math.sqrt(out[i]);
    this.sizes[body] = { parts, values: out };
    return out;
  }
  value(body: number, node: number, moment: number): number {
    if (this.columns.length === 1) return this.columns[0][body].one(node, moment);
    return Math.hypot(...this.columns.map((c) => c[body].one(node, moment)));
  }
  /** No value of the run is larger: of a vector, what its components allow. Nothing is unpacked for it. */
  bound(bodies: number[]): number {
    const of = (b: number) => Math.hypot(...this.columns.map((c) => Math.max(Math.abs(c[b].low), Math.abs(c[b].high))));
    return Math.max(0, ...bodies.filter((b) => this.has(b)).map(of));
  }
  /** Over the whole run. */
  range(bodies: number[]): [number, number] {
    let low = Infinity, high = -Infinity;
    for (const b of bodies) {
      if (!this.has(b)) continue;
      if (this.columns.length === 1) {
        low = Math.min(low, this.columns[0][b].low);
        high = Math.max(high, this.columns[0][b].high);
      } else {
        for (let m = 0; m < (this.atEnd ? 1 : this.columns[0][b].moments); ++m)
          [low, high] = widen(this.values(b, m), low, high);
      }
    }
    return low <= high ? [low, high] : [0, 1];
  }
  /** The step in which numbers were rounded. */
  private rounding(bodies: number[]): number {
    const steps = bodies.filter((b) => this.has(b)).flatMap((b) => this.columns.map((c) => (c[b].high - c[b].low) / STEPS));
    return Math.max(0, ...steps);
  }
  rangeAt(bodies: number[], moment: number): [number, number] {
    let low = Infinity, high = -Infinity;
    for (const b of bodies) if (this.has(b)) [low, high] = widen(this.values(b, moment), low, high);
    if (!(low <= high)) return [0, 1];
    // Numbers were rounded: a scale of nearly equal ones would show nothing but that.
    const room = 20 * this.rounding(bodies);
    return high - low < 2 * room ? [(low + high) / 2 - room, (low + high) / 2 + room] : [low, high];
  }
  /** The least and largest element of a body; nothing for fields at nodes. */
  extremes(moment: number): Extreme[] {
    return (this.metas[0].extremes?.[moment] ?? []).flatMap((e, body) =>
      e.length === 4 ? [{ body, low: e[0], lowAt: e[1], high: e[2], highAt: e[3] }] : [],
    );
  }
}

function widen(values: Float32Array, low: number, high: number): [number, number] {
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return [low, high];
}

export class Table {
  readonly headers: string[];
  private kept: (Float64Array | string[] | undefined)[] = [];
  constructor(private readonly meta: TableMeta) {
    this.headers = meta.columns.map((c) => c.header);
  }
  get rows(): number {
    return this.meta.rows;
  }
  private column(k: number): Float64Array | string[] {
    const c = this.meta.columns[k];
    return (this.kept[k] ??= c.block !== undefined ? doubles(c.block) : c.texts!);
  }
  /** Numbers of a column by its header or the name before the unit; nothing where it is not there. */
  numbers(name: string): Float64Array | undefined {
    const k = this.headers.findIndex((h) => h === name || h.startsWith(name + "["));
    if (k < 0) return undefined;
    const column = this.column(k);
    return column instanceof Float64Array ? column : undefined;
  }
  texts(name: string): string[] | undefined {
    const k = this.headers.indexOf(name);
    if (k < 0) return undefined;
    const column = this.column(k);
    return column instanceof Float64Array ? Array.from(column, String) : column;
  }
}

/** An answer with its error in SI: value[s], error[s], error_of_step[s], error_of_mesh[s]. */
export type Answer = Record<string, unknown>;

/** uncertain.json of `solidus uncertain`: what the spreads of the data make of the answers. */
export interface Uncertain {
  coverage?: number;
  remarks?: string[];
  answers?: {
    name: string;
    unit: string;
    value: number;
    plus_minus: number;
    step_and_mesh?: number | null;
    jumps?: boolean;
    parts: { label: string; up: number | null; down: number | null; plus_minus: number }[];
  }[];
}

/** calibrate.json of `solidus calibrate`: what was measured, and the values found. */
export interface Calibrated {
  measured?: string;
  confidence?: number;
  residuals_over_noise?: number;
  noise_stated?: boolean;
  unknowns?: { name: string; unit: string; value: number; low: number; high: number; at_bound?: boolean }[];
  correlation?: number[][];
  not_seen?: { deviation: number | null; combination: Record<string, number> }[];
  observations?: { name: string; unit: string; readings: number; rms: number; mean: number }[];
  curves?: { name: string; unit: string; time: number[]; measured: number[]; computed: number[] }[];
}

/** What a run says of a body that was cast. */
export interface CastAnswer {
  riser?: boolean;
  gating?: boolean;
  "mass[kg]"?: number;
  last_melt_froze?: Answer;
  least_niyama?: Answer;
  pores?: Answer;
  [answer: string]: unknown;
}

/** summary.json; every member may be missing. */
export interface Summary {
  outcome?: string;
  processes?: number;
  steps?: number;
  rejected_steps?: number;
  shortened_steps?: number;
  "end_time[s]"?: number;
  mesh?: { nodes: number; elements: Record<string, number> };
  seconds?: Record<string, number>;
  "profile[s]"?: Record<string, number>;
  "peak_memory[bytes]"?: Record<string, number>;
  relative_energy_defect?: number;
  final?: Record<string, number>;
  criteria?: Record<string, number | number[]>;
  answers?: {
    castings?: Record<string, CastAnswer>;
    yield?: number;
    largest_von_mises?: Answer;
    errors_of_criteria?: Record<string, Answer>;
    [answer: string]: unknown;
    pores?: Answer & { "value[1]": number; "at[m]": number[]; "volume[m3]": number; share_of_casting: number };
  };
  fields?: Record<string, Quantity>;
  warnings?: string[];
  understood?: {
    bodies?: Record<string, unknown>[];
    poured?: Record<string, unknown>[];
    skins?: Record<string, unknown>[];
  };
  [key: string]: unknown;
}

export class Run {
  readonly dimension: number;
  readonly bodies: Body[];
  readonly times: number[];
  readonly fields: Field[] = [];
  readonly displacement: Values[][];
  readonly summary: Summary;
  readonly uncertain?: Uncertain;
  readonly calibrated?: Calibrated;
  private tables = new Map<string, Table>();

  constructor(readonly meta: RunMeta) {
    this.dimension = meta.mesh?.dimension ?? 3;
    this.bodies = (meta.mesh?.bodies ?? []).map((b) => new Body(b));
    this.times = (meta.moments ?? []).map((m) => m.time);
    this.summary = meta.summary_text ? (JSON.parse(meta.summary_text) as Summary) : {};
    declare(Object.values(this.summary.fields ?? {}), {});  // also of criteria that this program does not have
    const columns = (f: FieldMeta) =>
      f.values.map((v, b) => new Values(v, this.bodies[b].n, f.at_end ? 1 : this.times.length));
    const metas = meta.fields ?? [];
    const byName = new Map<string, FieldMeta[]>();
    for (const f of metas) byName.set(f.name, [...(byName.get(f.name) ?? []), f]);
    for (const [name, parts] of byName) {
      const values = parts.map(columns);
      if (!values.some((c) => c.some((v) => !v.none))) continue;
      this.fields.push(new Field(name, name, "", parts, values));
      const letters = this.axisymmetric ? ["r", "z"] : ["x", "y", "z"];
      if (parts.length > 1)
        parts.slice(0, this.dimension).forEach((part, i) =>
          this.fields.push(new Field(`${name}.${part.component}`, name, letters[i], [part], [values[i]])),
        );
    }
    this.displacement = metas.filter((f) => f.name === "displacement").map(columns);
    if (meta.calibrated_text) this.calibrated = JSON.parse(meta.calibrated_text) as Calibrated;
    if (meta.uncertain_text) this.uncertain = JSON.parse(meta.uncertain_text) as Uncertain;
    for (const [name, table] of Object.entries(meta.tables)) this.tables.set(name, new Table(table));
  }
  get axisymmetric(): boolean {
    return this.meta.kind === "axisymmetric";
  }
  table(name: string): Table | undefined {
    return this.tables.get(name);
  }
  present(body: number, moment: number): boolean {
    return this.meta.moments?.[moment]?.present[body] ?? true;
  }
  /** Temperatures at the nodes of a body that grows: NaN where it has not been yet. Nothing for others. */
  places(body: number, moment: number): Float32Array | undefined {
    const field = this.fields.find((f) => f.id === "temperature");
    return field?.partial(body) ? field.values(body, moment) : undefined;
  }
  /** Bodies that melt: what the run says it pours, else what was not solid at the start. */
  get castings(): number[] {
    const poured = (this.summary.understood?.poured ?? []).map((p) => p.body);
    const named = this.bodies.flatMap((b, i) => (poured.includes(b.name) ? [i] : []));
    if (named.length) return named;
    const solid = this.fields.find((f) => f.id === "solid_fraction");
    return this.bodies.flatMap((_, i) => (solid?.has(i) && solid.range([i])[0] < 0.99 ? [i] : []));
  }
  /** The written moment nearest to a time. */
  moment(time: number): number {
    let best = 0;
    this.times.forEach((t, i) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = i;
    });
    return best;
  }
}

export class Page {
  readonly meta: PageMeta;
  readonly runs: Run[];
  constructor() {
    this.meta = blockJson("meta") as PageMeta;
    if (this.meta.format !== 1) throw new Error("the page is of another version of the viewer");
    for (const r of this.meta.runs) {
      declare(r.quantities, r.units);
      nameUnits(r.unit_names);
      declareColumns(r.declared);
    }
    this.runs = this.meta.runs.map((r) => new Run(r));
  }
}
