/** The page: follows the state of the server and brings every part of itself to it. */
import { byId, h } from "../../report/src/dom";
import { Judge } from "./judge";
import { Keys } from "./keys";
import { Setup } from "./setup";
import { Stage } from "./stage";
import { get, post, Refused, upload, type About, type Choices, type Desk, type Finding, type State } from "./state";

const TABS = ["view", "live", "report", "compared", "curves", "keys", "text"] as const;
type Tab = (typeof TABS)[number];
const TAB_NAMES: Record<Tab, string> = { view: "Picture", live: "As it freezes", report: "Report", compared: "Comparison", curves: "Curves", keys: "Keys", text: "File" };

class Bench implements Desk {
  state!: State;
  private tab: Tab = "view";
  private readonly keysOf = new Map<string, string>();
  private readonly stage: Stage;
  private readonly setup: Setup;
  private readonly judge: Judge;
  private readonly keys: Keys;
  private lastRun: string | null = null;
  private curvesOf: string | null = null;
  /** The number of the job whose end was seen last. */
  private endSeen: number;
  /** Whether a button is held down, and the newest state that came meanwhile. */
  private pressed = false;
  private waiting: State | null = null;

  constructor(readonly about: About, state: State) {
    this.state = state;
    this.endSeen = state.last?.number ?? 0;
    this.stage = new Stage(this);
    this.setup = new Setup(this, () => (this.stage.which === "part" ? this.stage.picture.bodies : []), () => this.stage.riserOnTop(), () => this.stage.gatingAside());
    this.judge = new Judge(this, (run) => this.openReport(run), (finding, id) => this.setup.finding(finding, id));
    this.keys = new Keys(this);
    this.keys.again = () => this.panel("keys-form", "", this.keys.render(this.state), true);
    this.head();
    this.textEditor();
    this.dropping();
    this.shortcuts();
    this.presses();
  }

  // What parts of the page ask for

  async ask(way: string, given: object = {}): Promise<boolean> {
    try {
      this.apply(await post(way, { seen: this.state.edits, ...given }));
      return true;
    } catch (error) {
      this.tell(error instanceof Error ? error.message : String(error), true);
      if (error instanceof Refused) this.apply(await get<State>("state"));
      this.keysOf.clear(); // fields go back to what holds
      this.apply(this.state);
      return false;
    }
  }
  choose(change: Partial<Choices>): Promise<boolean> {
    return this.ask("choose", { choices: { ...this.state.choices, ...change } });
  }
  tell(message: string, bad = false): void {
    const box = byId("told");
    box.className = bad ? "notice bad" : "notice";
    box.replaceChildren(message, h("button", { class: "quiet", "aria-label": "Close this message", click: () => (box.hidden = true) }, "✕"));
    box.hidden = false;
  }
  show(finding: Finding): void {
    this.stage.show(finding);
    if (finding.section) this.keys.turnTo(finding.section);
    if (finding.places.length || finding.bodies.length) this.openTab("view");
    else if (finding.line) this.openTab("text");
    if (finding.line) this.toLine(finding.line);
  }
  openKeys(section: string): void {
    this.keys.turnTo(section);
    this.openTab("keys");
  }
  openTab(name: string): void {
    this.tab = name as Tab;
    this.tabs();
    this.keysOf.delete("keys-form");
    this.apply(this.state);
  }

  // From the state to the page

  /** Builds a panel anew where what it shows has changed, and keeps the focus. */
  private panel(id: string, key: string, children: (Node | string | null | false)[], always = false): void {
    if (!always && this.keysOf.get(id) === key) return;
    this.keysOf.set(id, key);
    const focused = document.activeElement?.id, open = [...byId(id).querySelectorAll("details")].map((d) => d.open);
    byId(id).replaceChildren(...children.filter((c): c is Node | string => c !== null && c !== false));
    byId(id).querySelectorAll("details").forEach((d, i) => (d.open = open[i] ?? d.open));
    if (focused && document.activeElement?.id !== focused) document.getElementById(focused)?.focus({ preventScroll: true });
  }

  apply(state: State): void {
    if (state.revision < this.state.revision && state.name === this.state.name) return;
    // A button that is held down is not built anew below the finger: the click would be lost.
    if (this.pressed) {
      if (!this.waiting || state.revision >= this.waiting.revision || state.name !== this.waiting.name) this.waiting = state;
      return;
    }
    const before = this.state;
    this.state = state;
    const busy = state.job !== null, s = state;
    this.stage.update(s);
    this.panel("part-panel", JSON.stringify([s.name, s.part, s.choices?.roles, s.choices?.unit, busy, this.stage.which, this.stage.picture.bodies.map((b) => b.name)]), this.setup.part(s));
    this.panel("casting-panel", JSON.stringify([s.part, s.choices, s.made, busy, s.thickest, s.preview, s.case?.file, (s.case?.document?.mesh as { riser?: unknown } | undefined)?.riser]), this.setup.casting(s));
    this.panel("check-panel", JSON.stringify([s.case?.digest, s.check, busy]), this.setup.check(s));
    this.panel("run-panel", JSON.stringify([!!s.case, busy, s.check?.current, s.check?.error]), this.judge.run(s));
    this.panel("runs-panel", JSON.stringify([s.runs, busy, s.job?.run]), this.judge.runs(s));
    this.panel("job", JSON.stringify([s.job, s.last]), this.judge.job(s));
    this.panel("compared-answers", JSON.stringify(s.compared), this.judge.compared(s));
    if (this.tab === "keys") this.panel("keys-form", JSON.stringify([s.case?.digest, busy]), this.keys.render(s));
    byId<HTMLButtonElement>("undo").disabled = busy || s.undo === 0;
    byId<HTMLButtonElement>("redo").disabled = busy || s.redo === 0;
    byId("name").textContent = s.name ?? "";
    document.title = `${s.name ? `${s.name} · ` : ""}Solidus`;
    this.frames(before);
    this.text(before);
    this.tabs();
  }

  /** Reports in frames; of a run that goes on its own page, which the program serves. */
  private frames(before: State): void {
    const s = this.state, live = byId<HTMLIFrameElement>("live-frame"), watch = s.job?.watch ?? "";
    if (watch && live.getAttribute("src") !== watch) live.src = watch;
    if (!watch && live.getAttribute("src")) live.removeAttribute("src");
    if (!watch && this.tab === "live") this.tab = this.lastRun ? "report" : "view";
    // A run that has ended shows its report by itself, also where this page has heard nothing of it while it went on.
    const { last } = s;
    if (last && last.number > this.endSeen) {
      this.endSeen = last.number;
      if (last.run) this.curvesOf = null;
      if (last.run && s.runs.find((r) => r.name === last.run)?.report) this.openReport(last.run);
    }
    if (s.compared && s.compared.tag !== before.compared?.tag) {
      byId<HTMLIFrameElement>("compared-frame").src = `compared/report?tag=${s.compared.tag}`;
      if (before.job?.what === "compare") this.tab = "compared";
    }
    if (this.tab === "curves" && s.job?.run) {
      const of = `${s.job.run} ${s.job.progress.step}`;
      if (of !== this.curvesOf) {
        this.curvesOf = of;
        void this.judge.draw(s.job.run);
      }
    }
    if (s.name !== before.name) {
      this.lastRun = null;
      byId("report-frame").removeAttribute("src");
      byId("compared-frame").removeAttribute("src");
    }
  }
  private openReport(run: string): void {
    this.lastRun = run;
    byId<HTMLIFrameElement>("report-frame").src = `run/${run}/report`;
    this.openTab("report");
  }

  private tabs(): void {
    const s = this.state, there: Record<Tab, boolean> = { view: true, live: !!s.job?.watch, report: !!this.lastRun, compared: !!s.compared, curves: s.runs.length > 0 || !!s.job?.run, keys: !!s.case, text: !!s.case };
    if (!there[this.tab]) this.tab = "view";
    const bar = byId("tabs"), key = JSON.stringify([there, this.tab]);
    for (const tab of TABS) byId(`tab-${tab}`).hidden = tab !== this.tab;
    if (bar.dataset.key === key) return;
    bar.dataset.key = key;
    const focused = document.activeElement?.id;
    bar.replaceChildren(...TABS.filter((t) => there[t]).map((t) => h("button", { id: `to-${t}-tab`, role: "tab", "aria-selected": String(t === this.tab), "aria-controls": `tab-${t}`, class: t === this.tab ? "on" : "", click: () => this.openTab(t) }, TAB_NAMES[t])));
    if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
    if (this.tab === "view") this.stage.picture.resize();
  }

  // The file as a text

  private textEditor(): void {
    byId("save-text").addEventListener("click", () => void this.ask("text", { text: byId<HTMLTextAreaElement>("file-text").value }).then((ok) => ok && this.tell("The file is saved.")));
    byId("revert-text").addEventListener("click", () => {
      byId<HTMLTextAreaElement>("file-text").value = this.state.case?.text ?? "";
      this.textChanged();
    });
    byId("file-text").addEventListener("input", () => this.textChanged());
  }
  private textChanged(): void {
    const changed = byId<HTMLTextAreaElement>("file-text").value !== (this.state.case?.text ?? "");
    byId<HTMLButtonElement>("save-text").disabled = !changed || !!this.state.job;
    byId<HTMLButtonElement>("revert-text").disabled = !changed;
  }
  /** What another page or an editor has changed is shown, unless something is being typed here. */
  private text(before: State): void {
    const area = byId<HTMLTextAreaElement>("file-text"), own = before.case?.text ?? "", now = this.state.case?.text ?? "";
    if (area.value === own || before.name !== this.state.name || !this.keysOf.has("text")) area.value = now;
    this.keysOf.set("text", "");
    byId("file-name").textContent = this.state.case?.file ?? "";
    this.textChanged();
  }
  private toLine(line: number): void {
    const area = byId<HTMLTextAreaElement>("file-text"), lines = area.value.split("\n");
    const start = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0);
    area.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
    area.scrollTop = Math.max(0, (line - 6) * 19);
    if (this.tab === "text") area.focus({ preventScroll: true });
  }

  // Head, files, keys

  private head(): void {
    const root = document.documentElement;
    byId("theme").addEventListener("click", () => {
      root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
      localStorage.setItem("solidus-theme", root.dataset.theme);
      this.stage.picture.recolour();
    });
    byId("undo").addEventListener("click", () => void this.ask("undo"));
    byId("redo").addEventListener("click", () => void this.ask("redo"));
    byId("version").textContent = `Solidus ${this.about.version}`;
    byId("fit").addEventListener("click", () => this.stage.picture.fit());
    byId("elements").addEventListener("click", () => {
      const on = this.stage.picture.toggleElements();
      byId("elements").setAttribute("aria-pressed", String(on));
      byId("elements").className = on ? "on" : "";
    });
    const keys: [string, string][] = [["F", "fit the picture"], ["1 … 6", "look along an axis"], ["7", "look from a corner"], ["M", "edges of elements"], ["Ctrl Z", "undo"], ["Ctrl Y", "do again"], ["T", "dark, light"], ["Esc", "take marks away"], ["?", "this list"]];
    byId("help").addEventListener("click", () => {
      const dialog = byId<HTMLDialogElement>("dialog");
      dialog.replaceChildren(h("h3", {}, "Keys"), h("dl", { class: "keys" }, ...keys.flatMap(([key, text]) => [h("dt", {}, ...key.split(" ").map((k) => h("kbd", {}, k))), h("dd", {}, text)])),
        h("p", { class: "hint" }, "Drag turns the picture, with Shift or the right button it moves it; the wheel zooms. A click on the part says what can be placed there."), h("form", { method: "dialog" }, h("button", {}, "Close")));
      dialog.showModal();
    });
  }
  private dropping(): void {
    const input = byId<HTMLInputElement>("file");
    const load = (file?: File | null) => {
      if (!file) return;
      this.tell(`${file.name} is brought into the folder …`);
      upload(file).then((state) => { byId("told").hidden = true; this.apply(state); }, (error: Error) => this.tell(error.message, true));
    };
    input.addEventListener("change", () => { load(input.files?.[0]); input.value = ""; });
    byId("empty-load").addEventListener("click", () => input.click());
    addEventListener("dragover", (e) => { e.preventDefault(); document.body.classList.add("dropping"); });
    addEventListener("dragleave", (e) => { if (!e.relatedTarget) document.body.classList.remove("dropping"); });
    addEventListener("drop", (e) => { e.preventDefault(); document.body.classList.remove("dropping"); load(e.dataTransfer?.files[0]); });
  }
  /** Holds back what would build buttons and fields anew while one of them is pressed. */
  private presses(): void {
    addEventListener("pointerdown", (e) => {
      this.pressed = e.target instanceof Element && !!e.target.closest("button, select, input, textarea, summary, label");
    }, true);
    const up = () => setTimeout(() => {
      // The click comes behind the release, and its own change goes before what has waited.
      if (!this.pressed) return;
      this.pressed = false;
      const { waiting } = this;
      this.waiting = null;
      if (waiting) this.apply(waiting);
    });
    for (const name of ["pointerup", "pointercancel", "dragend", "change"]) addEventListener(name, up, true);
    // The list of a choice takes the release for itself: the first movement without a button tells it, or the page is left.
    addEventListener("pointermove", (e) => e.buttons === 0 && up(), true);
    addEventListener("blur", (e) => e.target === window && up());
  }
  private shortcuts(): void {
    const views: Record<string, [number, number, number]> = { "1": [1, 0, 0], "2": [-1, 0, 0], "3": [0, 1, 0], "4": [0, -1, 0], "5": [0, 0, 1], "6": [0, 0, -1], "7": this.stage.picture.camera.corner };
    addEventListener("keydown", (e) => {
      const typing = e.target instanceof HTMLElement && e.target.matches("input, select, textarea");
      if (typing || document.querySelector("dialog[open]")) return;
      const key = e.key.toLowerCase();
      if (e.ctrlKey || e.metaKey) {
        if (key === "z" && !e.shiftKey) byId("undo").click();
        else if (key === "y" || (key === "z" && e.shiftKey)) byId("redo").click();
        else return;
        e.preventDefault();
        return;
      }
      if (views[key]) this.stage.picture.look(views[key]);
      else if (key === "f") this.stage.picture.fit();
      else if (key === "m") byId("elements").click();
      else if (key === "t") byId("theme").click();
      else if (key === "?") byId("help").click();
      else if (key === "escape") this.stage.clear();
    });
  }

  /** Follows the server for as long as it is there. */
  async follow(): Promise<never> {
    for (let lost = false; ; ) {
      try {
        const state = await get<State>(`state?known=${this.state.revision}`);
        if (lost) byId("told").hidden = true;
        lost = false;
        this.apply(state);
        // What changes fast is shown ten times a second at most.
        await new Promise((r) => setTimeout(r, state.job ? 300 : 100));
      } catch {
        if (!lost) this.tell("The server has ended: `solidus open` starts it again, at a new address.", true);
        lost = true;
        await new Promise((r) => setTimeout(r, 2000));
      }
    }
  }
}

const kept = localStorage.getItem("solidus-theme");
document.documentElement.dataset.theme = kept ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
Promise.all([get<About>("about"), get<State>("state")]).then(([about, state]) => {
  const bench = new Bench(about, state);
  bench.apply(state);
  performance.mark("built");
  (window as unknown as { solidus: unknown }).solidus = bench;
  return bench.follow();
}).catch((error: unknown) => {
  const box = byId("failure");
  box.hidden = false;
  box.textContent = `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
});
