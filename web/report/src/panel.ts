/** The panel next to the pictures: what is drawn, of which bodies, how far displaced, where cut and from where seen. */
import { Vector3 } from "three";
import { MAPS } from "./colours";
import { byId, h, save } from "./dom";
import { short, withUnit } from "./quantities";
import type { Shown } from "./view";
import type { Workbench } from "./workbench";

type Part = (title: string, refresh: () => void, ...children: (Node | null)[]) => void;

export class Panel {
  private readonly parts: (() => void)[] = [];
  /** Moves the cut by so many of the 400 steps of its slider. */
  moveCut: (by: number) => void = () => {};

  constructor(private readonly bench: Workbench) {
    const panel = byId("panel"), c = this.bench.choice;
    const part: Part = (title, refresh, ...children) => {
      panel.append(h("fieldset", {}, h("legend", {}, title), ...children));
      this.parts.push(refresh);
    };
    this.fieldPart(part);
    this.bodiesPart(part);
    if (this.bench.run.displacement.length) this.deformationPart(part);
    if (this.bench.run.axisymmetric) {
      const turns: [string, number][] = [["Section", 0], ["½", Math.PI], ["¾", 1.5 * Math.PI], ["Full", 2 * Math.PI]];
      const buttons = turns.map(([text, angle]) => h("button", { click: () => {
        const wasFlat = this.bench.flat;
        this.bench.change((ch) => (ch.revolved = angle));
        if (wasFlat !== this.bench.flat) this.bench.camera.turn.identity();
        this.bench.fit();
      } }, text));
      part("Turned about the axis", () => buttons.forEach((b, i) => b.classList.toggle("on", turns[i][1] === c.revolved)), h("div", { class: "choice" }, ...buttons));
    }
    if (this.bench.run.dimension === 3) this.cutPart(part);
    this.onlyPart(part);
    this.viewPart(part);
  }

  private fieldPart(part: Part): void {
    const c = this.bench.choice;
    const select = h("select", { id: "field", "aria-label": "Field", change: () => this.bench.setField(select.value) });
    const groups = new Map<string, HTMLOptGroupElement>();
    for (const f of this.bench.fields()) {
      if (!groups.has(f.group)) groups.set(f.group, h("optgroup", { label: f.group }));
      groups.get(f.group)!.append(h("option", { value: f.id }, f.label));
    }
    for (const name of ["Heat", "Mechanics", "Contact", "Criteria", "Other"]) if (groups.has(name)) select.append(groups.get(name)!);
    const map = h("select", { "aria-label": "Colours", change: () => this.bench.change((ch) => (ch.map = map.value)) }, ...MAPS.map((m) => h("option", { value: m }, m)));
    const bands = h("select", { "aria-label": "Bands", change: () => this.bench.change((ch) => (ch.bands = +bands.value)) }, ...[["0", "smooth"], ["6", "6 bands"], ["10", "10 bands"], ["16", "16 bands"]].map(([v, t]) => h("option", { value: v }, t)));
    const low = h("input", { type: "number", step: "any", "aria-label": "Least of the scale" }), high = h("input", { type: "number", step: "any", "aria-label": "Greatest of the scale" });
    const set = () => {
      const unit = this.bench.field!.unit;
      const l = (+low.value - unit.offset) / unit.scale, u = (+high.value - unit.offset) / unit.scale;
      if (!(l < u)) return;
      this.bench.fixedRange = true;
      this.bench.change((ch) => {
        ch.low = l;
        ch.high = u;
      });
    };
    low.addEventListener("change", set);
    high.addEventListener("change", set);
    const how = ["Run", "Moment"].map((text, i) => h("button", { title: i ? "Scale of the present moment" : "Scale of the whole run", click: () => {
      this.bench.fixedRange = false;
      this.bench.ofMoment = i === 1;
      this.bench.scaleChosen = true;
      this.bench.update();
    } }, text));
    const log = h("input", { type: "checkbox", change: () => this.bench.change((ch) => (ch.log = log.checked)) });
    part("Field", () => {
      select.value = c.field;
      map.value = c.map;
      bands.value = String(c.bands);
      const unit = this.bench.field?.unit ?? { scale: 1, offset: 0, text: "" };
      if (document.activeElement !== low) low.value = String(+(c.low * unit.scale + unit.offset).toPrecision(5));
      if (document.activeElement !== high) high.value = String(+(c.high * unit.scale + unit.offset).toPrecision(5));
      how.forEach((b, i) => b.classList.toggle("on", !this.bench.fixedRange && this.bench.ofMoment === (i === 1)));
      log.checked = c.log;
      log.disabled = !(c.low > 0) || unit.offset !== 0;
    },
    h("div", { class: "row" }, select), h("div", { class: "row" }, map, bands),
    h("div", { class: "two" }, h("label", {}, "from", low), h("label", {}, "to", high)),
    h("div", { class: "row" }, h("div", { class: "choice" }, ...how), h("label", {}, log, " log")));
  }

  private bodiesPart(part: Part): void {
    const names = [...new Set(this.bench.runs.flatMap((r) => r.bodies.map((b) => b.name)))];
    const states: [Shown, string][] = [["shown", "Show"], ["ghost", "Ghost"], ["hidden", "Hide"]];
    const rows = names.map((name) => {
      const buttons = states.map(([state, text]) => h("button", { "data-body": name, "data-state": state, click: () => {
        const before = this.bench.extents();
        this.bench.change((ch) => ch.shown.set(name, state));
        if (this.bench.extents() !== before) this.bench.fit();
      } }, text));
      const material = this.bench.runs.flatMap((r) => r.bodies).find((b) => b.name === name)?.material ?? "";
      return { name, buttons, row: h("div", {}, h("span", { title: `${name}: ${material}` }, name), h("div", { class: "choice" }, ...buttons)) };
    });
    part("Bodies", () => {
      for (const { name, buttons } of rows)
        buttons.forEach((b, i) => b.classList.toggle("on", (this.bench.choice.shown.get(name) ?? "shown") === states[i][0]));
    }, h("div", { class: "bodies" }, ...rows.map((r) => r.row)));
  }

  private deformationPart(part: Part): void {
    const slider = h("input", { type: "range", min: 0, max: 100, "aria-label": "Scale of displacements", id: "scale" });
    const output = h("output");
    const factors = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
    slider.max = String(factors.length - 1);
    slider.addEventListener("input", () => this.bench.change((ch) => (ch.scale = factors[+slider.value])));
    part("Displacements", () => {
      const i = factors.reduce((best, f, k) => (Math.abs(f - this.bench.choice.scale) < Math.abs(factors[best] - this.bench.choice.scale) ? k : best), 0);
      slider.value = String(i);
      output.textContent = this.bench.choice.scale === 0 ? "none" : `× ${this.bench.choice.scale}`;
    }, h("div", { class: "row" }, slider, output));
  }

  private cutPart(part: Part): void {
    const c = this.bench.choice.cut;
    const on = h("input", { type: "checkbox", id: "cut", change: () => this.bench.change(() => (c.on = on.checked)) });
    const slider = h("input", { type: "range", min: 0, max: 400, "aria-label": "Place of the cut", id: "cutat" });
    const output = h("output");
    const span = () => {
      let low = Infinity, high = -Infinity;
      const [ex, ey, ez] = [this.bench.extent(0), this.bench.extent(1), this.bench.extent(2)];
      for (const x of ex) for (const y of ey) for (const z of ez) {
        const d = c.normal[0] * x + c.normal[1] * y + c.normal[2] * z;
        low = Math.min(low, d);
        high = Math.max(high, d);
      }
      return [low, high];
    };
    const at = () => {
      const [low, high] = span();
      c.at = low + (high - low) * (0.002 + 0.996 * (+slider.value / 400));
    };
    slider.addEventListener("input", () => this.bench.change(() => {
      at();
      c.on = true;
    }));
    const normals: [string, () => [number, number, number]][] = [
      ["x", () => [1, 0, 0]], ["y", () => [0, 1, 0]], ["z", () => [0, 0, 1]],
      ["screen", () => new Vector3(0, 0, 1).applyQuaternion(this.bench.camera.turn).toArray() as [number, number, number]],
    ];
    let chosen = "z";
    const buttons = normals.map(([text, normal]) => h("button", { title: text === "screen" ? "Through the middle, along the screen" : `Across ${text}`, click: () => this.bench.change(() => {
      chosen = text;
      c.normal = normal();
      slider.value = "200";
      at();
      c.on = true;
    }) }, text));
    const flip = h("button", { title: "Show the other side", click: () => this.bench.change(() => {
      c.normal = c.normal.map((v) => -v) as [number, number, number];
      c.at = -c.at;
      c.on = true;
    }) }, "flip");
    this.moveCut = (by) => {
      const [low, high] = span();
      slider.value = String(Math.round((400 * (c.at - low)) / (high - low)) + by);
      slider.dispatchEvent(new Event("input"));
    };
    part("Cut", () => {
      on.checked = c.on;
      const [low, high] = span();
      slider.value = String(Math.round((400 * (c.at - low)) / (high - low)));
      buttons.forEach((b, i) => b.classList.toggle("on", c.on && normals[i][0] === chosen));
      const sign = Math.sign(c.normal.reduce((a, b) => a + b, 0)) || 1;
      const at = Math.abs(c.at) < 1e-5 * (high - low) ? 0 : chosen === "screen" ? c.at : sign * c.at;
      output.textContent = `${short(1e3 * at)} mm`;
    }, h("div", { class: "row" }, h("label", {}, on, " on"), h("div", { class: "choice" }, ...buttons), flip), h("div", { class: "row" }, slider, output));
  }

  private onlyPart(part: Part): void {
    const o = this.bench.choice.only;
    const on = h("input", { type: "checkbox", id: "only", change: () => this.bench.change(() => {
      o.on = on.checked;
      const view = this.bench.stages[0].view, [low, high] = view.field?.rangeAt(this.bench.shownBodies(view.run), view.moment) ?? [0, 1];
      if (o.on) [o.low, o.high] = [low + 0.5 * (high - low), high];
    }) });
    const low = h("input", { type: "range", min: 0, max: 500, "aria-label": "Least value shown", id: "onlylow" });
    const high = h("input", { type: "range", min: 0, max: 500, "aria-label": "Greatest value shown" });
    const outLow = h("output"), outHigh = h("output");
    const value = (s: HTMLInputElement) => this.bench.choice.low + (+s.value / 500) * (this.bench.choice.high - this.bench.choice.low);
    const set = () => this.bench.change(() => {
      o.on = true;
      o.low = Math.min(value(low), value(high));
      o.high = Math.max(value(low), value(high));
    });
    low.addEventListener("input", set);
    high.addEventListener("input", set);
    const has = (id: string) => this.bench.fields().some((f) => f.id === id);
    const preset = (text: string, title: string, field: string, range: (r: [number, number]) => [number, number]) =>
      has(field) ? h("button", { title, click: () => {
        this.bench.setField(field);
        this.bench.change((c) => {
          [o.low, o.high] = range([c.low, c.high]);
          o.on = true;
        });
      } }, text) : null;
    part("Only values between", () => {
      on.checked = o.on;
      const share = (v: number) => String(Math.round((500 * (v - this.bench.choice.low)) / (this.bench.choice.high - this.bench.choice.low)));
      low.value = o.on ? share(o.low) : "0";
      high.value = o.on ? share(o.high) : "500";
      const unit = this.bench.field?.unit;
      outLow.textContent = o.on && unit ? withUnit(o.low, unit) : "";
      outHigh.textContent = o.on && unit ? withUnit(o.high, unit) : "";
    },
    h("div", { class: "row" }, h("label", {}, on, " on"), low, outLow), h("div", { class: "row" }, h("label", { style: "visibility:hidden" }, "☐ on"), high, outHigh),
    h("div", { class: "presets" },
      preset("Still liquid", "Where less than half has frozen at this moment", "solid_fraction", () => [0, 0.5]),
      preset("Mushy", "Between liquid and solid at this moment", "solid_fraction", () => [0.01, 0.99]),
      preset("Last to freeze", "What froze in the last tenth of the time: hot spots", "solidified_at", ([l, u]) => [l + 0.9 * (u - l), u]),
      preset("Low Niyama", "The lowest tenth of the range on a scale of logarithms: poor feeding", "niyama", ([l, u]) => [l, l > 0 ? l * (u / l) ** 0.1 : l + 0.02 * (u - l)]),
      preset("Pores", "Where more than a tenth of the densest pores has opened at this moment", "pore_fraction", ([, u]) => [0.1 * u, u]),
      preset("Open gap", "Where casting and mould are apart by more than a tenth of the widest gap", "gap", ([, u]) => [0.1 * u, u])));
  }

  private viewPart(part: Part): void {
    const mesh = h("input", { type: "checkbox", id: "mesh", change: () => this.bench.change((c) => (c.mesh = mesh.checked)) });
    const directions: [string, [number, number, number]][] = [
      ["+x", [1, 0, 0]], ["−x", [-1, 0, 0]], ["+y", [0, 1, 0]], ["−y", [0, -1, 0]], ["+z", [0, 0, 1]], ["−z", [0, 0, -1]], ["Corner", this.bench.camera.corner],
    ];
    const solid = this.bench.run.dimension === 3 || this.bench.run.axisymmetric;
    part("View", () => (mesh.checked = this.bench.choice.mesh),
      h("div", { class: "views" }, ...(solid ? directions.map(([text, d]) => h("button", { click: () => this.bench.look(d) }, text)) : []), h("button", { click: () => this.bench.fit(), title: "Everything in sight (F)" }, "Fit")),
      h("div", { class: "row" }, h("label", {}, mesh, " elements"), h("span", { style: "flex:1" }),
        h("button", { class: "quiet", title: "Save the picture", click: () => this.bench.stages.forEach((s) => {
          s.view.render();
          s.view.canvas.toBlob((b) => b && save(`${s.view.run.meta.name.replace(/\W+/g, "_")}.png`, b));
        }) }, "PNG"), h("button", { class: "quiet", title: "Take marks and lines away (Esc)", click: () => this.bench.clearMarks() }, "clear marks")),
      h("p", { class: "hint" }, "Click: curves of a node. Shift-click: values along the line from the last click. ? lists the keys."));
  }

  /** Shows what has been chosen. */
  refresh(): void {
    for (const part of this.parts) part();
  }
}
