// From a STEP file to a judged riser by clicks alone, for three parts: node parts_test.mjs PROGRAM FOLDER. Minutes: `./dev nightly` runs it.
// What it takes is asserted in clicks and in the program's processor time, which other programs on the machine hardly change; wall clock time
// and that of the browser, which draws pictures for as long as it waits, are printed.
import { copyFileSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser, Desk, effort, Server } from "./driver.mjs";

const program = resolve(process.argv[2]), folder = resolve(process.argv[3]);
const parts = join(dirname(fileURLToPath(import.meta.url)), "../parts");
let failed = 0;
function check(sentence, holds, detail = "") {
  if (!holds) ++failed;
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds ? "" : `: ${JSON.stringify(detail)}`}`);
}

/** The place of the highest level face that is seen, in the middle of what is seen of it. */
const HIGHEST = `(() => {
  const { picture } = solidus.stage, w = picture.canvas.clientWidth, t = picture.canvas.clientHeight;
  let best = [], top = -Infinity;
  for (let y = 0.1; y < 0.9; y += 0.02) for (let x = 0.1; x < 0.9; x += 0.02) {
    const h = picture.pick(x * w, y * t);
    if (!h || h.normal[2] < 0.9) continue;
    if (h.place[2] > top + 1e-3) { top = h.place[2]; best = []; }
    if (h.place[2] > top - 1e-3) best.push(h.place);
  }
  return best[best.length >> 1];
})()`;

const ASIDE = `(() => {
  const { picture } = solidus.stage, w = picture.canvas.clientWidth, t = picture.canvas.clientHeight, found = [];
  for (let y = 0.1; y < 0.9; y += 0.02) for (let x = 0.1; x < 0.9; x += 0.02) {
    const h = picture.pick(x * w, y * t);
    if (h && h.normal[0] < -0.95) found.push(h.place);
  }
  return found[found.length >> 1];
})()`;

/** Clicks through one part; the answers of its run. */
async function judge(browser, part, gated) {
  copyFileSync(join(parts, `${part}.step`), join(folder, `${part}.step`));
  const server = await Server.open(program, folder, `${part}.step`);
  const began = Date.now(), before = effort(browser.process.pid);
  const passed = []; // step of the way, wall clock time since the start, processor time of the program, of the browser [s]
  const pass = (step) => passed.push([step, (Date.now() - began) / 1000, effort(server.process.pid), effort(browser.process.pid) - before]);
  try {
    const desk = await Desk.open(browser, server.address);
    await desk.until("solidus.stage.picture.bodies.length > 0", 120);
    pass("read");
    await desk.choose("#alloy", "aluminium_alsi7mg");
    await desk.clickPlace(await desk.page.run(HIGHEST));
    await desk.click("#place-riser");
    await desk.until("solidus.state.choices.risers.length === 1");
    if (gated) {
      // The side that is seen from the left, in the middle of what is seen of it.
      await desk.page.run("solidus.stage.picture.look([-1, 0, 0])");
      await desk.clickPlace(await desk.page.run(ASIDE));
      await desk.click("#place-gating");
      await desk.until("solidus.state.choices.gatings.length === 1");
    }
    pass("placed");
    await desk.click("#make");
    await desk.until("solidus.state.check?.current && !solidus.state.job", 240);
    check(`${part}: the case is in order, and its riser a body of it`, (await server.state()).check.error === null && await desk.page.run("solidus.stage.picture.bodies.some((b) => b.name === 'riser_1')"), (await server.state()).check);
    pass("made");
    await desk.click("#run");
    await desk.until("!!document.querySelector('#report-run_1')", 300);
    await desk.until("document.querySelector('#report-frame').contentDocument.querySelector('#head .badge')?.textContent === 'finished'");
    pass("judged");
    const { runs } = await server.state(), processor = passed.at(-1)[2];
    check(`${part}: the run is judged, with the yield and what freezes last`, runs[0].answers.some((a) => a.name === "yield") && runs[0].answers.some((a) => a.name === "casting: last melt froze"), runs);
    check(`${part}: whether the riser fed it to the end is said`, runs[0].verdicts.length >= 1 && await desk.page.run("[...document.querySelectorAll('#run_1 > p')].some((p) => /^riser_1 (outlived|froze)/.test(p.textContent))"), runs[0].verdicts);
    if (gated) check(`${part}: its gating is a body that is poured with it`, runs[0].answers.some((a) => a.name === "gating_1: last melt froze"), runs);
    check(`${part}: by fewer than thirty clicks and less than five minutes of the program's processor time`, desk.clicks < 30 && processor < 300, { clicks: desk.clicks, passed });
    check(`${part}: everything stands in files`, existsSync(join(folder, part, "case.toml")) && existsSync(join(folder, "results", part, "run_1/report.html")));
    check(`${part}: the page does not complain`, desk.page.messages.every((m) => /ERR_CONNECTION_REFUSED/.test(m)), desk.page.messages);
    console.log(`     ${desk.clicks} clicks; wall clock, program, browser: ${passed.map(([step, ...all]) => `${step} ${all.map((s) => s.toFixed(0)).join(", ")} s`).join("; ")}`);
    await desk.page.send("Page.navigate", { url: "about:blank" });
  } finally {
    await server.close();
  }
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const browser = await Browser.open();
try {
  for (const part of ["stepped_plate", "dumbbell", "flange"]) await judge(browser, part, part === "flange");
} catch (error) {
  check("nothing stands in the way", false, error.stack ?? String(error));
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
