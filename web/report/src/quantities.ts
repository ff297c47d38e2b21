/** Names and units as a foundry engineer reads them. Everything in a page is SI; here it is turned for the eye. */

export interface Unit {
  text: string;
  scale: number;
  offset: number;
}

const UNITS: Record<string, Unit> = {
  K: { text: "°C", scale: 1, offset: -273.15 },
  m: { text: "mm", scale: 1e3, offset: 0 },
  Pa: { text: "MPa", scale: 1e-6, offset: 0 },
  "W/m2": { text: "kW/m²", scale: 1e-3, offset: 0 },
  "W/m2/K": { text: "W/(m² K)", scale: 1, offset: 0 },
  "W/m3": { text: "kW/m³", scale: 1e-3, offset: 0 },
  m3: { text: "cm³", scale: 1e6, offset: 0 },
  "m/s": { text: "mm/s", scale: 1e3, offset: 0 },
  "K/m": { text: "K/mm", scale: 1e-3, offset: 0 },
  "J/m2": { text: "J/m²", scale: 1, offset: 0 },
  "1": { text: "", scale: 1, offset: 0 },
};
const OF_FIELD: Record<string, Unit> = {
  niyama: { text: "√(K\u00a0s)/mm", scale: 1e-3, offset: 0 },
  secondary_arm_spacing: { text: "µm", scale: 1e6, offset: 0 },
  shrinkage_porosity: { text: "%", scale: 100, offset: 0 },
  pore_fraction: { text: "%", scale: 100, offset: 0 },
  equivalent_plastic_strain: { text: "%", scale: 100, offset: 0 },
  brittle_strain: { text: "%", scale: 100, offset: 0 },
  strain_in_liquid: { text: "%", scale: 100, offset: 0 },
  strain_since_coherency: { text: "%", scale: 100, offset: 0 },
  wear_depth: { text: "µm", scale: 1e6, offset: 0 },
};
/** A tick of temperature differences, not of temperatures. */
const RATES = new Set(["cooling_rate", "thermal_gradient"]);

export function unitOf(field: string, unit: string): Unit {
  if (OF_FIELD[field]) return OF_FIELD[field];
  if (RATES.has(field) && unit === "K") return { text: "K", scale: 1, offset: 0 };
  return UNITS[unit] ?? { text: unit, scale: 1, offset: 0 };
}

const LABELS: Record<string, string> = {
  solid_fraction: "Solid fraction",
  von_mises: "Von Mises stress",
  first_principal_stress: "Largest principal stress",
  solidified_at: "Solid at (time)",
  local_solidification_time: "Local solidification time",
  secondary_arm_spacing: "Dendrite arm spacing",
  niyama: "Niyama criterion",
  dimensionless_niyama: "Dimensionless Niyama",
  shrinkage_porosity: "Shrinkage porosity (estimate)",
  pore_fraction: "Pores (share of the volume)",
  liquid_pool: "Pool of melt",
  gap: "Air gap",
  conductance: "Heat transfer coefficient",
  contact_heat_flux: "Heat flux through contact",
  equivalent_plastic_strain: "Plastic strain",
  brittle_strain: "Strain in the brittle range",
  distortion: "Distortion",
  front_speed: "Speed of the front",
};

export function labelOf(name: string): string {
  const text = LABELS[name] ?? name.replace(/_/g, " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Groups of fields in their menu. */
export function groupOf(name: string, atEnd: boolean): string {
  if ((atEnd && !/conductance|dissipation|flow_stress/.test(name)) || name === "liquid_pool" || name === "pore_fraction") return "Criteria";
  if (/temperature|solid_fraction/.test(name)) return "Heat";
  if (/gap|contact|conductance|friction|slip|wear|internal_variable|interface/.test(name)) return "Contact";
  return "Mechanics";
}

/** About four digits, without noise. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return tidyExponent(value.toExponential(2));
  if (size >= 1e5) return value.toFixed(0);
  return String(+value.toPrecision(4)).replace("-", "−");
}

function tidyExponent(text: string): string {
  const [digits, power] = text.split("e");
  const raised = String(+power).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  return `${String(+digits).replace("-", "−")}·10${raised}`;
}

export function withUnit(value: number, unit: Unit): string {
  return short(value * unit.scale + unit.offset) + (unit.text ? ` ${unit.text}` : "");
}

/** "14.0 s", "7 min 45 s", "2 h 3 min". */
export function duration(seconds: number): string {
  if (!Number.isFinite(seconds)) return "–";
  if (Math.abs(seconds) < 120) return `${short(seconds)} s`;
  const whole = Math.round(seconds);
  if (whole < 7200) return `${Math.floor(whole / 60)} min${whole % 60 ? ` ${whole % 60} s` : ""}`;
  const minutes = Math.round(whole / 60);
  return `${Math.floor(minutes / 60)} h${minutes % 60 ? ` ${minutes % 60} min` : ""}`;
}

/** Coordinates in mm, to a tenth; small parts to two digits. */
export function place(x: ArrayLike<number>, dimension = 3): string {
  const one = (metres: number) => {
    const v = metres * 1e3, text = Math.abs(v) >= 1 ? v.toFixed(1) : v.toPrecision(2);
    return String(Math.abs(v) < 5e-4 ? 0 : +text).replace("-", "−");
  };
  return `(${Array.from(x).slice(0, dimension).map(one).join(", ")}) mm`;
}

/** "degC" of the tables as "°C". */
export function unitText(unit: string): string {
  return unit === "degC" ? "°C" : unit === "1" ? "" : unit.replace("m2", "m²").replace("m3", "m³");
}
