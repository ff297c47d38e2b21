/** The steps of a run: start, watch, judge, compare. */
import uPlot from "uplot";
import { h } from "../../report/src/dom";
import { lineColour } from "../../report/src/colours";
import { get, type Answer, type Desk, type Finding, type RunState, type State } from "./state";
import { field, select } from "./setup";

type Children = (Node | string | null | false)[];
interface Curves { columns: { name: string; unit: string }[]; rows: (number | null)[][] }

const short = (v: number | null | undefined) => (v === null || v === undefined || !Number.isFinite(v) ? "–" : String(+v.toPrecision(4)));
/** A unit as people write it. */
const UNITS: Record<string, string> = { "1": "", um: "µm", degC: "°C", K2: "K²", m2: "m²", mm2: "mm²", cm3: "cm³", m3: "m³", "K0.5 s0.5/mm": "√(K s)/mm" };
const unitText = (unit: string) => UNITS[unit] ?? unit;
/** A value with its error, which has two digits, and its unit. */
const withError = (a: Answer) => [`${short(a.value)}${a.error ? ` ± ${+a.error.toPrecision(2)}` : ""}`, unitText(a.unit)].filter(Boolean).join(" ");
const seconds = (s: number) => (s < 90 ? `${Math.round(s)} s` : `${Math.floor(s / 60)} min ${Math.round(s % 60)} s`);

export class Judge {
  private physics = "heat";
  private sure = false;
  private first = "";
  private second = "";
  private plot?: uPlot;

  constructor(private readonly desk: Desk, private readonly openReport: (run: string) => void, private readonly finding: (f: Finding, id: string) => HTMLElement) {}

  /** 4: what is computed. */
  run(state: State): Children {
    const refused = !!state.check?.current && state.check.error !== null;
    if (!state.case) return [h("p", { class: "hint" }, "There is no case yet.")];
    const sure = h("input", { type: "checkbox", id: "sure", checked: this.sure, disabled: !!state.job });
    sure.addEventListener("change", () => (this.sure = sure.checked));
    return [
      field("What is computed", select("physics", [["heat", "heat: when and where it freezes, feeding"], ["coupled", "heat and deformation: gaps, stress, distortion"]], this.physics, (v) => (this.physics = v), !!state.job)),
      h("label", { class: "check" }, sure, " with the errors of step and mesh (two more runs)"),
      h("div", { class: "buttons" }, h("button", { class: "main on", id: "run", disabled: !!state.job || refused, title: refused ? "check refuses the case" : "",
        click: () => void this.desk.ask("run", { physics: this.physics, sure: this.sure }) }, "Run")),
    ];
  }

  /** 5: runs that are there. */
  runs(state: State): Children {
    if (!state.runs.length) return [h("p", { class: "hint" }, "There is no run yet.")];
    const busy = !!state.job, names = state.runs.map((r) => r.name);
    if (!names.includes(this.second)) this.second = names[names.length - 1];
    if (!names.includes(this.first) || this.first === this.second) this.first = names.filter((n) => n !== this.second).pop() ?? names[0];
    const options = names.map((n): [string, string] => [n, n.replace("_", " ")]);
    return [
      ...[...state.runs].reverse().map((r) => this.one(r, state.job?.run === r.name, busy)),
      names.length > 1 ? h("div", { class: "compare" },
        field("Compare", select("first", options, this.first, (v) => (this.first = v), busy)), field("with", select("second", options, this.second, (v) => (this.second = v), busy)),
        h("button", { id: "compare", disabled: busy, click: () => void this.desk.ask("compare", { first: this.first, second: this.second }) }, "Compare")) : null,
    ];
  }

  private one(run: RunState, goesOn: boolean, busy: boolean): HTMLElement {
    const good = run.outcome === "finished";
    // An answer that was found at a place leads to it.
    const show = (a: Answer) => this.desk.show({ severity: "note", message: a.name, places: [a.at!], bodies: [] });
    const name = (a: Answer) => (a.at ? h("button", { class: "link", title: "Show where", click: () => show(a) }, a.name) : a.name);
    const line = (a: Answer) => h("tr", {}, h("th", { scope: "row" }, name(a)), h("td", {}, withError(a)));
    return h("article", { class: "run", id: run.name },
      h("header", {}, h("b", {}, run.name.replace("_", " ")), h("span", { class: `badge ${goesOn ? "" : good ? "good" : "bad"}` }, goesOn ? "running" : run.outcome.split(/[:;,]/)[0]),
        run.report ? h("button", { id: `report-${run.name}`, click: () => this.openReport(run.name) }, "Report") : null,
        good ? h("button", { id: `print-${run.name}`, disabled: busy, title: "Four pages for the customer; logo and words are those of customer.toml next to the case", click: () => void this.desk.ask("print", { run: run.name }) }, run.printed ? "Print again" : "PDF") : null,
        run.printed ? h("a", { id: `printed-${run.name}`, href: `run/${run.name}/printed`, target: "_blank", rel: "noopener" }, run.printed) : null,
        h("button", { class: "quiet", id: `curves-${run.name}`, click: () => void this.curves(run.name) }, "Curves")),
      ...run.verdicts.map((v) => h("p", { class: v.good === null ? "hint" : v.good ? "good" : "bad" }, v.text)),
      run.answers.length ? h("table", { class: "plain answers" }, ...run.answers.map(line)) : null,
      run.warnings.length ? h("details", {}, h("summary", {}, `${run.warnings.length} to look at`), h("ul", { class: "findings" }, ...run.warnings.map((w, n) => this.finding(w, `${run.name}-look-${n}`)))) : null);
  }

  private async curves(run: string): Promise<void> {
    this.desk.openTab("curves");
    await this.draw(run);
  }

  /** The curves of a run: temperatures of the probes, and the share that is solid. */
  async draw(run: string): Promise<void> {
    const box = document.getElementById("curves")!;
    const { columns, rows } = await get<Curves>(`curves?run=${encodeURIComponent(run)}`).catch(() => ({ columns: [], rows: [] }) as Curves);
    this.plot?.destroy();
    this.plot = undefined;
    if (rows.length < 2) return box.replaceChildren(h("p", { class: "hint" }, `${run.replace("_", " ")}: no curves yet`));
    const dark = document.documentElement.dataset.theme === "dark", ink = dark ? "#9aa7b4" : "#5c6875", grid = { stroke: dark ? "#29313a" : "#e6e9ed" };
    const holder = h("div", {});
    box.replaceChildren(h("h3", {}, `${run.replace("_", " ")}: temperatures of the probes, share that is solid`), holder);
    const unit = (c: Curves["columns"][0]) => (c.unit === "1" ? "share" : c.unit);
    const scales = [...new Set(columns.slice(1).map(unit))];
    this.plot = new uPlot({
      width: Math.max(300, box.clientWidth - 24), height: 380, cursor: { drag: { x: true, y: false } }, scales: { x: { time: false } },
      axes: [{ label: "time [s]", stroke: ink, grid }, ...scales.map((s, i) => ({ scale: s, label: s === "share" ? "share" : `[${s}]`, stroke: ink, grid, side: i ? 1 : 3 }))],
      series: [{ label: "time [s]" }, ...columns.slice(1).map((c, i) => ({ label: c.name, scale: unit(c), stroke: lineColour(i, dark), width: 1.6 }))],
    }, columns.map((_, i) => rows.map((r) => r[i])) as uPlot.AlignedData, holder);
  }

  /** The bar of what is computed at present. */
  job(state: State): Children {
    const job = state.job, last = state.last;
    if (!job) return last && !last.ok ? [
      h("p", { class: "bad", role: "alert", id: "failed" }, last.stopped ? "Stopped." : last.message)] : [];
    const { done, time, solid, step } = job.progress;
    const text = [time !== undefined && time !== null ? `${short(time)} s of the casting` : "", step ? `step ${step}` : "", solid !== undefined && solid !== null ? `${Math.round(100 * solid)} % solid` : ""].filter(Boolean).join(", ");
    const bar = h("progress", { max: 1, "aria-label": "How much is done" });
    if (done !== undefined && done !== null) bar.value = done;
    return [
      h("p", {}, h("b", {}, `Solidus ${job.label.replace("_", " ")} …`), h("small", {}, ` ${seconds(job.seconds)}`)), bar, text ? h("p", { class: "hint" }, text) : null,
      h("div", { class: "buttons" }, h("button", { id: "stop", click: () => void this.desk.ask("stop") }, job.stopping ? "Stop at once" : "Stop"),
        job.watch ? h("button", { id: "watch", click: () => this.desk.openTab("live") }, "Watch it freeze") : null),
      job.lines.length ? h("details", {}, h("summary", {}, "What the program says"), h("pre", { class: "case", tabindex: 0 }, job.lines.slice(-40).join("\n"))) : null,
    ];
  }

  /** Answers of two runs next to each other. */
  compared(state: State): Children {
    const c = state.compared;
    if (!c) return [h("p", { class: "hint" }, "Choose two runs on the left and compare them.")];
    return [h("table", { class: "plain wide" }, h("caption", {}, `${c.first.replace("_", " ")} and ${c.second.replace("_", " ")}`),
      h("tr", {}, ...["Answer", c.first.replace("_", " "), c.second.replace("_", " "), "Difference"].map((t) => h("th", { scope: "col" }, t))),
      ...c.answers.map((a) => h("tr", {}, h("th", { scope: "row" }, `${a.name}${unitText(a.unit) ? ` [${unitText(a.unit)}]` : ""}`), h("td", {}, short(a.first)), h("td", {}, short(a.second)), h("td", {}, short(a.difference)))))];
  }
}
