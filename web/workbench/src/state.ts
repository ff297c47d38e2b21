/** What the server tells, and how the page asks it. */

export type Place = [number, number, number];
export type Key = string | number;

export interface Riser { name: string; foot: Place; diameter: number; height: number; neck_diameter?: number; neck_height?: number; neck_to?: Place; sleeve?: number }
export interface Chill { name: string; lowest: Place; highest: Place }
/** Sprue, runner and ingate in one body: `gate` is the middle of the ingate's end, `sprue` that of the sprue's top. */
export interface Gating {
  name: string; gate: Place; gate_width: number; gate_height: number; gate_length: number; runner_width: number; runner_height: number;
  sprue: Place; foot_diameter: number; top_diameter: number;
}
export interface Probe { name: string; point: Place }

/** What `solidus new` is given. Lengths in metres. */
export interface Choices {
  alloy: string; process: string; riser: "none" | "auto" | "placed"; symmetry: string; fineness: number; unit: string;
  roles: Record<string, string>; risers: Riser[]; chills: Chill[]; gatings: Gating[]; probes: Probe[]; gate: Place | null;
}

export interface Preview { low: Place; high: Place; walls: number[] | null; shell: number; size: number; smallest: number; mould_size: number; risers: Riser[] }
export interface Finding { severity: "error" | "warning" | "note"; message: string; places: Place[]; bodies: string[]; line?: number; section?: string }
export interface Answer { name: string; unit: string; value: number; error: number | null; at: Place | null }
export interface RunState { name: string; outcome: string; answers: Answer[]; verdicts: { text: string; good: boolean | null }[]; warnings: Finding[]; report: boolean; printed: string | null; time?: number; steps?: number }
export interface Progress { time?: number; step?: number; solid?: number | null; hottest?: number | null; done?: number | null }
export interface JobState { what: string; label: string; seconds: number; lines: string[]; stopping: boolean; run: string | null; watch: string | null; progress: Progress }
export interface Difference { name: string; unit: string; first: number | null; second: number | null; difference: number | null }
export type Document = Record<string, unknown>;

export interface State {
  revision: number; edits: number; folder: string; name?: string; part: string | null;
  case: { file: string; text: string; document: Document | null; error: string | null; digest: string } | null;
  choices: Choices | null; made: boolean | null; runs: RunState[]; thickest: Finding[]; undo: number; redo: number;
  /** What `solidus new` would make of the present choices, where it was asked: corners of the mould, its walls, sizes of elements, risers. */
  preview: Preview | null;
  check: { of: string; text: string; findings: Finding[]; error: string | null; current: boolean } | null;
  skins: Record<string, string>; job: JobState | null;
  last: { what: string; ok: boolean; message: string; findings: Finding[]; stopped?: boolean; number: number; run: string | null } | null;
  compared: { first: string; second: string; answers: Difference[]; tag: string } | null;
}

export interface About {
  version: string; materials: { name: string; title: string; alloy: boolean }[]; processes: Record<string, string>; roles: string[]; risers: Record<string, string>;
}

export class Refused extends Error {}

async function answer<T>(response: Response): Promise<T> {
  const told = await response.json().catch(() => ({ error: "the server does not know this page" }));
  if (!response.ok) throw new Refused(told.error ?? response.statusText);
  return told as T;
}

export async function get<T>(way: string): Promise<T> {
  return answer<T>(await fetch(way, { cache: "no-store" }));
}

export async function bytes(way: string): Promise<ArrayBuffer> {
  const response = await fetch(way, { cache: "no-store" });
  if (!response.ok) throw new Refused(response.statusText);
  return response.arrayBuffer();
}

export async function post(way: string, given: object = {}): Promise<State> {
  return answer<State>(await fetch(way, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(given) }));
}

export async function upload(file: File): Promise<State> {
  return answer<State>(await fetch(`upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file }));
}

/** What every part of the page knows: the last state, and what it may ask for. */
export interface Desk {
  state: State;
  about: About;
  /** Asks for a change of what is open; a refusal is shown. Returns whether it was made. */
  ask(way: string, given?: object): Promise<boolean>;
  /** Changes what `solidus new` is given. */
  choose(change: Partial<Choices>): Promise<boolean>;
  /** Lights up what a finding is about. */
  show(finding: Finding): void;
  /** Shows the form of a section, by its dotted path with entries counted from one. */
  openKeys(section: string): void;
  tell(message: string, bad?: boolean): void;
  openTab(name: string): void;
}
