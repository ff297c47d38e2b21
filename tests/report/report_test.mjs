// Reports of small runs in headless Chromium: node report_test.mjs PROGRAM FOLDER.
// Each check is a sentence; the last line counts them.
import { spawn, spawnSync } from "node:child_process";
import { request } from "node:http";
import { connect } from "node:net";
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Browser } from "./browser.mjs";
import { checkInFirefox } from "./firefox_test.mjs";
import { colourful, pixels } from "./picture.mjs";

const program = resolve(process.argv[2]), folder = resolve(process.argv[3]);
const patience = Number(process.env.SOLIDUS_TEST_PATIENCE ?? 1);  // limits of time are multiplied by it
let passed = 0, failed = 0;
function check(sentence, holds, detail = "") {
  holds ? ++passed : ++failed;
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds ? "" : `: ${JSON.stringify(detail)}`}`);
}
function solidus(...args) {
  const run = spawnSync(program, args, { encoding: "utf8", cwd: folder, timeout: 120000 * patience });
  return { code: run.status, text: run.stdout + run.stderr };
}

const METAL = `title = "A metal that melts"
[density]
value = "2700 kg/m3"
[conductivity]
value = "150 W/m/K"
[specific_heat]
value = "1000 J/kg/K"
[young_modulus]
value = "70 GPa"
[poisson_ratio]
value = 0.3
[expansion]
value = "2e-5 1/K"
source = "a test"
[[phase_change]]
name = "solidification"
latent_heat = "390 kJ/kg"
solidification = true
[phase_change.fraction]
kind = "linear"
solidus = "560 degC"
liquidus = "610 degC"
`;
const block = (title) => `title = ${JSON.stringify(title)}
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["60 mm", "40 mm", "30 mm"]
divisions = [8, 6, 5]
[time]
end = "200 s"
step = "5 s"
[[body]]
name = "casting"
group = "block"
material = "metal.toml"
initial_temperature = "650 degC"
[[thermal_condition]]
name = "wall"
group = "x_min"
kind = "film"
coefficient = "1500 W/m2/K"
ambient = "20 degC"
[[probe]]
name = "T_middle"
field = "temperature"
point = ["30 mm", "20 mm", "15 mm"]
unit = "degC"
[output]
every = "40 s"
`;
const TITLE = "A <b>block</b> </script><script>document.title='taken'</script><img src=x onerror=alert(1)> & \"more\"";

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "metal.toml"), METAL);
writeFileSync(join(folder, "block.toml"), block(TITLE));
writeFileSync(join(folder, "slow.toml"), block("A long run").replace('end = "200 s"', 'end = "20000 s"').replace('step = "5 s"', 'step = "0.05 s"').replace("[8, 6, 5]", "[20, 16, 12]").replace('every = "40 s"', 'every = "1 s"'));
const axisymmetric = `title = "A ring"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "30 mm"]
divisions = [5, 6]
[time]
end = "20 s"
step = "2 s"
adaptive = true
temperature_error = "1 K"
[[body]]
name = "ring"
group = "block"
material = "elastic.toml"
initial_temperature = "400 degC"
[[thermal_condition]]
name = "wall"
group = "x_max"
kind = "film"
coefficient = { formula = "1500 + 1200*tanh(2*(t - 9))" }  # rises at once: a step is too long by its heat
ambient = "20 degC"
[[mechanical_condition]]
name = "stands"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[output]
every = "4 s"
`;
writeFileSync(join(folder, "elastic.toml"), METAL.slice(0, METAL.indexOf("[[phase_change]]")));
writeFileSync(join(folder, "ring.toml"), axisymmetric);

const box = `title = "A closed box of melt"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "tet4"
[mesh.block]
size = ["30 mm", "30 mm", "30 mm"]
divisions = [3, 3, 3]
[time]
end = "40 s"
step = "5 s"
[[body]]
name = "casting"
group = "block"
material = "aluminium_alsi7mg"
initial_temperature = "650 degC"
[output]
every = "20 s"
` + ["x_min", "x_max", "y_min", "y_max", "z_min", "z_max"].map((side) => `[[thermal_condition]]
name = "${side}"
group = "${side}"
kind = "film"
coefficient = "1500 W/m2/K"
ambient = "20 degC"
[[mechanical_condition]]
name = "held_${side}"
group = "${side}"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
uz = "0 mm"
`).join("");
writeFileSync(join(folder, "pores.toml"), box);

writeFileSync(join(folder, "pot.toml"), readFileSync("tests/report/pot.toml"));

for (const [name, ...set] of [["block"], ["ring"], ["pores"], ["pot"]]) {
  const run = solidus("run", `${name}.toml`, "-o", name, "--no-progress", ...set);
  if (run.code !== 0) console.log(run.text);
  check(`the run '${name}' ends well`, run.code === 0, run.text.slice(-400));
}
const second = solidus("run", "block.toml", "-o", "warmer", "--no-progress", "--report", "--set", "thermal_condition.wall.coefficient=\"800 W/m2/K\"");
check("a second block runs", second.code === 0, second.text.slice(-400));
check("run --report writes the page and says so", second.text.includes("warmer/report.html") && existsSync(join(folder, "warmer/report.html")), second.text.slice(-400));

const wheels = solidus("run", "--heat-only", resolve("cases/wheel_in_die"), "-o", "shots", "--no-progress", "--set", "cycle.shots.repeat=2");
check("two shots into a die run", wheels.code === 0, wheels.text.slice(-400));

// What `solidus calibrate` writes next to the run with the values that it found.
cpSync(join(folder, "ring"), join(folder, "fit/fitted"), { recursive: true });
writeFileSync(join(folder, "fit/calibrate.json"), JSON.stringify({ measured: "logger.csv", confidence: 0.9, residuals_over_noise: 1.02, noise_stated: true, not_seen: [],
  unknowns: [{ name: "film", unit: "W/m2/K", value: 1500, low: 1450, high: 1550 }, { name: "emissivity", unit: "", value: 0.25, low: 0.2, high: 0.3, at_bound: true }],
  correlation: [[1, -0.95], [-0.95, 1]], observations: [{ name: "TC1", unit: "K", readings: 3, rms: 0.4, mean: -0.1 }],
  curves: [{ name: "TC1", unit: "degC", time: [0, 10, 20], measured: [600, 500, 450], computed: [600.5, 499.5, 450.25] }] }));

// The command.
for (const [args, page] of [[["pores"], "pores/report.html"], [["pot"], "pot/report.html"], [["shots"], "shots/report.html"], [["block"], "block/report.html"], [["ring"], "ring/report.html"], [["fit/fitted"], "fit/fitted/report.html"], [["block", "warmer", "-o", "two.html"], "two.html"]]) {
  const made = solidus("report", ...args);
  check(`report ${args.join(" ")} says where the page is`, made.code === 0 && made.text.includes(page), made.text);
}
const none = solidus("report", "nowhere");
check("a folder that is not there is the user's mistake", none.code === 1 && none.text.includes("there is no such folder"), none.text);
const empty = solidus("report", ".");
check("a folder without results is too", empty.code === 1 && empty.text.includes("no case.toml"), empty.text);

const browser = await Browser.open();
try {
  const page = await browser.page(1280, 900);
  await page.go(`file://${join(folder, "block/report.html")}`);
  const bench = "solidus.bench", view = `${bench}.stages[0].view`;
  check("the page asks for nothing but itself", page.requests.every((r) => r.startsWith("file:") || r.startsWith("data:") || r.startsWith("blob:")), page.requests);
  check("the title is a text", (await page.run("document.title")).startsWith("A <b>block</b> </script>"), await page.run("document.title"));
  check("and adds no element", (await page.run("document.querySelectorAll('#head img, #head b b, main script').length")) === 0);

  // The picture: the colours of the scale stand on the casting.
  const box = await page.run("(() => { const r = document.querySelector('.stage').getBoundingClientRect(); return { x: r.left, y: r.top, width: r.width, height: r.height, scale: 1 }; })()");
  const shot = async () => pixels(await page.screenshot({ clip: box }));
  const middle = [Math.round(box.width / 2), Math.round(box.height * 0.44)];
  const first = await shot(), looked = colourful(first);
  check("the picture is not blank and shows many colours of the scale", looked.n > 500 && looked.colours > 12, looked);
  await page.run(`${bench}.look([1, 0, 0])`);
  await page.run(`(() => { const c = ${bench}.choice; c.map = 'Viridis'; c.low = 0; c.high = 1e9; ${bench}.fixedRange = true; ${bench}.update(); })()`);
  await page.settle();
  const dark = (await shot()).rgb(...middle);
  check("the least value has the least colour of the map", dark[2] > dark[1] && dark[0] < 90, dark);
  await page.run(`(() => { const c = ${bench}.choice; c.low = -1e9; c.high = 1; ${bench}.update(); })()`);
  await page.settle();
  const bright = (await shot()).rgb(...middle);
  check("the greatest value has the greatest", bright[0] > 150 && bright[1] > 130 && bright[2] < 90, bright);
  await page.run(`(() => { ${bench}.setField('temperature'); ${bench}.look([0.55, 0.45, 0.75]); })()`);

  // The slider.
  const moments = await page.run("+document.querySelector('#time').max + 1");
  check("the slider has a step for each moment", moments === 6, moments);
  const value = (k) => page.run(`${view}.field.values(0, ${k})[0]`);
  check("the first moment is the pouring", Math.abs((await value(0)) - 923.15) < 0.1, await value(0));
  await page.run("(() => { const s = document.querySelector('#time'); s.value = 5; s.dispatchEvent(new Event('input')); })()");
  check("the slider goes to its moment", (await page.run("document.querySelector('#clock').textContent")) === "t = 3 min 20 s", await page.run("document.querySelector('#clock').textContent"));
  const final = JSON.parse(readFileSync(join(folder, "block/summary.json"))).final;
  const hottest = await page.run(`Math.max(...${view}.field.values(0, 5)) - 273.15`);
  const pointed = () => page.run("document.querySelector('.tip').hidden ? '' : document.querySelector('.tip b').textContent");
  await page.mouse("mouseMoved", box.x + middle[0], box.y + middle[1]);
  await page.settle();
  const cold = await pointed();
  await page.run(`${bench}.goTo(40)`);
  await page.settle();
  await page.settle();
  const warm = await pointed();
  check("what is pointed at has its value there, of each moment that comes", parseFloat(warm) > parseFloat(cold) + 10, [cold, warm]);
  // Nothing happens before the first step: the scale of that moment is not that of rounding.
  await page.run(`(() => { ${bench}.fixedRange = false; ${bench}.setField('temperature'); ${bench}.goTo(0); })()`);
  const span = await page.run(`${bench}.choice.high - ${bench}.choice.low`);
  const rounding = await page.run(`(([l, u]) => (u - l) / 16383)(${view}.field.range([0]))`);
  check("equal values have a scale that is wider than their rounding", span > 30 * rounding && span < 100 * rounding, [span, rounding]);
  await page.run(`${bench}.goTo(200)`);
  check("and the temperatures are those of the summary", Math.abs(hottest - final["T_max[degC]"]) < 0.05, [hottest, final["T_max[degC]"]]);
  await page.run("document.querySelector('.stage').focus()");
  await page.key("ArrowLeft");
  check("the left arrow goes back by one", (await page.run(`${view}.moment`)) === 4);
  await page.key("Home");
  await page.key("End");
  check("End goes to the last", (await page.run(`${view}.moment`)) === 5);
  await page.run("document.querySelector('#play').click()");
  await page.run("new Promise((r) => setTimeout(r, 700))");
  await page.run("document.querySelector('#play').click()");
  check("play goes through the moments from the first", (await page.run(`${view}.moment`)) < 5);

  // The cut: its area is that of the block there, and what lies before it is gone.
  await page.run(`${bench}.goTo(200)`);
  const area = () => page.run(`(() => {
    const s = ${view}.shapes[0].cap; if (!s) return 0;
    let sum = 0; const p = s.position, t = s.shape.triangles;
    for (let i = 0; i < t.length; i += 3) {
      const e = [1, 2].map((k) => [0, 1, 2].map((c) => p[3 * t[i + k] + c] - p[3 * t[i] + c]));
      sum += Math.hypot(e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2], e[0][0] * e[1][1] - e[0][1] * e[1][0]) / 2;
    } return sum; })()`);
  await page.run("(() => { const b = [...document.querySelectorAll('#panel button')].find((x) => x.textContent === 'x'); b.click(); })()");
  await page.settle();
  check("a cut across x has the area of the section", Math.abs((await area()) - 0.04 * 0.03) < 1e-8, await area());
  check("it takes away what lies beyond", (await page.run(`(() => { ${bench}.look([1, 0, 0]); const c = ${view}.canvas, h = ${view}.pick(c.clientWidth / 2, c.clientHeight * 0.44); return h && h.place[0]; })()`)) < 0.0305);
  const midway = await page.run(`(() => { const c = ${view}.canvas, h = ${view}.pick(c.clientWidth / 2, c.clientHeight * 0.44); return h.value - 273.15; })()`);
  check("and shows the field inside, between coldest and hottest", midway > final["T_min[degC]"] + 1 && midway < final["T_max[degC]"] - 1, [midway, final["T_min[degC]"], final["T_max[degC]"]]);
  await page.key("c");
  check("C turns the cut off", (await page.run(`${bench}.choice.cut.on`)) === false);

  // Only values between: what is left is bounded by the surface of the value.
  await page.run("(() => { const o = document.querySelector('#only'); o.click(); })()");
  await page.settle();
  const level = await page.run(`(() => { const d = ${view}.shapes[0].levels[0]; const v = [...d.shape.triangles].map((i) => d.value[i]); return { n: v.length, off: v.reduce((m, x) => Math.max(m, Math.abs(x - ${bench}.choice.only.low)), 0), step: ${bench}.choice.high - ${bench}.choice.low }; })()`);
  check("the surface of a value has that value", level.n > 0 && level.off < 1e-3 * level.step, level);
  await page.run("document.querySelector('#only').click()");

  // A click.
  await page.run(`${bench}.look([1, 0, 0])`);
  await page.settle();
  await page.run("document.querySelector('.stage').scrollIntoView({ block: 'start', behavior: 'instant' })");
  const stage = await page.run("(() => { const r = document.querySelector('.stage').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()");
  const [cx, cy] = [stage[0] + stage[2] / 2, stage[1] + stage[3] * 0.44];
  await page.click(cx, cy);
  check("a click shows the curve of that node", (await page.run("document.querySelector('#probed figcaption')?.textContent ?? ''")).startsWith("Temperature at the nodes clicked"));
  const node = await page.run(`(() => { const m = ${bench}.marks[0]; return [m.node, m.at[0]]; })()`);
  check("which lies on the side that is seen", Math.abs(node[1] - 0.06) < 1e-5, node);
  await page.click(cx + 30, cy - 30, { modifiers: 8 });
  check("a click with Shift draws the values along the line", (await page.run("[...document.querySelectorAll('#probed figcaption')].map((f) => f.textContent).join()")).includes("from A to B"));
  await page.key("Escape");
  check("Esc takes the marks away", (await page.run("document.querySelector('#probed').children.length")) === 0);
  const turn = () => page.run(`${bench}.camera.turn.toArray()`);
  const before = await turn();
  await page.drag(cx, cy, cx + 120, cy + 40);
  check("a drag turns the picture", Math.max(...(await turn()).map((q, i) => Math.abs(q - before[i]))) > 0.05);

  // Where pictures are slow what moves is drawn as a draft, of half as many pixels each way, and as the picture when it rests.
  const width = () => page.run(`${view}.canvas.width`);
  const whole = await page.run(`(() => { ${view}.render(false); return ${view}.canvas.width; })()`);  // the drag may have left a draft
  const draft = await page.run(`(() => { ${view}.painter.cost = 1000; ${view}.render(true); return ${view}.canvas.width; })()`);
  check("what moves is a draft where pictures are slow", draft === Math.floor(whole / 2), [draft, whole]);
  let settled = draft;
  for (const end = Date.now() + 10000; Date.now() < end && settled !== whole; settled = await width()) await page.settle();
  check("and the picture when it rests", settled === whole, [settled, whole]);
  check("which is not blank", colourful(await shot()).n > 500);

  await page.run("(() => { const b = [...document.querySelectorAll('button.figure')][0]; b.click(); return new Promise((r) => setTimeout(r, 900)); })()");
  const where = JSON.parse(readFileSync(join(folder, "block/summary.json"))).criteria["solidified_at_max_at[m]"];
  const target = await page.run(`${bench}.camera.target.toArray()`);
  check("a click on a criterion flies to its place", where.every((x, i) => Math.abs(x - target[i]) < 1e-6), [where, target]);
  for (const id of ["curves", "criteria", "pools", "energy", "steps", "understood", "materials", "case", "cost"])
    check(`the page has its section '${id}'`, (await page.run(`!!document.querySelector('#${id}')`)) === true);
  check("the case is there as it was read", (await page.run("document.querySelector('pre.case').textContent")).includes('coefficient = "1500 W/m2/K"'));
  check("the sources of the materials too", (await page.run("document.querySelector('#materials').textContent")).includes("a test"));
  await page.key("t");
  check("T makes it dark", (await page.run("document.documentElement.dataset.theme")) === "dark");
  check("nothing was said on the console", page.messages.length === 0, page.messages);

  // Axisymmetric: revolved at a click.
  const ring = await browser.page(1000, 800, { dark: true });
  await ring.go(`file://${join(folder, "ring/report.html")}`);
  check("the section of a ring is flat", (await ring.run(`${bench}.flat`)) === true);
  await ring.run("[...document.querySelectorAll('#panel button')].find((b) => b.textContent === 'Full').click()"), await ring.settle();
  const reach = await ring.run(`(() => { const d = ${view}.shapes[0].skin, a = d.shape.angle; return [Math.max(...a), d.shape.triangles.length]; })()`);
  check("and turns about its axis at a click", Math.abs(reach[0] - 2 * Math.PI) < 1e-5 && reach[1] > 1000, reach);
  const repeated = readFileSync(join(folder, "ring/steps.csv"), "utf8").includes("shortened: temperature error");
  check("steps that heat shortened are in their table", repeated && /\d shortened: temperature error/.test(await ring.run("document.querySelector('#steps').textContent")));
  await ring.run(`(() => { ${bench}.setField('displacement'); })()`), await ring.settle();
  check("without a word on the console", ring.messages.length === 0, ring.messages);

  // A run that was fitted to measurements shows them.
  const fitted = await browser.page(1000, 800);
  await fitted.go(`file://${join(folder, "fit/fitted/report.html")}`);
  const shown_fit = await fitted.run("document.querySelector('#measured').textContent");
  check("a fitted run has a section of what was measured", ["logger.csv", "film", "1450", "at its bound", "film and emissivity (-0.95)", "TC1"].every((t) => shown_fit.includes(t)), shown_fit);
  check("with curves of both and their difference", (await fitted.run("[...document.querySelectorAll('#measured figcaption span')].map((f) => f.textContent).join()")) === "Temperature, measured and computed °C,Computed less measured K", shown_fit);
  check("which other runs do not have", (await ring.run("!!document.querySelector('#measured')")) === false);
  check("without a word on the console of the fit", fitted.messages.length === 0, fitted.messages);

  // A casting in its die: gap and distortion of the answers are figures.
  const die = await browser.page(1000, 800);
  await die.go(`file://${join(folder, "pot/report.html")}`);
  const told = JSON.parse(readFileSync(join(folder, "pot/summary.json"))).answers;
  const largest = { "Largest gap": Math.max(...Object.values(told.largest_gaps).map((gap) => gap["value[m]"])), "Largest distortion": told.largest_distortion["value[m]"] };
  for (const [label, metres] of Object.entries(largest)) {
    const text = await die.run(`[...document.querySelectorAll('.figure')].find((b) => b.firstChild.textContent === '${label}')?.querySelector('b').textContent ?? ''`);
    const scale = text.endsWith("mm") ? 1e3 : text.endsWith("µm") ? 1e6 : 1;
    check(`a figure says the ${label.toLowerCase()}`, Math.abs(parseFloat(text) - scale * metres) < 1e-3 * scale * metres, [text, metres]);
  }

  // Pores: a card that flies to the densest, a field in shares of the volume.
  const pores = await browser.page(1000, 800);
  await pores.go(`file://${join(folder, "pores/report.html")}`);
  const found = JSON.parse(readFileSync(join(folder, "pores/summary.json"))).answers.pores;
  const card = "[...document.querySelectorAll('button.figure')].find((b) => b.textContent.startsWith('Pores'))";
  const shown = await pores.run(`${card}?.querySelector('b').textContent ?? ''`);
  check("a card says how much of the casting is pores", shown.endsWith("%") && Math.abs(parseFloat(shown) - 100 * found.share_of_casting) < 1e-3 * parseFloat(shown), [shown, found]);
  await pores.run(`${card}.click()`);
  let arrived;
  for (const end = Date.now() + 10000; Date.now() < end && !arrived?.every((x, i) => Math.abs(x - found["at[m]"][i]) < 1e-6);) {
    await pores.settle();
    arrived = await pores.run(`${bench}.camera.target.toArray()`);
  }
  check("and flies to the densest", arrived.every((x, i) => Math.abs(x - found["at[m]"][i]) < 1e-6), [arrived, found]);
  await pores.run("[...document.querySelectorAll('.presets button')].find((b) => b.textContent === 'Pores').click()");
  await pores.settle();
  check("the pores are a field, as a share of the volume", (await pores.run(`[${bench}.field.id, ${bench}.field.unit.text, ${bench}.choice.only.on].join()`)) === "pore_fraction,%,true");
  check("without a word on the console there", pores.messages.length === 0, pores.messages);

  // Shots: a row each, and a click that goes to the end of one.
  const shots = await browser.page(1000, 800);
  await shots.go(`file://${join(folder, "shots/report.html")}`);
  const answers = JSON.parse(readFileSync(join(folder, "shots/summary.json"))).answers.shots;
  const cells = await shots.run("[...document.querySelectorAll('#shots tbody tr')].map((r) => [...r.children].map((c) => c.textContent))");
  check("every shot has its row", cells.length === 2 && answers.length === 2 && cells[1][0] === "2", cells);
  check("with the time to solidify of the summary", Math.abs(parseFloat(cells[0][3]) - answers[0]["time_to_solidify[s]"]) < 2 || cells[0][3].includes("min"), [cells[0], answers[0]]);
  check("two charts are over the shots", (await shots.run("[...document.querySelectorAll('#shots figcaption')].length")) === 2);
  await shots.run("document.querySelector('#shots tbody tr button').click()");
  await shots.settle();
  check("a click goes to the end of a shot", Math.abs((await shots.run(`${bench}.choice.time`)) - answers[0]["end[s]"]) < 1, answers[0]);
  const stages = JSON.parse(readFileSync(join(folder, "shots/summary.json"))).answers.stages;
  const stageRows = await shots.run("[...document.querySelectorAll('#stages tbody tr')].map((r) => [...r.children].map((c) => c.textContent))");
  check("every stage that is over has its row, in each cycle", stages.length > 2 && stageRows.length === stages.length && stageRows.every((row, i) => row[0] === stages[i].name && +row[1] === stages[i].cycle), { stageRows, stages });
  check("with the temperatures of the summary", stageRows.every((row, i) => row[3].endsWith("°C") && Math.abs(parseFloat(row[3].split(" to ").at(-1).replace("−", "-")) - (stages[i]["highest_temperature[K]"] - 273.15)) < 0.1), { stageRows, stages });
  check("and no word on the console there", shots.messages.length === 0, shots.messages);

  // Two runs side by side, on a telephone.
  const two = await browser.page(390, 800, { mobile: true });
  await two.go(`file://${join(folder, "two.html")}`);
  check("two runs have two pictures", (await two.run("document.querySelectorAll('.stage').length")) === 2);
  check("and a table of their differences", (await two.run("document.querySelector('#comparison').textContent")).includes("second − first"));
  check("nothing is wider than the telephone", (await two.run("document.documentElement.scrollWidth")) <= 390, await two.run("document.documentElement.scrollWidth"));
  check("nothing was said there either", two.messages.length === 0, two.messages);

  // A run that goes on.
  const run = spawn(program, ["run", "slow.toml", "-o", "slow", "--no-progress", "--watch"], { cwd: folder });
  const ended = new Promise((r) => run.once("exit", r));
  let said = "";
  run.stdout.on("data", (d) => (said += d));
  const until = async (what, seconds = 30) => {
    for (const end = Date.now() + 1000 * seconds * patience; Date.now() < end; await new Promise((r) => setTimeout(r, 50))) {
      const got = await what();
      if (got) return got;
    }
    return undefined;
  };
  const address = await until(() => /http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//.exec(said)?.[0]);
  check("--watch says where", address !== undefined, said);
  const ask = (path, options = {}) => new Promise((done) => {
    const r = request(new URL(path, address), { agent: false, ...options }, (response) => {
      let body = "";
      response.on("data", (d) => (body += d));
      response.on("end", () => done({ status: response.statusCode, body }));
    });
    r.on("error", (e) => done({ status: 0, body: String(e) }));
    r.end();
  });
  const port = new URL(address).port;
  check("nothing is there without the token", (await ask("/")).status === 404 && (await ask(`/${"0".repeat(32)}/`)).status === 404);
  check("nor under the name of another machine", (await ask(address, { headers: { host: `evil.example:${port}` } })).status === 404);
  check("nor any other file", (await ask(`${address}case.toml`)).status === 404 && (await ask(`${address}../../etc/passwd`)).status === 404);
  check("nor for another method", (await ask(address, { method: "POST" })).status === 404);
  const silent = await Promise.all(Array.from({ length: 20 }, () => new Promise((done) => {
    const socket = connect(+port, "127.0.0.1", () => done(socket));
    socket.on("error", () => done(socket));
  })));
  const asked = Date.now(), beside = await ask(address), waited = Date.now() - asked;
  check("twenty visitors that say nothing keep no other waiting", beside.status === 200 && waited < 15000, [beside.status, waited]);
  silent.forEach((socket) => socket.destroy());
  const live = await until(async () => (await ask(address)).body.includes('id="stamp"'));
  check("the page is there while the run goes on", live && run.exitCode === null, run.exitCode);
  const watcher = await browser.page(1000, 800);
  await watcher.send("Network.emulateNetworkConditions", { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: -1 });
  await watcher.go(address);
  const shownRows = () => watcher.run("typeof solidus === 'undefined' ? 0 : solidus.page.runs[0].table('history').rows").catch(() => 0);
  const rows = await until(shownRows);
  // The page reloads itself every few seconds and has no badge in between.
  const badge = await until(() => watcher.run("document.querySelector('#head .badge')?.textContent").catch(() => undefined));
  check("it shows a run that has not ended", badge === "running", [badge, rows]);
  check("and follows it", (await until(async () => (await shownRows()) > rows)) === true, rows);
  check("nothing was said on its console", watcher.messages.length === 0, watcher.messages);
  run.kill("SIGTERM");
  await ended;
  const stopped = solidus("report", "slow");
  check("a run that was stopped has a report", stopped.code === 0, stopped.text);
} finally {
  await browser.close();
}
await checkInFirefox(check, folder);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
