/** The cards of the materials. */
import { h, svg, table } from "../dom";
import { short, unitText } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, ofRuns } from "../section";

function materials(run: Run): Content[] {
  const cards = run.meta.materials.map(({ body, material, card, missing }) => {
    const head = h("h3", {}, material, h("small", {}, ` · ${body}`));
    if (!card) return h("div", { class: "card" }, head, h("p", { class: "hint" }, `The card cannot be read: ${missing ?? "it is not there"}`));
    const properties = card.properties.map((p) => {
      const unit = p.unit === "Pa" ? { text: "MPa", scale: 1e-6 } : { text: unitText(p.unit), scale: 1 };
      const values = p.values.map((v) => v * unit.scale);
      const low = Math.min(...values), high = Math.max(...values);
      return [p.name.replace(/_/g, " "), values.length > 1 ? spark(p["temperature[K]"], values) : "", (low === high ? short(low) : `${short(low)} … ${short(high)}`) + (unit.text ? ` ${unit.text}` : "")];
    });
    const changes = card.phase_changes.map((c) => {
      const celsius = (key: string) => `${short(Number(c[key]) - 273.15)} °C`;
      return h("p", { class: "hint" }, `${c.name}: ${celsius("solidus[K]")} to ${celsius("liquidus[K]")}, latent heat ${short(Number(c["latent_heat[J/kg]"]) / 1e3)} kJ/kg, volume change ${short(Number(c["volume_change[1]"]) * 100)} %`);
    });
    const sources = card.sources.map((s) => {
      const valid = s["valid_to[K]"] !== undefined ? `${short(s["valid_from[K]"]! - 273.15)} to ${short(s["valid_to[K]"] - 273.15)} °C` : "";
      return [s.property.replace(/_/g, " "), s.source || "no source given", valid];
    });
    return h("div", { class: "card" }, head, h("p", { class: "hint" }, card.title), table(["Property", "", "Value"], [["density", "", `${short(card["density[kg/m3]"])} kg/m³`], ...properties]), ...changes,
      sources.length ? h("details", { class: "more" }, h("summary", {}, `Sources (${sources.length})`), table(["Property", "Source", "Valid"], sources)) : h("p", { class: "hint" }, "The card gives no sources."));
  });
  return [h("p", { class: "hint" }, "As the library has them at the time of the report; small curves are over temperature."), h("div", { class: "cards" }, ...cards)];
}

function spark(x: number[], y: number[]): Node {
  const [x0, x1] = [Math.min(...x), Math.max(...x)], [y0, y1] = [Math.min(...y), Math.max(...y)];
  const points = x.map((v, i) => `${(2 + (86 * (v - x0)) / (x1 - x0 || 1)).toFixed(1)},${(19 - (16 * (y[i] - y0)) / (y1 - y0 || 1)).toFixed(1)}`).join(" ");
  return svg("svg", { width: 90, height: 22, role: "img", "aria-label": `from ${short(x0 - 273.15)} to ${short(x1 - 273.15)} °C` },
    svg("polyline", { points, fill: "none", stroke: "var(--accent)", "stroke-width": 1.6 }), svg("title", {}, `${short(x0 - 273.15)} … ${short(x1 - 273.15)} °C`));
}

addSection({ id: "materials", title: "Materials", place: 120, build: (page) => ofRuns(page, (r) => r.meta.materials.length, materials) });
