/** The blocks of numbers of a page: base64 of raw deflate, as src/results/report/pack.hpp describes them. */
import { inflateSync, strFromU8 } from "fflate";

/** What newer browsers have (ES2026) and TypeScript does not know yet. */
const fromBase64 = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array }).fromBase64;

function base64Bytes(text: string): Uint8Array {
  if (fromBase64) return fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/** The bytes of a <script> block, unpacked. `size` is how many they are, where that is known: memory is taken once then. */
export function blockBytes(id: string, size?: number): Uint8Array {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page lacks its block ${id}`);
  return inflateSync(base64Bytes(element.textContent ?? ""), size === undefined ? undefined : { out: new Uint8Array(size) });
}

export function blockJson(id: string): unknown {
  return JSON.parse(strFromU8(blockBytes(id)));
}

const unfold = (word: number): number => (word >>> 1) ^ -(word & 1);

/** small_bytes: whole numbers in four planes. */
export function smallNumbers(block: number): Int32Array {
  const bytes = blockBytes(`b${block}`);
  const n = bytes.length / 4;
  const out = new Int32Array(n);
  for (let i = 0; i < n; ++i)
    out[i] = unfold(bytes[i] | (bytes[n + i] << 8) | (bytes[2 * n + i] << 16) | (bytes[3 * n + i] << 24));
  return out;
}

/** rising_bytes: the same of differences. */
export function risingNumbers(block: number): Int32Array {
  const out = smallNumbers(block);
  for (let i = 1; i < out.length; ++i) out[i] += out[i - 1];
  return out;
}

/** double_bytes: eight planes. */
export function doubles(block: number): Float64Array {
  const planes = blockBytes(`b${block}`);
  const n = planes.length / 8;
  const bytes = new Uint8Array(planes.length);
  for (let k = 0; k < 8; ++k) for (let i = 0; i < n; ++i) bytes[8 * i + k] = planes[k * n + i];
  return new Float64Array(bytes.buffer);
}

export const STEPS = 16383;

/** [block, low, high, mask block], [-1, value] for one value everywhere, [-2] for none. */
export type PackedValues = number[];

/** Values at `n` places over some moments, unpacked when first asked for and no further than to the moment asked for. */
export class Values {
  private planes?: Uint8Array;
  private words?: Uint16Array;
  private mask?: Uint8Array;
  /** Moments whose words are there. */
  private unpacked = 0;
  private kept?: { moment: number; values: Float32Array };

  constructor(
    private readonly packed: PackedValues,
    readonly n: number,
    readonly moments: number,
  ) {}

  /** Whether some place has no value at some moment. */
  get partial(): boolean {
    return this.packed[0] >= 0 && this.packed[3] >= 0;
  }
  get none(): boolean {
    return this.packed[0] === -2;
  }
  get low(): number {
    return this.none ? NaN : this.packed[1];
  }
  get high(): number {
    return this.packed[0] >= 0 ? this.packed[2] : this.low;
  }

  private unpack(moment: number): Uint16Array {
    const n = this.n, total = n * this.moments;
    const words = (this.words ??= new Uint16Array(total));
    if (this.unpacked > moment) return words;
    const bytes = (this.planes ??= blockBytes(`b${this.packed[0]}`, 2 * total));
    if (this.packed[3] >= 0) this.mask ??= blockBytes(`b${this.packed[3]}`, total);
    for (; this.unpacked <= moment; ++this.unpacked) {
      const from = n * this.unpacked;
      for (let at = from, beside = 0; at < from + n; ++at) {
        const last = from > 0 ? words[at - n] : 0;
        words[at] = unfold(bytes[at] | (bytes[total + at] << 8)) + last + beside;
        beside = words[at] - last;
      }
    }
    if (this.unpacked === this.moments) this.planes = undefined;
    return words;
  }

  /** Of one moment; NaN where there is no value. The same array as before where the same moment is asked for again. */
  at(moment: number): Float32Array {
    const m = Math.min(moment, this.moments - 1);
    if (this.kept && (this.kept.moment === m || this.packed[0] < 0)) return this.kept.values;
    const out = new Float32Array(this.n);
    this.kept = { moment: m, values: out };
    if (this.packed[0] < 0) return out.fill(this.low);
    const words = this.unpack(m), mask = this.mask;
    const low = this.low, step = (this.high - low) / STEPS, from = m * this.n;
    for (let i = 0; i < out.length; ++i) out[i] = mask && mask[from + i] ? NaN : low + step * words[from + i];
    return out;
  }

  /** Of one place at one moment. */
  one(place: number, moment: number): number {
    if (this.packed[0] < 0) return this.low;
    const m = Math.min(moment, this.moments - 1), words = this.unpack(m), at = m * this.n + place;
    return this.mask && this.mask[at] ? NaN : Math.fround(this.low + ((this.high - this.low) / STEPS) * words[at]);
  }
}
