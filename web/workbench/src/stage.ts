/** The picture with what lies over it, what the pointer does to it, and what can be placed where one clicks. */
import { byId, h, svg } from "../../report/src/dom";
import { Vector3 } from "three";
import { Picture, type Pick, type Shown } from "./scene";
import { addCondition, KINDS, placedInCase, refusal } from "./conditions";
import { chillAt, freeName, gatingAt, looksAside, looksUp, probeAt, riserAt, riserBeside, thickness } from "./placing";
import { bytes, type Desk, type Finding, type Place, type State } from "./state";
import { cross, unpack, type SkinBody } from "./skin";

const mm = (v: number) => `${Math.round(v * 1e4) / 10}`;
const placeText = (p: Place) => `(${p.map(mm).join(", ")}) mm`;

interface Mark { at: Place; label: string; kind: string }

export class Stage {
  readonly picture = new Picture();
  /** Which skin is shown: that of the part, or of the bodies of the case. */
  which: "part" | "case" = "part";
  /** What the choices placed when they were seen last. */
  private placed = "";
  private readonly root = byId("stage");
  private readonly over = svg("svg", { class: "marks", "aria-hidden": "true" });
  private readonly axes = svg("svg", { class: "axes", viewBox: "-40 -40 80 80", "aria-hidden": "true" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly card = h("div", { class: "place-card", role: "dialog", "aria-label": "What is placed here", hidden: true });
  private found: Mark[] = [];
  private lit: string[] = [];
  private readonly shown: Record<string, Shown> = {};
  private tags: Record<string, string> = {};
  private loading = "";
  private hovering = 0;

  constructor(private readonly desk: Desk) {
    this.root.prepend(this.picture.canvas, this.over, this.axes, this.tip, this.card);
    if (!this.picture.canDraw) this.root.append(h("p", { class: "no-picture", id: "no-picture" }, "This browser has no WebGL, and so there is no picture. All else works: a riser is put on the highest place and moved by typing, and the forms have every key."));
    this.picture.drawn = () => this.overlay();
    this.pointers();
    new ResizeObserver(() => this.picture.resize()).observe(this.root);
  }

  /** Brings the picture to a state: skins that are new are fetched. */
  update(state: State): void {
    const has = (name: string) => state.skins[name] !== undefined;
    if (this.tags.case !== state.skins.case && has("case")) this.which = "case";
    else if (this.tags.part !== state.skins.part && has("part") && !has("case")) this.which = "part";
    // What is placed or moved is seen on the part: the bodies of the case are those from before.
    const placed = state.choices ? JSON.stringify([state.name, state.choices.risers, state.choices.chills, state.choices.gatings, state.choices.probes, state.choices.gate, state.choices.symmetry]) : "";
    if (this.placed && this.placed !== placed && this.placed.startsWith(`["${state.name}"`) && state.made === false && has("part")) this.which = "part";
    this.placed = placed;
    if (!has(this.which)) this.which = has("part") ? "part" : "case";
    this.tags = { ...state.skins };
    const tag = has(this.which) ? `${state.name}/${this.which}/${state.skins[this.which]}` : "";
    byId("empty").hidden = tag !== "" || !!state.name;
    if (tag !== this.loading) void this.load(tag);
    this.dress();
    this.switches();
  }

  private async load(tag: string): Promise<void> {
    const before = this.loading;
    this.loading = tag;
    // The picture of another part must not take clicks that are meant for this one.
    if (before.split("/")[0] !== tag.split("/")[0]) this.picture.load([], false);
    this.found = [];
    this.lit = [];
    this.close();
    try {
      const bodies = tag ? unpack(await bytes(`skin/${this.which}`)) : [];
      if (this.loading !== tag) return;
      const fit = before.split("/").slice(0, 2).join() !== tag.split("/").slice(0, 2).join();
      this.picture.load(bodies, fit);
      this.dress();
      this.switches();
      performance.mark("drawn");
    } catch (error) {
      this.desk.tell(`the picture cannot be shown: ${error instanceof Error ? error.message : error}`, true);
    }
  }

  /** Roles of the bodies: those of the case, or those chosen for the part. */
  roles(): Record<string, string> {
    const { state } = this.desk, out: Record<string, string> = {};
    if (this.which === "case") {
      for (const body of bodiesOf(state)) out[body.name] = body.role;
      return out;
    }
    for (const body of this.picture.bodies) out[body.name] = state.choices?.roles[body.name] || roleByName(body.name);
    return out;
  }

  dress(): void {
    const roles = this.roles(), shown: Record<string, Shown> = {};
    for (const { name } of this.picture.bodies) shown[name] = this.shown[name] ?? (["mould", "die"].includes(roles[name]) ? "ghost" : "shown");
    this.picture.dress(roles, shown, this.lit);
    this.picture.place(this.which === "part" ? this.desk.state.choices : null, this.which === "part" ? this.desk.state.preview : null);
  }

  /** Which skin, and how each body is shown. */
  private switches(): void {
    const { state } = this.desk, roles = this.roles();
    const which = byId("which");
    which.hidden = state.skins.part === undefined || state.skins.case === undefined;
    which.replaceChildren(...(["part", "case"] as const).map((name) =>
      h("button", { class: this.which === name ? "on" : "", "aria-pressed": String(this.which === name), id: `which-${name}`, click: () => this.turnTo(name) },
        name === "part" ? "Part" : "Bodies in the mould")));
    byId("bodies").replaceChildren(...this.picture.bodies.map(({ name }, b) => {
      const now = this.shown[name] ?? (["mould", "die"].includes(roles[name]) ? "ghost" : "shown");
      return h("div", {},
        h("span", { title: name }, h("i", { class: `role ${roles[name] || "other"}` }), `${name}${roles[name] && roles[name] !== name ? ` · ${roles[name]}` : ""}`),
        h("span", { class: "choice", role: "group", "aria-label": `How ${name} is shown` }, ...(["shown", "ghost", "hidden"] as const).map((to) =>
          h("button", { class: now === to ? "on" : "", "aria-pressed": String(now === to), id: `show-${b}-${to}`, click: () => this.showBody(name, to) },
            { shown: "solid", ghost: "glass", hidden: "off" }[to]))));
    }));
  }
  private showBody(name: string, to: Shown): void {
    this.shown[name] = to;
    this.dress();
    this.switches();
  }
  turnTo(name: "part" | "case"): void {
    if (this.which === name) return;
    this.which = name;
    this.update(this.desk.state);
  }

  /** Lights up bodies and places of a finding; the eye goes to the first place. */
  show(finding: Finding): void {
    const { state } = this.desk;
    if (this.which !== "case" && state.skins.case !== undefined) this.turnTo("case");
    this.lit = finding.bodies;
    this.found = finding.places.map((at, i) => ({ at, label: finding.places.length > 1 ? `${i + 1}` : "here", kind: "find" }));
    this.dress();
    if (finding.places.length) this.picture.fly(finding.places[0]);
    this.picture.request();
  }
  clear(): void {
    this.lit = [];
    this.found = [];
    this.close();
    this.dress();
  }

  private pointers(): void {
    const canvas = this.picture.canvas, camera = this.picture.camera, down = new Map<number, [number, number]>();
    let moved = 0, spread = 0;
    const where = (e: PointerEvent | WheelEvent): [number, number] => {
      const box = canvas.getBoundingClientRect();
      return [e.clientX - box.left, e.clientY - box.top];
    };
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      down.set(e.pointerId, where(e));
      this.picture.held = true;
      moved = spread = 0;
      this.root.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (e) => {
      const at = where(e), before = down.get(e.pointerId);
      if (!before) return this.hover(at);
      const dx = at[0] - before[0], dy = at[1] - before[1];
      down.set(e.pointerId, at);
      moved += Math.abs(dx) + Math.abs(dy);
      if (down.size === 2) {
        const [p, q] = [...down.values()], now = Math.hypot(p[0] - q[0], p[1] - q[1]);
        if (spread > 0) camera.zoom(spread / now, 0, 0, 1);
        spread = now;
        camera.pan(dx / 2, dy / 2, canvas.clientHeight);
      } else if (moved > 3) {
        if (e.shiftKey || e.buttons === 2 || e.buttons === 4) camera.pan(dx, dy, canvas.clientHeight);
        else camera.rotate(dx, dy);
      }
      this.picture.request(true);
    });
    const up = (e: PointerEvent) => {
      const single = down.size === 1;
      down.delete(e.pointerId);
      this.picture.held = down.size > 0;
      this.picture.request(this.picture.held);
      if (e.type === "pointerup" && single && moved <= 4 && e.button === 0) this.clicked(where(e));
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("pointerleave", () => {
      cancelAnimationFrame(this.hovering);
      this.tip.hidden = true;
    });
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      const [x, y] = where(e), w = canvas.clientWidth, t = canvas.clientHeight;
      camera.zoom(Math.exp(Math.max(-60, Math.min(60, e.deltaY)) * 0.004), (2 * x) / w - 1, 1 - (2 * y) / t, w / t);
      this.picture.request(true);
    }, { passive: false });
  }

  private hover(at: [number, number]): void {
    cancelAnimationFrame(this.hovering);
    this.hovering = requestAnimationFrame(() => {
      const hit = this.picture.pick(...at);
      this.tip.hidden = !hit;
      if (!hit) return;
      this.tip.replaceChildren(h("b", {}, this.picture.bodies[hit.body].name), h("span", {}, placeText(hit.place)));
      const right = at[0] > this.picture.canvas.clientWidth - 190;
      this.tip.style.transform = `translate(${right ? at[0] - 12 : at[0] + 14}px, ${at[1] + 14}px)${right ? " translateX(-100%)" : ""}`;
    });
  }

  private clicked(at: [number, number]): void {
    const hit = this.picture.pick(...at);
    this.found = this.found.filter((m) => m.kind !== "point");
    if (!hit) return this.clear();
    this.found.push({ at: hit.place, label: "", kind: "point" });
    this.picture.point(hit);
    this.offer(hit, at);
  }

  /** The card that says what was clicked and what can be placed there. */
  private offer(hit: Pick, at: [number, number]): void {
    const body = this.picture.bodies[hit.body], face = body.faces[hit.triangle], thick = thickness(body, hit), { state } = this.desk;
    const button = (id: string, text: string, why: string, act: () => void) =>
      h("button", { id: `place-${id}`, disabled: why !== "", title: why, click: () => { this.close(); act(); } }, text);
    const busy = state.job ? "wait for what is computed" : "", onPart = state.choices ? busy : "the part is not next to the case";
    const now = () => this.desk.state.choices!;
    this.card.replaceChildren(
      h("p", {}, h("b", {}, body.name), face > 0 ? ` · face ${face}` : "", h("br"), placeText(hit.place), h("br"), `${mm(thick)} mm of it below`),
      h("div", { class: "buttons" },
        ...(this.which === "part" ? [
          looksAside(hit)
            ? button("beside", "Riser next to it", onPart, () => void this.desk.choose({ riser: "placed", risers: [...now().risers, riserBeside(body, hit, freeName("riser", now().risers))] }))
            : button("riser", "Riser here", onPart || (looksUp(hit) ? "" : "a riser stands upright: click a face that looks up, or to the side"), () =>
              void this.desk.choose({ riser: "placed", risers: [...now().risers, riserAt(body, hit, freeName("riser", now().risers))] })),
          button("gating", "Gating here", onPart || (looksAside(hit) ? "" : "a runner is level: click a face that looks to the side"), () => this.gating(body, hit)),
          button("chill", "Chill here", onPart, () => void this.desk.choose({ riser: "placed", chills: [...now().chills, chillAt(body, hit, freeName("chill", now().chills))] })),
          button("probe", "Probe inside", onPart, () => this.probe(body, hit)),
          this.halve(hit, button, onPart),
          button("gate", "Gate here", onPart, () => void this.desk.choose({ gate: hit.place })),
        ] : [
          button("probe", "Probe inside", busy, () => this.probe(body, hit)),
          h("small", { class: "hint" }, "On this face, in addition to what acts there:"),
          ...KINDS.map((kind) => button(kind.id, kind.text, refusal(kind, hit, state), () => void addCondition(this.desk, kind, body.name, hit))),
        ]),
        h("button", { class: "quiet", id: "place-close", click: () => this.clear() }, "Close")),
    );
    this.card.hidden = false;
    const wide = 240, x = Math.min(at[0] + 14, Math.max(8, this.picture.canvas.clientWidth - wide - 8));
    const y = Math.min(at[1] + 14, Math.max(8, this.picture.canvas.clientHeight - this.card.offsetHeight - 8));
    this.card.style.transform = `translate(${x}px, ${y}px)`;
  }
  /** Symmetry by a face: the part is halved in its middle, parallel to the face, or made whole again. */
  private halve(hit: Pick, button: (id: string, text: string, why: string, act: () => void) => HTMLElement, why: string): HTMLElement {
    const axis = [0, 1, 2].find((i) => Math.abs(hit.normal[i]) > 0.9998), now = this.desk.state.choices?.symmetry ?? "";
    if (axis !== undefined && "xyz"[axis] === now) return button("symmetry", "Whole again", why, () => void this.desk.choose({ symmetry: "" }));
    return button("symmetry", "Halve parallel to it", why || (axis === undefined ? "a plane of symmetry is normal to an axis: click a flat face that is" : ""),
      () => void this.desk.choose({ symmetry: "xyz"[axis!] }));
  }
  /** A probe of the part is kept for the case that is made of it; one of the case goes into its file. */
  private probe(body: Parameters<typeof probeAt>[0], hit: Pick): void {
    const { state } = this.desk, probes = state.choices?.probes ?? [];
    if (this.which === "part") {
      void this.desk.choose({ probes: [...probes, probeAt(body, hit, freeName("T", probes))] });
      return;
    }
    const own = (state.case?.document?.probe ?? []) as { name: string }[], at = probeAt(body, hit, freeName("T", own));
    const point = at.point.map((v) => `${Math.round(v * 1e7) / 1e4} mm`);
    void this.desk.ask("add", { sections: [{ path: ["probe"], values: { name: at.name, kind: "point", field: "temperature", unit: "degC", point } }] });
  }
  private gating(body: SkinBody, hit: Pick): void {
    const c = this.desk.state.choices!;
    void this.desk.choose({ gatings: [...c.gatings, gatingAt(this.picture.bodies, body, hit, c.riser === "placed" ? c.risers : [], freeName("gating", c.gatings))] });
  }
  /** Gating at the middle of the side of largest x, for hands on a keyboard. */
  gatingAside(): void {
    const body = this.ofPart();
    if (!body) return;
    const [, y, z] = [0, 1, 2].map((i) => (body.low[i] + body.high[i]) / 2), far = body.high[0] - body.low[0];
    const hit = cross(body, [body.high[0] + far, y, z], [-1, 0, 0], 0);
    if (!hit) return this.desk.tell("The part has no metal at the middle of its side: click a face.", true);
    this.gating(body, { ...hit, normal: [1, 0, 0], body: this.picture.bodies.indexOf(body) });
  }
  /** The casting of the picture of the part; where another picture is shown that is told. */
  private ofPart(): SkinBody | undefined {
    const c = this.desk.state.choices, body = this.picture.bodies.find((b) => (c?.roles[b.name] || roleByName(b.name)) === "casting") ?? this.picture.bodies[0];
    if (c && body && this.which === "part") return body;
    this.desk.tell("Turn to the picture of the part first.", true);
    return undefined;
  }
  /** A riser on the highest place of the part, for hands on a keyboard. */
  riserOnTop(): void {
    const c = this.desk.state.choices, body = this.ofPart();
    if (!c || !body) return;
    let top = 0;
    for (let v = 2; v < body.position.length; v += 3) if (body.position[v] > body.position[3 * top + 2]) top = (v - 2) / 3;
    const place = [0, 1, 2].map((i) => body.position[3 * top + i]) as Place;
    const hit = { place, normal: [0, 0, 1] as Place, triangle: 0, far: 0, body: this.picture.bodies.indexOf(body) };
    void this.desk.choose({ riser: "placed", risers: [...c.risers, riserAt(body, hit, freeName("riser", c.risers))] });
  }
  close(): void {
    this.card.hidden = true;
    this.found = this.found.filter((m) => m.kind !== "point");
    this.picture.point();
  }

  private overlay(): void {
    if (this.picture.canvas.clientWidth < 2) return; // behind another tab: drawn when it is turned to
    const c = this.desk.state?.choices, marks = [...this.found];
    if (c && this.which === "part") {
      if (c.riser === "placed") {
        for (const r of c.risers) marks.push({ at: [r.foot[0], r.foot[1], r.foot[2] + r.height], label: r.name, kind: "name" });
        for (const k of c.chills) marks.push({ at: [0, 1, 2].map((i) => (k.lowest[i] + k.highest[i]) / 2) as Place, label: k.name, kind: "name" });
      }
      for (const g of c.gatings) marks.push({ at: g.sprue, label: g.name, kind: "name" });
      for (const p of c.probes) marks.push({ at: p.point, label: p.name, kind: "name" });
      if (c.gate) marks.push({ at: c.gate, label: "gate", kind: "name" });
    }
    if (this.desk.state && this.which === "case") marks.push(...placedInCase(this.desk.state).map((mark) => ({ ...mark, kind: "name" })));
    // A name that would lie on another one moves down until it does not, with a line to its place.
    const taken: [number, number, number][] = [];
    const below = (x: number, y: number, label: string): number => {
      const wide = 7.5 * label.length;
      let down = 0;
      while (label && taken.some(([x0, x1, at]) => x < x1 && x + wide > x0 && Math.abs(y + down - at) < 14)) down += 14;
      if (label) taken.push([x, x + wide, y + down]);
      return down;
    };
    this.over.replaceChildren(...marks.map((m) => {
      const [x, y] = this.picture.project(m.at), down = below(x, y, m.label);
      return svg("g", { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`, class: `mark ${m.kind}` },
        m.kind === "name" ? null : svg("circle", { r: 5 }), m.kind === "find" ? svg("circle", { r: 12, class: "ring" }) : null,
        down ? svg("line", { x1: 0, y1: 0, x2: 8, y2: down - 8 }) : null, svg("text", { x: 9, y: down - 6 }, m.label));
    }));
    const inverse = this.picture.camera.turn.clone().invert();
    const axes = (["x", "y", "z"] as const).map((name, i) => ({ name, i, v: new Vector3(+(i === 0), +(i === 1), +(i === 2)).applyQuaternion(inverse) })).sort((p, q) => p.v.z - q.v.z);
    this.axes.replaceChildren(...axes.flatMap(({ name, v, i }) => {
      const [x, y] = [v.x * 24, -v.y * 24];
      return [svg("line", { x1: 0, y1: 0, x2: x, y2: y, class: `axis${i}` }), svg("text", { x: x * 1.38, y: y * 1.38 + 4, class: `axis${i}` }, name)];
    }));
  }
}

/** Bodies of a case as they are named in the mesh, with their roles and materials. */
export function bodiesOf(state: State): { name: string; role: string; material: string; index: number }[] {
  const bodies = (state.case?.document?.body ?? []) as { name?: string; role?: string; material?: string }[];
  return bodies.map((b, index) => ({ name: String(b.name ?? `body ${index + 1}`), role: String(b.role ?? ""), material: String(b.material ?? ""), index }));
}

const ROLE_WORDS = ["riser", "gating", "mould", "core", "chill", "sleeve", "die", "insulation"];
/** The role that the name of a body tells, as `solidus new` takes it; else it is a casting. */
export function roleByName(name: string): string {
  const word = name.toLowerCase();
  return ROLE_WORDS.find((role) => word === role || word.startsWith(`${role}_`)) ?? "casting";
}
