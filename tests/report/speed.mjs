// How soon a report shows its picture and how fast a drag turns it: node tests/report/speed.mjs REPORT.html
// Besides the clock it says processor seconds, by process: on a busy machine these alone mean something. The renderer runs the page; the
// process named GPU draws, here by software (SwiftShader), which a graphics card would do instead.
import { resolve } from "node:path";
import { Browser } from "./browser.mjs";

const MOVES = 40;
const browser = await Browser.open();
try {
  const page = await browser.page(1280, 900);
  const seconds = async () => {
    const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
    const of = (type) => processInfo.filter((p) => p.type === type).reduce((sum, p) => sum + p.cpuTime, 0);
    return { renderer: of("renderer"), gpu: of("GPU") };
  };
  const between = (a, b, n = 1) => `renderer ${((1e3 * (b.renderer - a.renderer)) / n).toFixed(1)} ms, drawing ${((1e3 * (b.gpu - a.gpu)) / n).toFixed(1)} ms of processor time`;
  const before = await seconds();
  await page.go(`file://${resolve(process.argv[2])}`);
  const ready = await page.run("performance.getEntriesByName('drawn')[0].startTime");
  const shown = await seconds();
  console.log(`first picture after ${ready.toFixed(0)} ms of the clock, all sections after ${(await page.run("performance.getEntriesByName('built')[0].startTime")).toFixed(0)} ms; ${between(before, shown)}`);
  console.log(`of the page's own work: ${await page.run("(() => { const at = (n) => performance.getEntriesByName(n)[0].startTime; return `${(at('drawn') - at('start')).toFixed(0)} ms from its first line to the picture, ${(at('built') - at('drawn')).toFixed(0)} ms to the last section`; })()")}`);
  const view = "solidus.bench.stages[0].view";
  console.log(`triangles: ${await page.run(`${view}.triangles`)}`);
  console.log(`drawn by: ${await page.run("(() => { const gl = document.createElement('canvas').getContext('webgl2'), d = gl.getExtension('WEBGL_debug_renderer_info'); return gl.getParameter(d ? d.UNMASKED_RENDERER_WEBGL : gl.RENDERER); })()")}`);
  // The first whole picture tells the page how slow pictures are, so one comes before the clock starts.
  await page.run("solidus.bench.look([1, 0.4, 0])");
  await page.screenshot();
  const { x, y } = await page.run("(() => { const r = document.querySelector('.stage').getBoundingClientRect(); return { x: r.left + r.width / 2, y: r.top + r.height / 2 }; })()");
  await page.mouse("mousePressed", x, y);
  for (let i = 1; i <= 3; ++i) await page.mouse("mouseMoved", x + i, y);
  await page.settle();
  const drawn = () => page.run("[performance.now(), performance.getEntriesByName('drawn').length]");
  const start = await seconds(), [began, before0] = await drawn();
  for (let i = 1; i <= MOVES; ++i) await page.mouse("mouseMoved", x + 3 + 4 * i, y + i);
  const [ended, after] = await drawn(), n = after - before0;
  const slow = await page.run(`${view}.painter?.slow ?? false`);
  console.log(`turning by the mouse, ${n} pictures for ${MOVES} moves${slow ? ", drafts" : ""}: ${((ended - began) / n).toFixed(1)} ms of the clock each; ${between(start, await seconds(), n)} each`);
  await page.mouse("mouseReleased", x, y);
} finally {
  await browser.close();
}
