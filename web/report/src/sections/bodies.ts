/** Bodies and surfaces, as the run has understood them. */
import { h, table } from "../dom";
import { duration, short } from "../quantities";
import type { Run } from "../run";
import { addSection, Content, ofRuns } from "../section";

function understood(run: Run): Content[] {
  const bodies = run.summary.understood?.bodies ?? [], poured = run.summary.understood?.poured ?? [], skins = run.summary.understood?.skins ?? [];
  const number = (o: Record<string, unknown>, key: string, scale = 1, unit = "") => (typeof o[key] === "number" ? `${short((o[key] as number) * scale)}${unit && ` ${unit}`}` : "–");
  const size = (o: Record<string, unknown>) => {
    const low = o["low[m]"], high = o["high[m]"];
    return Array.isArray(low) && Array.isArray(high) ? (high as number[]).map((v, i) => v - (low as number[])[i]).slice(0, run.dimension).map((v) => short(v * 1e3)).join(" × ") + " mm" : "–";
  };
  return [
    table(["Body", "Material", "Size", "Mass", "Volume", "Surface", "Elements' edges"], bodies.map((o) => [
      String(o.name ?? ""), String(o.material ?? ""), size(o), number(o, "mass[kg]", 1, "kg"), number(o, "volume[m3]", 1e6, "cm³"), number(o, "skin[m2]", 1e4, "cm²"),
      `${number(o, "shortest_edge[m]", 1e3)} … ${number(o, "longest_edge[m]", 1e3)} mm`])),
    poured.length ? h("h3", { style: "margin-top:18px" }, "Poured bodies, as estimated before the run") : null,
    poured.length ? table(["Body", "Poured at", "Liquidus", "Solidus", "Modulus V/A", "Expected solid after", "Governed by"], poured.map((o) => {
      const celsius = (key: string) => (typeof o[key] === "number" ? `${short((o[key] as number) - 273.15)} °C` : "–");
      return [String(o.body ?? ""), celsius("pouring[K]"), celsius("liquidus[K]"), celsius("solidus[K]"), number(o, "modulus[m]", 1e3, "mm"), typeof o["freezing_time[s]"] === "number" ? duration(o["freezing_time[s]"] as number) : "–", String(o.governed_by ?? "–")];
    })) : null,
    skins.length ? h("h3", { style: "margin-top:18px" }, "Surfaces and what they touch") : null,
    skins.length ? table(["Name", "Surface", "Faces", "Area", "Paired"], skins.map((o) => [String(o.name ?? ""), String(o.surface ?? ""), String(o.faces ?? ""), number(o, "area[m2]", 1e4, "cm²"), number(o, "paired[m2]", 1e4, "cm²")])) : null,
  ];
}

addSection({ id: "understood", title: "Bodies", place: 110, build: (page) => ofRuns(page, (r) => r.summary.understood?.bodies?.length, understood) });
