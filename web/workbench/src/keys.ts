/** Forms for any key of the case file, made from the JSON Schema of the keys. */
import { h } from "../../report/src/dom";
import { get, type Desk, type Document, type Key, type State } from "./state";

interface Schema {
  type?: string | string[]; description?: string; properties?: Record<string, Schema>; items?: Schema; enum?: unknown[]; anyOf?: Schema[]; additionalProperties?: boolean | Schema;
}
type Children = (Node | string | null | false)[];

/** The branches of a schema that is one of several. */
const branches = (s: Schema): Schema[] => [s, ...(s.anyOf ?? [])];
const sectionOf = (s: Schema): Schema | undefined => branches(s).find((b) => b.properties);
const entryOf = (s: Schema): Schema | undefined => branches(s).map((b) => b.items).find((i) => i && sectionOf(i));
const isTable = (v: unknown): v is Document => typeof v === "object" && v !== null && !Array.isArray(v);
const areTables = (v: unknown): v is Document[] => Array.isArray(v) && v.length > 0 && v.every(isTable);
const idOf = (path: Key[]) => path.map((p) => String(p).replace(/\W/g, "-")).join("-");

export class Keys {
  private schema?: Schema;
  private at: Key[] = [];
  /** A key that is being added, or the first key of a section that is. */
  private pending?: { path: Key[]; name: string; schema: Schema; entry: boolean };
  /** Called when there is more to show. */
  again: () => void = () => {};

  constructor(private readonly desk: Desk) {}

  private async load(): Promise<void> {
    this.schema = await get<Schema>("schema");
    this.again();
  }

  /** The section that a finding is about, by its dotted path with entries counted from one. */
  turnTo(dotted: string): void {
    this.at = dotted.split(".").map((p) => (/^\d+$/.test(p) ? +p - 1 : p));
    const document = this.desk.state.case?.document;
    while (this.at.length && !isTable(valueAt(document, this.at))) this.at = this.at.slice(0, -1);
  }

  render(state: State): Children {
    const document = state.case?.document;
    if (!document) return [h("p", { class: "hint" }, state.case ? "The file cannot be read: mend it as a text." : "There is no case yet.")];
    if (!this.schema) {
      void this.load();
      return [h("p", { class: "hint" }, "The keys are read …")];
    }
    if (!isTable(valueAt(document, this.at))) this.at = [];
    const list = sections(document, []);
    const busy = !!state.job;
    return [h("div", { class: "keys-columns" },
      h("nav", { "aria-label": "Sections of the case" }, ...list.map(({ path, name }) => h("button", {
        class: String(path) === String(this.at) ? "on" : "", id: `section-${idOf(path)}`, "aria-current": String(String(path) === String(this.at)), style: `padding-left:${10 + 12 * path.filter((p) => typeof p === "string").length}px`,
        click: () => { this.at = path; this.pending = undefined; this.again(); },
      }, name)), this.addSection(document, busy)),
      h("div", { class: "form" }, ...this.form(document, busy)))];
  }

  /** The schema of the section at a path. */
  private schemaAt(path: Key[]): Schema | undefined {
    let schema = sectionOf(this.schema!);
    for (const name of path) {
      if (!schema) return undefined;
      if (typeof name === "number") continue;
      const next: Schema | undefined = schema.properties?.[name];
      schema = next && (sectionOf(next) ?? (entryOf(next) && sectionOf(entryOf(next)!)));
    }
    return schema;
  }

  private form(document: Document, busy: boolean): Children {
    const section = valueAt(document, this.at) as Document, schema = this.schemaAt(this.at), known = schema?.properties ?? {};
    const plain = Object.entries(section).filter(([, v]) => !isTable(v) && !areTables(v));
    const free = Object.entries(known).filter(([name, s]) => !(name in section) && !sectionOf(s) && !entryOf(s));
    const add = h("select", { id: "add-key", disabled: busy, "aria-label": "Add a key to this section" }, h("option", { value: "" }, "Add a key …"), ...free.map(([name, s]) => h("option", { value: name, title: s.description ?? "" }, name)));
    add.addEventListener("change", () => this.begin([...this.at, add.value], add.value, known[add.value], false));
    return [
      h("h3", {}, this.at.length ? this.at.map((p) => (typeof p === "number" ? p + 1 : p)).join(" · ") : "The case"),
      schema?.description ? h("p", { class: "hint" }, schema.description) : null,
      ...plain.map(([name, value]) => this.row([...this.at, name], name, value, known[name], busy)), this.newRow(busy), free.length ? add : null,
      this.at.length ? h("button", { class: "quiet", id: "remove-section", disabled: busy, click: () => void this.desk.ask("remove", { path: this.at }) }, "Take this section away") : null,
    ];
  }

  private row(path: Key[], name: string, value: unknown, schema: Schema | undefined, busy: boolean): HTMLElement {
    const id = `key-${idOf(path)}`, about = schema?.description ?? "";
    const kinds = schema ? branches(schema) : [], options = kinds.find((s) => s.enum)?.enum;
    let input: HTMLInputElement | HTMLSelectElement;
    if (typeof value === "boolean") {
      input = h("input", { id, type: "checkbox", checked: value, disabled: busy });
      input.addEventListener("change", () => void this.desk.ask("set", { path, value: (input as HTMLInputElement).checked }));
    } else if (options && options.includes(value)) {
      input = h("select", { id, disabled: busy }, ...options.map((o) => h("option", { selected: o === value }, String(o))));
      input.addEventListener("change", () => void this.desk.ask("set", { path, value: input.value }));
    } else {
      input = h("input", { id, type: "text", value: typeof value === "string" ? value : JSON.stringify(value), disabled: busy, spellcheck: "false" });
      input.addEventListener("change", () => void this.set(path, schema, input.value, typeof value === "string"));
    }
    return h("div", { class: "key" }, h("label", { for: id }, name), input,
      h("button", { class: "quiet", id: `gone-${idOf(path)}`, title: `Take ${name} away`, "aria-label": `Take ${name} away`, disabled: busy, click: () => void this.desk.ask("remove", { path }) }, "✕"),
      about ? h("small", {}, about) : null);
  }

  private begin(path: Key[], name: string, schema: Schema | undefined, entry: boolean): void {
    if (!schema) return;
    this.pending = { path, name, schema, entry };
    this.again();
    document.getElementById("new-value")?.focus();
  }

  /** The field of what is being added. */
  private newRow(busy: boolean): HTMLElement | null {
    const p = this.pending;
    if (!p) return null;
    const options = branches(p.schema).flatMap((s) => s.enum ?? (s.type === "boolean" ? [true, false] : []));
    const input = options.length ? h("select", { id: "new-value", disabled: busy }, h("option", { value: "" }, "choose …"), ...options.map((o) => h("option", {}, String(o))))
      : h("input", { id: "new-value", type: "text", disabled: busy, spellcheck: "false", placeholder: "value, with its unit" });
    input.addEventListener("change", () => {
      if (input.value === "") return;
      this.pending = undefined;
      const value = typed(p.schema, input.value, false);
      if (!p.entry) return void this.desk.ask("set", { path: p.path, value });
      const key = String(p.path[p.path.length - 1]);
      void this.desk.ask("add", { sections: [{ path: p.path.slice(0, -1), values: { [key]: value } }] });
    });
    return h("div", { class: "key new" }, h("label", { for: "new-value" }, p.name), input,
      h("button", { class: "quiet", id: "new-gone", title: "Add nothing", "aria-label": "Add nothing", click: () => { this.pending = undefined; this.again(); } }, "✕"),
      h("small", {}, p.schema.description ?? ""));
  }

  private async set(path: Key[], schema: Schema | undefined, text: string, wasText = false): Promise<void> {
    const value = typed(schema, text, wasText);
    await this.desk.ask("set", { path, value });
  }

  /** Sections that the one shown, or the whole case, may have. */
  private addSection(document: Document, busy: boolean): HTMLElement {
    const known = this.schemaAt(this.at)?.properties ?? {}, here = valueAt(document, this.at) as Document;
    const free = Object.entries(known).filter(([name, s]) => entryOf(s) || (sectionOf(s) && !(name in here)));
    const add = h("select", { id: "add-section", disabled: busy || !free.length, "aria-label": "Add a section" },
      h("option", { value: "" }, this.at.length ? "Add a section below it …" : "Add a section …"), ...free.map(([name, s]) => h("option", { value: name, title: s.description ?? "" }, name)));
    add.addEventListener("change", () => {
      const name = add.value, schema = known[name], entry = schema && entryOf(schema), inner = sectionOf(entry ?? schema ?? {});
      if (!schema || !inner) return;
      if (entry && this.at.some((p) => typeof p === "number")) return this.desk.tell("Lists below an entry of a list are added in the file.", true);
      const needed = Object.entries(inner.properties!).find(([, s]) => /\(required\)/.test(s.description ?? "") && !sectionOf(s) && !entryOf(s)) ?? Object.entries(inner.properties!)[0];
      this.begin([...this.at, name], `${name}: ${needed[0]}`, needed[1], !!entry);
      this.pending!.path = [...this.at, name, needed[0]];
    });
    return add;
  }
}

/** What was typed: a text where the key holds one, else what it is in JSON: a number, true, a list. */
function typed(schema: Schema | undefined, text: string, wasText: boolean): unknown {
  const kinds = schema ? branches(schema).flatMap((s) => s.type ?? []) : [];
  if (wasText && (kinds.length === 0 || kinds.includes("string"))) return text;
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}

/** Sections of a document in its order: tables, and entries of lists of tables with their names. */
function sections(table: Document, path: Key[]): { path: Key[]; name: string }[] {
  const own = [{ path, name: path.length ? label(table, path) : "The case" }];
  for (const [key, value] of Object.entries(table)) {
    if (isTable(value)) own.push(...sections(value, [...path, key]));
    else if (areTables(value)) value.forEach((entry, i) => own.push(...sections(entry, [...path, key, i])));
  }
  return own;
}
function label(table: Document, path: Key[]): string {
  const last = path[path.length - 1];
  if (typeof last === "string") return last;
  return `${path[path.length - 2]}: ${String(table.name ?? table.body ?? last + 1)}`;
}
function valueAt(document: unknown, path: Key[]): unknown {
  return path.reduce<unknown>((value, name) => (value as Record<Key, unknown> | undefined)?.[name], document);
}
