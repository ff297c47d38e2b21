/** The blocks of numbers of a page: base64 of raw deflate, as src/results/report/pack.hpp describes them. */
import { inflateSync, strFromU8 } from "fflate";

/** The bytes of a <script> block, unpacked. */
export function blockBytes(id: string): Uint8Array {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page lacks its block ${id}`);
  const text = atob(element.textContent ?? "");
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  return inflateSync(packed);
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

const STEPS = 16383;

/** [block, low, high, mask block], [-1, value] for one value everywhere, [-2] for none. */
export type PackedValues = number[];

/** Values at `n` places over some moments, unpacked when first asked for. */
export class Values {
  private words?: Uint16Array;
  private mask?: Uint8Array;

  constructor(
    private readonly packed: PackedValues,
    readonly n: number,
    readonly moments: number,
  ) {}

  get none(): boolean {
    return this.packed[0] === -2;
  }
  get low(): number {
    return this.none ? NaN : this.packed[1];
  }
  get high(): number {
    return this.packed[0] >= 0 ? this.packed[2] : this.low;
  }

  private unpack(): Uint16Array {
    if (this.words) return this.words;
    const bytes = blockBytes(`b${this.packed[0]}`);
    const total = bytes.length / 2;
    const words = new Uint16Array(total);
    const n = this.n;
    for (let k = 0, at = 0; at < total; ++k) {
      let beside = 0;
      for (let i = 0; i < n; ++i, ++at) {
        const last = k > 0 ? words[at - n] : 0;
        words[at] = unfold(bytes[at] | (bytes[total + at] << 8)) + last + beside;
        beside = words[at] - last;
      }
    }
    if (this.packed[3] >= 0) this.mask = blockBytes(`b${this.packed[3]}`);
    return (this.words = words);
  }

  /** Of one moment; NaN where there is no value. */
  at(moment: number): Float32Array {
    const out = new Float32Array(this.n);
    if (this.packed[0] < 0) return out.fill(this.low);
    const words = this.unpack();
    const step = (this.high - this.low) / STEPS;
    const from = Math.min(moment, this.moments - 1) * this.n;
    for (let i = 0; i < this.n; ++i)
      out[i] = this.mask && this.mask[from + i] ? NaN : this.low + step * words[from + i];
    return out;
  }
}
