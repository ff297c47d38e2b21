/** Colour maps that people with colour blindness read, as 33 anchors of sRGB, and colours of curves. */
import type { Quantity } from "./quantities";

const ANCHORS: Record<string, string> = {
  Viridis:
    "440154470d6048186a482374472d7b4537814240863e49893b528b375b8d33638d2f6b8e2c728e297a8e26828e23898e21918c1f988b1fa08822a78528ae8032b67a3fbc734ec36b5ec96270cf5784d44b98d83eaddc30c2df23d8e219ece51bfde725",
  Inferno:
    "160b39210c4a2f0a5b3b0964470b6a520e6d5d126e6a176e751b6e801f6c8c2369972766a32c61ae305cb93556c33b4fcc4248d74b3fdf5337e65d2fec6726f1731df68013f98c0afb9906fca60cfcb418fac42af7d13df4df53f1ec6df3f68afcffa4",
  Cividis:
    "00224e00285b002e6a0533711a386f273e6e32436d3b496c434e6c4b546c535a6d5a5f6e61656f686a716f70737676767d7c788482798c8878938e789b9476a39a74aba072b4a76fbcae6cc4b468cdbb63d5c25edec958e7d150f0d846f9e03afee838",
  "Blue–red":
    "3b4cc0445acc4e68d85875e16282ea6c8ff1779af782a6fb8db0fe98b9ffa3c2feaec9fcb9d0f9c3d5f4ccd9edd5dbe5dddcdce5d8d1ecd3c5f1ccb8f5c4acf7ba9ff7b093f6a586f4987af08b6eeb7d62e46e56dd5f4bd44e41ca3b37be242eb40426",
};
export const MAPS = [...Object.keys(ANCHORS), "Grey"];

/** 256 colours, RGBA. */
export function colourTable(name: string): Uint8Array {
  const out = new Uint8Array(1024);
  const text = ANCHORS[name];
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * 32, k = Math.min(31, Math.floor(at)), f = at - k;
    for (let c = 0; c < 3; ++c) {
      const anchor = (j: number) => parseInt(text.substr(6 * j + 2 * c, 2), 16);
      out[4 * i + c] = text ? Math.round(anchor(k) * (1 - f) + anchor(k + 1) * f) : 20 + (i / 255) * 220;
    }
    out[4 * i + 3] = 255;
  }
  return out;
}

const MAP_OF = { sequential: "Viridis", hot: "Inferno", share: "Cividis", by_sign: "Blue–red" };

/** The map that suits a field; components have a sign. */
export function mapOf(colours: Quantity["colours"] | undefined, component: string): string {
  return MAP_OF[component ? "by_sign" : (colours ?? "sequential")];
}

/** Curves: Okabe and Ito's colours, those that read on light and on dark. */
const LIGHT = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#9a6a00", "#3a9bd6", "#555555", "#7b4fb5"];
const DARK = ["#56b4e9", "#ff9e4a", "#2fd0a0", "#e79ac6", "#f0e442", "#8fb8ff", "#c4c4c4", "#b79cf0"];
export function lineColour(i: number, dark: boolean): string {
  return (dark ? DARK : LIGHT)[i % LIGHT.length];
}
