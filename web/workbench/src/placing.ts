/** What is put where one clicks: sizes by the thickness of the metal below, which the user changes afterwards. */
import { cross, type SkinBody } from "./skin";
import type { Pick } from "./scene";
import type { Chill, Place, Probe, Riser } from "./state";

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
