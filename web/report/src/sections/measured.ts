/** Measured curves next to those of the run that `solidus calibrate` has fitted to them. */
import { chart, Line } from "../charts";
import { h, table } from "../dom";
import { measureOf, short, unitText } from "../quantities";
import type { Calibrated, Run } from "../run";
import { addSection, Content, ofRuns } from "../section";

/** Per unit of the observations: measured and computed values, and below them the differences. */
function charts(fit: Calibrated): Node[] {
  const curves = fit.curves ?? [];
  return [...new Set(curves.map((c) => c.unit))].flatMap((unit) => {
    const own = curves.filter((c) => c.unit === unit);
    const both = own.flatMap((c, i): Line[] => [
      { label: `${c.name}, measured`, x: c.time, y: c.measured, colour: i, dashed: true },
      { label: `${c.name}, computed`, x: c.time, y: c.computed, colour: i },
    ]);
    const off = own.map((c, i): Line => ({ label: c.name, x: c.time, y: c.computed.map((v, k) => v - c.measured[k]), colour: i }));
    return [
      chart({ title: `${measureOf(unit)}, measured and computed`, unit: unitText(unit), lines: both, time: true }),
      chart({ title: "Computed less measured", unit: unit === "degC" ? "K" : unitText(unit), lines: off, time: true }),
    ];
  });
}

/** The strongest correlations, by name. */
function together(fit: Calibrated): string[] {
  const names = (fit.unknowns ?? []).map((u) => u.name);
  const pairs = (fit.correlation ?? []).flatMap((row, i) => row.slice(0, i).map((value, j) => ({ value, i, j })));
  return pairs.filter((p) => Math.abs(p.value) > 0.9).sort((a, b) => Math.abs(b.value) - Math.abs(a.value)).slice(0, 5)
    .map((p) => `${names[p.j]} and ${names[p.i]} (${p.value.toFixed(2)})`);
}

function measured(run: Run): Content[] {
  const fit = run.calibrated;
  if (!fit?.unknowns?.length) return [h("p", { class: "hint" }, "This run was not fitted to measurements.")];
  const percent = short(100 * (fit.confidence ?? 0.9)), alike = together(fit);
  const unseen = (fit.not_seen ?? []).map((n) => Object.keys(n.combination).join(", "));
  return [
    h("p", { class: "hint" }, "Fitted by ", h("code", {}, "solidus calibrate"), ` to ${fit.measured ?? "measurements"}; intervals of ${percent} %. The residuals are `
      + `${short(fit.residuals_over_noise ?? 0)} times ${fit.noise_stated ? "the stated noise" : "one unit"}.`),
    h("div", { class: "cards" }, ...charts(fit)),
    h("h3", {}, "Values found"),
    table(["Unknown", "Value", `${percent} % from`, "to", "Unit", ""], fit.unknowns.map((u) => [u.name, short(u.value), short(u.low), short(u.high), u.unit, u.at_bound ? "at its bound" : ""])),
    h("h3", {}, "Computed less measured"),
    table(["Observation", "Readings", "Root mean square", "Mean", "Unit"], (fit.observations ?? []).map((o) => [o.name, o.readings, short(o.rms), short(o.mean), o.unit])),
    alike.length ? h("p", { class: "hint" }, `Correlated above 0.9: ${alike.join("; ")}. All correlations are in calibrate.json.`) : null,
    ...unseen.map((names) => h("p", { class: "hint" }, `Not determined by the readings: ${names}.`)),
  ];
}

addSection({ id: "measured", title: "Measured", place: 25, build: (page) => ofRuns(page, (r) => r.calibrated?.unknowns?.length, measured) });
