// What a screenshot shows.
import { inflateSync } from "node:zlib";

/** RGB of the pixels of a PNG of 8 bits without interlace, as Chromium writes it. */
export function pixels(png) {
  let at = 8, width = 0, height = 0, channels = 3;
  const data = [];
  while (at < png.length) {
    const n = png.readUInt32BE(at), type = png.toString("latin1", at + 4, at + 8), body = png.subarray(at + 8, at + 8 + n);
    if (type === "IHDR") [width, height, channels] = [body.readUInt32BE(0), body.readUInt32BE(4), body[9] === 6 ? 4 : 3];
    if (type === "IDAT") data.push(body);
    at += n + 12;
  }
  const raw = inflateSync(Buffer.concat(data)), row = width * channels, out = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y)
    for (let i = 0; i < row; ++i) {
      const filter = raw[y * (row + 1)], byte = raw[y * (row + 1) + 1 + i];
      const left = i >= channels ? out[y * row + i - channels] : 0, up = y > 0 ? out[(y - 1) * row + i] : 0;
      const corner = i >= channels && y > 0 ? out[(y - 1) * row + i - channels] : 0;
      const p = left + up - corner, pa = Math.abs(p - left), pb = Math.abs(p - up), pc = Math.abs(p - corner);
      const guess = [0, left, up, (left + up) >> 1, pa <= pb && pa <= pc ? left : pb <= pc ? up : corner][filter];
      out[y * row + i] = (byte + guess) & 255;
    }
  return { width, height, rgb: (x, y) => [...out.subarray(channels * (y * width + x), channels * (y * width + x) + 3)] };
}

/** How many of the points looked at are coloured, and in how many colours: a picture of a field has many. */
export function colourful(picture) {
  const seen = new Set();
  let n = 0;
  for (let y = 20; y < picture.height * 0.75; y += 4)
    for (let x = 20; x < picture.width - 20; x += 4) {
      const [r, g, b] = picture.rgb(x, y);
      if (Math.max(r, g, b) - Math.min(r, g, b) > 40) {
        ++n;
        seen.add(`${r >> 4},${g >> 4},${b >> 4}`);
      }
    }
  return { n, colours: seen.size };
}
