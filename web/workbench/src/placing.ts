/** What is put where one clicks: sizes by the thickness of the metal below, which the user changes afterwards. */
import { cross, type SkinBody } from "./skin";
import type { Pick } from "./scene";
import type { Chill, Gating, Place, Probe, Riser } from "./state";

/** How thick the metal is below a place of the skin [m]; half of the body's height where the line leaves nowhere. */
export function thickness(body: SkinBody, at: Pick): number {
  const inward = at.normal.map((v) => -v) as Place;
  const size = Math.hypot(...[0, 1, 2].map((i) => body.high[i] - body.low[i]));
  return cross(body, at.place, inward, 1e-5 * size)?.far ?? size / 4;
}

const millimetre = (value: number) => Math.max(1, Math.round(value * 1e3)) * 1e-3;

/** Whether something can stand on a face: it looks up. */
export function looksUp(at: Pick): boolean {
  return at.normal[2] > 0.2;
}

/** A riser as wide as the metal below is thick, one and a half times as high; its foot lies so deep that it stands on metal all round. */
export function riserAt(body: SkinBody, at: Pick, name: string): Riser {
  const thick = thickness(body, at), diameter = millimetre(thick);
  let lowest = at.place[2];
  for (const share of [0.5, 0.95])
    for (let k = 0; k < 12; ++k) {
      const angle = (k * Math.PI) / 6, r = (share * diameter) / 2;
      const above: Place = [at.place[0] + r * Math.cos(angle), at.place[1] + r * Math.sin(angle), at.place[2] + 1e-9];
      const hit = cross(body, above, [0, 0, -1], 0);
      if (hit) lowest = Math.min(lowest, hit.place[2]);
    }
  const deepest = at.place[2] - 0.4 * thick, foot = Math.max(lowest, deepest), neck = at.place[2] - foot;
  return { name, foot: [at.place[0], at.place[1], foot], diameter, height: millimetre(1.5 * diameter + neck), ...(neck > 1e-4 ? { neck_height: neck } : {}) };
}

/** Sand between a riser next to the part and the part, width of its neck and its metal below the neck, of its diameter: as `solidus design` has them. */
const GAP = 0.15, NECK = 0.7, BELOW = 0.1;

/** Whether a riser can stand next to a face: it looks to the side. */
export function looksAside(at: Pick): boolean {
  return Math.abs(at.normal[2]) < 0.7;
}

/** A riser next to the part. The metal behind the face has a thickness along the level and one upright: the lesser is the riser's diameter, and
 * the neck leads to the middle of it; the riser stands one and a half diameters above that. */
export function riserBeside(body: SkinBody, at: Pick, name: string): Riser {
  const level = Math.hypot(at.normal[0], at.normal[1]), out: Place = [at.normal[0] / level, at.normal[1] / level, 0];
  const least = 1e-5 * Math.hypot(...[0, 1, 2].map((i) => body.high[i] - body.low[i]));
  const deep = cross(body, at.place, out.map((v) => -v) as Place, least)?.far ?? thickness(body, at);
  const inside = at.place.map((v, i) => v - 0.5 * deep * out[i]) as Place;
  const up = cross(body, inside, [0, 0, 1], 0)?.far ?? deep / 2, down = cross(body, inside, [0, 0, -1], 0)?.far ?? deep / 2;
  const diameter = millimetre(Math.min(deep, up + down)), middle = at.place[2] + (up - down) / 2;
  const from = (way: number, z: number): Place => [at.place[0] + way * out[0], at.place[1] + way * out[1], z];
  return {
    name, diameter, foot: from((GAP + 0.5) * diameter, middle - (0.5 * NECK + BELOW) * diameter), height: millimetre((1.5 + 0.5 * NECK + BELOW) * diameter),
    neck_diameter: millimetre(NECK * diameter), neck_to: from(-0.5 * Math.min(deep, diameter), middle),
  };
}

/** Gating that enters a face which looks to the side. The ingate is half as high as the metal behind the face is thick, so that it freezes before that
 * metal, and twice as wide as high; runner and ingate have twice the area of the sprue's foot. The sprue stands beside all bodies and ends with the
 * highest riser, or above the part. */
export function gatingAt(bodies: SkinBody[], body: SkinBody, at: Pick, risers: Riser[], name: string): Gating {
  const level = Math.hypot(at.normal[0], at.normal[1]), out: Place = [at.normal[0] / level, at.normal[1] / level, 0];
  const least = 1e-5 * Math.hypot(...[0, 1, 2].map((i) => body.high[i] - body.low[i]));
  const deep = cross(body, at.place, out.map((v) => -v) as Place, least)?.far ?? thickness(body, at);
  const upAndDown = (depth: number) => [1, -1].map((way) => cross(body, at.place.map((v, i) => v - depth * out[i]) as Place, [0, 0, way], 0)?.far ?? deep / 2);
  const thick = Math.min(deep, upAndDown(deep / 2)[0] + upAndDown(deep / 2)[1]), [up, down] = upAndDown(thick / 2);
  const gate_height = millimetre(thick / 2), gate_width = 2 * gate_height, side = millimetre(Math.sqrt(gate_height * gate_width));
  const foot_diameter = millimetre(Math.sqrt((2 * gate_height * gate_width) / Math.PI)), top_diameter = millimetre(1.3 * foot_diameter);
  // The ingate ends a little within the metal, as faces may be curved, and within its height.
  const within = thick / 4, z = Math.min(Math.max(at.place[2], at.place[2] - down + gate_height / 2), at.place[2] + up - gate_height / 2);
  const along = (x: Place) => x[0] * out[0] + x[1] * out[1];
  const reach = Math.max(...bodies.map((b) => along([out[0] > 0 ? b.high[0] : b.low[0], out[1] > 0 ? b.high[1] : b.low[1], 0]))) - along(at.place);
  const gate_length = millimetre(within + thick), far = Math.max(within + thick + side + top_diameter, reach + top_diameter);
  const high = Math.max(...bodies.map((b) => b.high[2])), low = Math.min(...bodies.map((b) => b.low[2]));
  const top = Math.max(high + Math.max(thick / 2, 0.25 * (high - low)), ...risers.map((r) => r.foot[2] + r.height));
  const from = (way: number, height: number): Place => [at.place[0] + way * out[0], at.place[1] + way * out[1], height];
  return { name, gate: from(-within, z), gate_width, gate_height, gate_length, runner_width: side, runner_height: side, sprue: from(far, top), foot_diameter, top_diameter };
}

/** A block as wide as the metal is thick and half as deep, that reaches a quarter of it into the part. */
export function chillAt(body: SkinBody, at: Pick, name: string): Chill {
  const thick = thickness(body, at), half = millimetre(thick / 2);
  const axis = [0, 1, 2].reduce((best, i) => (Math.abs(at.normal[i]) > Math.abs(at.normal[best]) ? i : best), 0);
  const lowest = at.place.map((v) => v - half) as Place, highest = at.place.map((v) => v + half) as Place;
  if (at.normal[axis] > 0) lowest[axis] = at.place[axis] - half / 2;
  else highest[axis] = at.place[axis] + half / 2;
  return { name, lowest, highest };
}

/** A probe in the middle of the metal below. */
export function probeAt(body: SkinBody, at: Pick, name: string): Probe {
  const deep = thickness(body, at) / 2;
  return { name, point: at.place.map((v, i) => v - deep * at.normal[i]) as Place };
}

/** A name that is not taken: riser_1, riser_2, … */
export function freeName(stem: string, taken: { name: string }[]): string {
  for (let n = 1; ; ++n) if (!taken.some((t) => t.name === `${stem}_${n}`)) return `${stem}_${n}`;
}
