// A part of two million triangles in headless Chromium: node large_part_test.mjs PROGRAM FOLDER. `./dev nightly` runs it.
// What is asserted are counts, which are the same on every machine: triangles that are drawn while the part turns, triangles
// that a click is tried against, bytes. Seconds are printed alone: WebGL by the processor says nothing about a graphics card.
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Browser, Desk, Server } from "./driver.mjs";

const program = resolve(process.argv[2]), folder = resolve(process.argv[3]);
let failed = 0;
function check(sentence, holds, detail = "") {
  if (!holds) ++failed;
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds ? "" : `: ${JSON.stringify(detail)}`}`);
}

/** The middle of the knot's tube at a share of its length [mm]: a trefoil that lies level. */
function middle(share) {
  const t = 2 * Math.PI * share;
  return [30 * (Math.sin(t) + 2 * Math.sin(2 * t)), 30 * (Math.cos(t) - 2 * Math.cos(2 * t)), -30 * Math.sin(3 * t)];
}
const THICK = 11; // radius of the tube [mm]
const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
const unit = (v) => v.map((c) => c / Math.hypot(...v));

/** A knotted tube of 2 × along × round triangles as binary STL, inside out as such files are at times. */
function knot(along, round) {
  const places = new Float32Array(3 * along * round), file = Buffer.alloc(84 + 50 * 2 * along * round);
  for (let i = 0; i < along; ++i) {
    const p = middle(i / along), q = middle((i + 0.01) / along), way = unit(q.map((v, c) => v - p[c]));
    const side = unit(cross(way, [0, 0, 1])), up = cross(side, way);
    for (let k = 0; k < round; ++k) {
      const angle = (2 * Math.PI * k) / round;
      for (let c = 0; c < 3; ++c) places[3 * (i * round + k) + c] = p[c] + THICK * (Math.cos(angle) * side[c] + Math.sin(angle) * up[c]);
    }
  }
  let at = 84;
  const put = (...corners) => {
    at += 12; // the normal, which readers work out
    for (const corner of corners) for (let c = 0; c < 3; ++c, at += 4) file.writeFloatLE(places[3 * corner + c], at);
    at += 2;
  };
  for (let i = 0; i < along; ++i)
    for (let k = 0; k < round; ++k) {
      const j = (i + 1) % along, l = (k + 1) % round;
      put(i * round + k, i * round + l, j * round + k);
      put(j * round + k, i * round + l, j * round + l);
    }
  file.writeUInt32LE(2 * along * round, 80);
  return file;
}
/** Megabytes that the processes of the server have had at most, one after the other added up. */
function mostOf(group) {
  let sum = 0;
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const own = readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /, "").split(" ")[2];
      if (+own === group) sum += +/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1] / 1024;
    } catch {
      continue; // a process that has ended meanwhile
    }
  }
  return sum;
}

const ALONG = 2000, ROUND = 500, ALL = 2 * ALONG * ROUND;
const ROUGH = 60000; // triangles of a picture that moves, at most
/** The page turns the part by the mouse; triangles of each picture and what the page itself did for it [ms]. */
async function turned(desk) {
  await desk.page.run(`(() => {
    const { picture } = solidus.stage, own = picture.render;
    window.pictures = [];
    picture.render = function () {
      const began = performance.now();
      own.call(this);
      window.pictures.push([picture.triangles, performance.now() - began]);
    };
  })()`);
  const [x, y] = await desk.page.run("(() => { const b = solidus.stage.picture.canvas.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()");
  await desk.page.mouse("mousePressed", x, y);
  const began = Date.now();
  for (let i = 1; i <= 40; ++i) {
    await desk.page.mouse("mouseMoved", x + 4 * i, y + i);
    await desk.page.run("new Promise((drawn) => requestAnimationFrame(drawn))");
  }
  console.log(`     ${((Date.now() - began) / 40).toFixed(0)} ms from picture to picture while it turns`);
  const moving = await desk.page.run("window.pictures.slice()");
  await new Promise((r) => setTimeout(r, 400));
  const held = await desk.page.run("window.pictures.slice()");
  await desk.page.mouse("mouseReleased", x + 160, y + 40);
  return { moving, held };
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "knot.stl"), knot(ALONG, ROUND));
const began = Date.now(), seconds = () => ((Date.now() - began) / 1000).toFixed(1);
const server = await Server.open(program, folder, "knot.stl");
const browser = await Browser.open();
try {
  await server.rest(240);
  console.log(`     read after ${seconds()} s`);
  const desk = await Desk.open(browser, server.address);
  await desk.until("solidus.stage.picture.bodies.length === 1", 240);
  console.log(`     seen after ${seconds()} s`);
  await desk.until(`solidus.stage.picture.triangles === ${ALL}`, 120);
  check("a part at rest is drawn whole: two million triangles", await desk.page.run("solidus.stage.picture.bodies[0].faces.length") === ALL);

  const { moving, held } = await turned(desk), quick = await desk.page.run("solidus.stage.picture.painter.quick");
  check(`while it turns a copy of at most ${ROUGH} triangles is drawn, unless pictures are quick here`, moving.length >= 20 && (quick || moving.every(([n]) => n <= ROUGH)), { quick, moving });
  check("a hand that rests with the button held does not call for the whole picture", quick || held.every(([n]) => n <= ROUGH), held.slice(-4));
  const work = moving.slice(1).map(([, ms]) => ms).sort((a, b) => a - b);
  console.log(`     ${work[work.length >> 1].toFixed(1)} ms of them the page works for a picture of ${moving.at(-1)[0]} triangles`);
  await desk.until(`solidus.stage.picture.triangles === ${ALL}`, 120);
  check("when the button is released it is drawn whole again", true);

  // From above, the highest line of the tube: where it is met is known.
  await desk.page.run("solidus.stage.picture.look([0, 0, 1])");
  const top = middle(0.75).map((v, c) => 1e-3 * (v + (c === 2 ? THICK : 0)));
  const hit = await desk.page.run(`(() => {
    const { picture } = solidus.stage, began = performance.now(), hit = picture.pick(...picture.project(${JSON.stringify(top)}));
    return { ...hit, tried: picture.bodies[0].tree.tried, ms: performance.now() - began };
  })()`);
  check("what lies under the pointer is found where it is", Math.hypot(...hit.place.map((v, c) => v - top[c])) < 1e-4, { hit, top });
  check("against some hundred triangles, not two million", hit.tried > 0 && hit.tried < 1000, hit.tried);
  console.log(`     ${hit.ms.toFixed(1)} ms for that`);
  await desk.clickPlace(top);
  await desk.until("!document.querySelector('.place-card').hidden");
  const below = +/([\d.]+) mm of it below/.exec(await desk.page.run("document.querySelector('.place-card').textContent"))[1];
  check("a click says how thick the tube is there", Math.abs(below - 2 * THICK) < 0.2, below);
  await desk.click("#place-riser");
  await desk.until("solidus.state.choices.risers.length === 1");
  check("and a riser stands on it", true);

  const { backingStorageSize } = await desk.page.send("Runtime.getHeapUsage"), megabytes = [backingStorageSize / 1e6, mostOf(server.process.pid)];
  console.log(`     ${megabytes[0].toFixed(0)} MB in the page, ${megabytes[1].toFixed(0)} MB in the server at most`);
  check("the page holds 150 bytes for a triangle at most, and the server needs 700", megabytes[0] < 150e-6 * ALL && megabytes[1] < 700e-6 * ALL, megabytes);
  check("the page does not complain", desk.page.messages.length === 0, desk.page.messages);
  if (process.env.SOLIDUS_TEST_PICTURES) writeFileSync(join(folder, "knot.png"), await desk.page.screenshot());
} catch (error) {
  check("nothing stands in the way", false, error.stack ?? String(error));
} finally {
  await browser.close();
  await server.close();
  rmSync(join(folder, "knot.stl"), { force: true });
}
process.exit(failed ? 1 : 0);
