// The workbench in headless Chromium with the program: node workbench_test.mjs PROGRAM FOLDER. Each check is a sentence.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { pixels } from "../report/picture.mjs";
import { Browser, Desk, Server } from "./driver.mjs";
import { checkInFirefox } from "./firefox_test.mjs";

const program = resolve(process.argv[2]), folder = resolve(process.argv[3]);
const parts = join(dirname(fileURLToPath(import.meta.url)), "../parts");
let passed = 0, failed = 0;
function check(sentence, holds, detail = "") {
  holds ? ++passed : ++failed;
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds ? "" : `: ${JSON.stringify(detail)}`}`);
}

const METAL = `title = "A metal that melts"
[density]
value = "2700 kg/m3"
[conductivity]
value = "150 W/m/K"
[specific_heat]
value = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
latent_heat = "390 kJ/kg"
solidification = true
[phase_change.fraction]
kind = "linear"
solidus = "560 degC"
liquidus = "610 degC"
`;
const BLOCK = `title = "A <b>block</b>"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["60 mm", "40 mm", "30 mm"]
divisions = [4, 3, 3]
[time]
end = "100 s"   # a comment that stays
step = "10 s"
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
`;
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, "block"), { recursive: true });
writeFileSync(join(folder, "block/case.toml"), BLOCK);
writeFileSync(join(folder, "block/metal.toml"), METAL);
copyFileSync(join(parts, "stepped_plate.step"), join(folder, "plate.step"));
const file = () => readFileSync(join(folder, "block/case.toml"), "utf8");

/** Clicking through a case: keys, check, run, report, comparison, undo. */
async function ofACase(server, desk) {
  await server.rest();
  await desk.until("solidus.stage.picture.bodies.length === 1");
  check("a case is opened with its bodies in the picture", await desk.page.run("solidus.stage.picture.bodies[0].name") === "casting");
  await desk.page.settle();
  const [x, y] = await desk.page.run("(() => { const { picture } = solidus.stage, b = picture.canvas.getBoundingClientRect(), p = picture.project([0.03, 0.02, 0.015]); return [b.left + p[0], b.top + p[1], b.left + 30]; })()");
  const seen = pixels(await desk.page.screenshot()), far = (p, q) => Math.hypot(...p.map((v, i) => v - q[i]));
  check("the body is drawn on the ground of the picture", far(seen.rgb(Math.round(x), Math.round(y)), seen.rgb(Math.round(x), 130)) > 40);
  // The skin of a block of 4 x 3 x 3 elements has 66 quadrilaterals of two triangles, with 198 edges; 40 of them are on borders of faces.
  const drawn = () => desk.page.run("solidus.stage.picture.things.children.filter((c) => c.isLineSegments).reduce((sum, c) => sum + c.geometry.index.count / 2, 0)");
  const borders = await drawn();
  await desk.click("#elements");
  check("the elements can be seen", await drawn() === 198 && await desk.page.run("document.querySelector('#elements').ariaPressed") === "true", { borders, now: await drawn() });
  await desk.click("#elements");
  check("and not", await drawn() === borders && borders === 40, borders);
  await desk.click("#to-keys");
  await desk.click("#section-time");
  await desk.type("#key-time-end", "60 s");
  await desk.until("solidus.state.case.document.time.end === '60 s'");
  check("a key is changed by the form, and the comment behind it stays", file().includes('end = "60 s"   # a comment that stays'), file());
  await desk.click("#check");
  await desk.until("document.querySelector('#verdict')?.textContent.startsWith('The case')");
  await server.rest();
  await desk.click("#run");
  await desk.until("!!document.querySelector('#report-run_1')", 120);
  await desk.until("document.querySelector('#report-frame').contentDocument.querySelector('#head .badge')?.textContent === 'finished'");
  check("a run ends in its report, next to the steps", true);
  await desk.until("!!document.querySelector('#run_1 .answers button')");
  await desk.click("#run_1 .answers button");
  check("an answer leads to its place in the picture", await desk.page.run("!document.querySelector('#tab-view').hidden && document.querySelectorAll('.mark.find').length === 1"));
  await desk.click("#report-run_1");
  await desk.until("document.querySelector('#report-frame').contentDocument.querySelector('#head .badge')?.textContent === 'finished'");
  await desk.click("#print-run_1");
  await desk.until("!!document.querySelector('#printed-run_1') && !solidus.state.job", 120);
  const printed = Buffer.from(await (await fetch(`${server.address}run/run_1/printed`)).arrayBuffer());
  check("pages for the customer are printed as a PDF", printed.subarray(0, 5).toString() === "%PDF-" && await desk.page.run("document.querySelector('#printed-run_1').textContent") === "report.pdf", printed.length);
  check("titles go in as text", await desk.page.run("document.querySelector('#report-frame').contentDocument.querySelector('h1').textContent") === "A <b>block</b>");
}

/** A button that is held down while the page hears of changes ten times a second: its click is not lost. */
async function ofAHeldButton(server, desk) {
  await desk.click("#to-view-tab");
  await desk.until("!!document.querySelector('#show-0-ghost')");
  const [x, y] = await desk.atRest("(() => { const b = document.querySelector('#show-0-ghost').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()");
  await desk.page.mouse("mousePressed", x, y);
  const { edits } = await server.state();
  await desk.page.run(`fetch('set', { method: 'POST', body: JSON.stringify({ seen: ${edits}, path: ['title'], value: 'changed while a button is held' }) })`);
  await new Promise((r) => setTimeout(r, 1000));
  await desk.page.mouse("mouseReleased", x, y);
  await desk.until("document.querySelector('#show-0-ghost').classList.contains('on')", 10);
  await desk.until("solidus.state.case.document.title === 'changed while a button is held'");
  check("a button that is held down while something changes does what it says", true);
  await desk.click("#show-0-shown");
  await desk.click("#undo");
  await desk.until("solidus.state.case.document.title !== 'changed while a button is held'");
}

/** Conditions on a face by clicking: what the file says then, values that are typed, and what goes with one that is taken away. */
async function ofConditions(server, desk) {
  await desk.click("#to-view-tab");
  await desk.page.run("solidus.stage.picture.look([0.55, -0.75, 0.45])");
  const top = [0.02, 0.03, 0.03];  // on the upper face of the block
  const before = file();
  for (const [kind, name] of [["film", "film_1"], ["radiation", "radiation_1"], ["flux", "flux_1"], ["temperature", "temperature_1"]]) {
    await desk.clickPlace(top);
    if (kind === "film") check("a case of heat alone takes no supports", await desk.page.run("['held', 'guided', 'pressure'].every((id) => document.querySelector(`#place-${id}`).title === 'this case computes heat alone')"));
    await desk.click(`#place-${kind}`);
    await desk.until(`(solidus.state.case.document.thermal_condition ?? []).some((c) => c.name === '${name}' && c.kind === '${kind}') && !!document.querySelector('#condition-${name}')`);
  }
  const { document } = (await server.state()).case, group = document.mesh.group.find((g) => g.name === "temperature_1");
  check("a condition lies on the face that was clicked, of the body's group", group.owner === "block" && group.nearest.every((text, i) => Math.abs(parseFloat(text) - 1e3 * top[i]) < 0.1), group);
  check("its value waits for what is typed", await desk.page.run("document.activeElement.ariaLabel") === "temperature_1: temperature");
  await desk.type("#condition-temperature_1 input", "300 degC");
  await desk.until("solidus.state.case.document.thermal_condition.find((c) => c.name === 'temperature_1').temperature === '300 degC'");
  await desk.type("#condition-radiation_1 input", "0.4");
  await desk.until("solidus.state.case.document.thermal_condition.find((c) => c.name === 'radiation_1').emissivity === 0.4");
  check("numbers stay numbers, and texts texts", file().includes("emissivity = 0.4\n") && file().includes('temperature = "300 degC"\n'));
  await desk.click("#check");
  await server.rest();
  const checked = (await server.state()).check;
  check("the case with all of them is in order", checked.current && checked.error === null && /temperature_1 \(casting\)/.test(checked.text), checked);
  // The film is taken away with its group; what is undone comes back with it.
  await desk.click("#condition-film_1 legend button:last-child");
  await desk.until("!document.querySelector('#condition-film_1') && !solidus.state.case.document.mesh.group.some((g) => g.name === 'film_1')");
  await desk.click("#undo");
  await desk.until("!!document.querySelector('#condition-film_1') && solidus.state.case.document.mesh.group.some((g) => g.name === 'film_1')");
  for (let step = 0; step < 6; ++step) {
    const { undo } = await server.state();
    await desk.click("#undo");
    await desk.until(`solidus.state.undo === ${undo - 1}`);
  }
  check("a condition and its group go and come as one step, and all is undone", file() === before, file());
}

/** A key that is wrong, what check says, and undo. */
async function ofMistakes(server, desk) {
  await desk.choose("#add-key", "until");
  await desk.choose("#new-value", "solid");
  await desk.until("solidus.state.case.document.time.until === 'solid'");
  check("a key is added with what the schema allows", file().includes('until = "solid"'));
  await desk.click("#to-text-tab");
  await desk.page.run("document.querySelector('#file-text').focus()");
  await desk.page.run("(() => { const t = document.querySelector('#file-text'); t.value = t.value.replace('1500 W', '1500 furlong'); t.dispatchEvent(new Event('input')); })()");
  await desk.click("#save-text");
  await desk.until("solidus.state.case.text.includes('furlong')");
  await desk.click("#check");
  await desk.until("document.querySelector('#finding-0.error')");
  await desk.click("#finding-0");
  const line = file().split("\n").findIndex((l) => l.includes("furlong"));
  const at = await desk.page.run("(() => { const t = document.querySelector('#file-text'); return t.value.slice(0, t.selectionStart).split('\\n').length - 1; })()");
  check("a finding leads to its line", at === line, { at, line });
  check("a case that is refused is not run", await desk.page.run("document.querySelector('#run').disabled"));
  await desk.click("#undo");
  await desk.until("!solidus.state.case.text.includes('furlong')");
  await desk.click("#undo");
  await desk.until("solidus.state.case.document.time.until === undefined");
  check("two steps are undone, and the file with them", !file().includes("until"));
}

/** Two pages at one case, and a page that is closed. */
async function ofPages(server, browser, desk) {
  const other = await Desk.open(browser, server.address, { dark: true });
  await other.until("solidus.state.case !== null");
  check("a second page shows the same, in the dark too", await other.page.run("document.documentElement.dataset.theme") === "dark");
  await other.page.run("solidus.ask('set', { path: ['title'], value: 'changed elsewhere' })");
  await desk.until("solidus.state.case.document.title === 'changed elsewhere'");
  check("what one page changes the other shows", true);
  await desk.page.run("solidus.ask('set', { seen: 0, path: ['title'], value: 'too late' })");
  check("what has changed meanwhile is not overwritten, and the page says so", (await desk.page.run("document.querySelector('#told').textContent")).includes("another page"));
  check("and the file holds the first", file().includes("changed elsewhere"));
  await other.choose("#physics", "heat");
  await other.click("#run");
  await other.page.send("Page.navigate", { url: "about:blank" });
  await server.rest();
  await other.page.go(server.address);
  await other.until("!!document.querySelector('#report-run_2')");
  check("a page that is closed finds its run again", true);
  await other.click("#compare");
  await other.until("solidus.state.compared", 120);
  await other.until("document.querySelectorAll('#compared-answers tr').length > 2 && !document.querySelector('#tab-compared').hidden");
  check("two runs are compared: answers next to each other, and the report of both", (await server.state()).compared.answers.length > 1);
  for (const d of [desk, other]) check("no page complains", d.page.messages.every((m) => /400|409/.test(m)), d.page.messages);
}

/** A part: picture, alloy, riser by clicking, and a file that is refused. */
async function ofAPart(server, desk) {
  await desk.front();
  await desk.click("#choose-file");
  await desk.click("#dialog li button");
  await desk.until("solidus.state.part === 'plate.step' && solidus.stage.picture.bodies.length === 1");
  const top = await desk.page.run("(() => { const b = solidus.stage.picture.bodies[0]; return [b.low, b.high]; })()");
  check("a STEP file is seen", top[1][2] > top[0][2], top);
  await desk.choose("#alloy", "aluminium_alsi7mg");
  const at = await desk.page.run(`(() => {
    const { picture } = solidus.stage, w = picture.canvas.clientWidth, t = picture.canvas.clientHeight;
    for (let y = 0.1; y < 0.9; y += 0.02) for (let x = 0.1; x < 0.9; x += 0.02) { const h = picture.pick(x * w, y * t); if (h && h.normal[2] > 0.99) return h.place; }
  })()`);
  await desk.clickPlace(at);
  await desk.click("#place-riser");
  await desk.until("solidus.state.choices.risers.length === 1");
  const { risers } = (await server.state()).choices;
  check("a riser stands where one clicked, as wide as the metal is thick", Math.hypot(risers[0].foot[0] - at[0], risers[0].foot[1] - at[1]) < 1e-3 && risers[0].diameter > 0.005, { risers, at });
  await desk.type("#riser-0-diameter", "31");
  await desk.until("Math.abs(solidus.state.choices.risers[0].diameter - 0.031) < 1e-9");
  check("its size can be typed", true);
  await desk.click("#preview");
  await desk.until("solidus.state.preview && !solidus.state.job", 120);
  const ahead = (await server.state()).preview;
  check("mould and elements are seen before they are made", await desk.page.run("/^A mould of .* mm, its walls .*Elements of .* mm in the metal/.test(document.querySelector('#ahead').textContent)")
    && ahead.walls.length === 6 && top[0].every((v, i) => ahead.low[i] < v) && (await server.state()).case === null && ahead.mould_size > ahead.size, ahead);
  // A side of the plate, seen from there: the plate is halved parallel to it, and gets its gate.
  await desk.page.run("solidus.stage.picture.look([-1, 0, 0])");
  const side = await desk.page.run(`(() => {
    const { picture } = solidus.stage, h = picture.pick(picture.canvas.clientWidth / 2, picture.canvas.clientHeight / 2);
    return h && { place: h.place, normal: h.normal };
  })()`);
  await desk.clickPlace(side.place);
  await desk.click("#place-symmetry");
  await desk.until("solidus.state.choices.symmetry !== ''");
  check("a face says how the part is halved", "xyz".indexOf((await server.state()).choices.symmetry) === side.normal.findIndex((v) => Math.abs(v) > 0.99), side);
  await desk.clickPlace(side.place);
  await desk.click("#place-gate");
  await desk.until("solidus.state.choices.gate !== null");
  check("a gate lies where one clicked", Math.hypot(...(await server.state()).choices.gate.map((v, i) => v - side.place[i])) < 1e-3);
  await desk.clickPlace(side.place);
  await desk.until("document.querySelector('#place-symmetry')?.textContent === 'Whole again'");
  await desk.click("#place-beside");
  await desk.until("solidus.state.choices.risers.length === 2");
  const beside = (await server.state()).choices.risers[1], deepest = beside.neck_to[0] - side.place[0];
  check("a riser stands next to the part, and its neck leads into the metal", deepest > 0 && deepest <= beside.diameter / 2 + 1e-6 && side.place[0] - beside.foot[0] > beside.diameter / 2 && beside.neck_diameter < beside.diameter, beside);
  check("its neck has fields, and no sleeve that would cut it", await desk.page.run("!!document.querySelector('#riser-1-neck') && !!document.querySelector('#riser-1-to-z') && !document.querySelector('#riser-1-sleeve')"));
  await desk.click("#undo");
  await desk.until("solidus.state.choices.risers.length === 1");
  await desk.clickPlace(side.place);
  await desk.click("#place-gating");
  await desk.until("solidus.state.choices.gatings.length === 1");
  const [gating] = (await server.state()).choices.gatings, area = (Math.PI / 4) * gating.foot_diameter ** 2;
  check("a sprue stands beside the part with runner and ingate, which ends in the metal", gating.gate[0] > side.place[0] && gating.sprue[0] < top[0][0] - gating.top_diameter / 2
    && Math.abs(gating.sprue[1] - side.place[1]) < 1e-6 && gating.sprue[2] > top[1][2] && Math.abs(gating.gate_width * gating.gate_height / area - 2) < 0.5, gating);
  await desk.click("#gating-0-fill");
  await desk.until("solidus.state.choices.gate?.[2] === solidus.state.choices.gatings[0].sprue[2]");
  await desk.type("#gating-0-sprue-z", "150");
  await desk.until("Math.abs(solidus.state.choices.gatings[0].sprue[2] - 0.15) < 1e-9 && Math.abs(solidus.state.choices.gate[2] - 0.15) < 1e-9");
  check("runs fill the mould through it, and the gate moves with the sprue", true);
  await desk.click("#undo");
  await desk.until("Math.abs(solidus.state.choices.gatings[0]?.sprue[2] - 0.15) > 1e-9");
  await desk.click("#undo");
  await desk.until("solidus.state.choices.gatings[0] && solidus.state.choices.gate?.[2] !== solidus.state.choices.gatings[0].sprue[2]");
  await desk.click("#undo");
  await desk.until("solidus.state.choices.gatings.length === 0");
  await desk.click("#undo");
  await desk.click("#undo");
  await desk.until("solidus.state.choices.gate === null && solidus.state.choices.symmetry === ''");
  check("both are undone", true);
  check("fields have names for screen readers", await desk.page.run("[...document.querySelectorAll('input:not([hidden]), select, textarea, button, iframe')].every((e) => e.ariaLabel || e.title || e.labels?.length || e.textContent.trim())"));
}

/** A run that takes long is stopped after its step, and keeps what it has. */
async function ofStopping(server, desk) {
  await desk.front();
  const before = file();
  await desk.page.run("solidus.ask('set', { path: ['time', 'step'], value: '0.5 ms' })");
  await desk.until("solidus.state.case.document.time.step === '0.5 ms'");
  await desk.click("#run");
  await desk.until("solidus.state.job?.progress.step > 3 && !!document.querySelector('#job progress')");
  check("a run shows its step and how much is done", await desk.page.run("/step [0-9]+/.test(document.querySelector('#job').textContent)"));
  await desk.click("#stop");
  await desk.until("!!document.querySelector('#failed')");
  const { runs, job } = await server.state();
  check("a run that is stopped keeps its results, and the page says so", job === null && runs.at(-1).outcome !== "finished"
    && await desk.page.run("document.querySelector('#failed').textContent === 'Stopped.'"), runs.at(-1));
  await desk.click("#undo");
  await desk.until("solidus.state.case.document.time.step !== '0.5 ms'");
  check("what was changed for it is undone", file() === before, file());
}

/** Files that are dropped on the page: a surface of triangles becomes the part, what is no part is refused. */
async function ofDropping(server, desk) {
  const drop = (name, text) => desk.page.run(`(() => {
    const data = new DataTransfer();
    data.items.add(new File([${JSON.stringify(text)}], ${JSON.stringify(name)}));
    document.querySelector('#stage').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data }));
  })()`);
  const corners = [[0, 0, 0], [30, 0, 0], [0, 20, 0], [0, 0, 10]], faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
  await drop("wedge.stl", `solid wedge\n${faces.map((f) => `facet normal 0 0 0\nouter loop\n${f.map((v) => `vertex ${corners[v].join(" ")}`).join("\n")}\nendloop\nendfacet`).join("\n")}\nendsolid wedge\n`);
  await desk.until("solidus.state.part === 'wedge.stl' && solidus.stage.picture.bodies.length === 1");
  const box = await desk.page.run("(({ low, high }) => [...low, ...high])(solidus.stage.picture.bodies[0])");
  check("a surface that is dropped is the part, in millimetres", [0, 0, 0, 0.03, 0.02, 0.01].every((v, i) => Math.abs(box[i] - v) < 1e-7), box);
  await drop("script.geo", "Point(1) = {0, 0, 0};");
  await desk.until("document.querySelector('#told.bad') && !document.querySelector('#told').hidden");
  check("what is no part is refused in words", await desk.page.run("solidus.state.part") === "wedge.stl", await desk.page.run("document.querySelector('#told').textContent"));
  await desk.click("#told button");
  await desk.page.run("solidus.ask('open', { name: 'plate.step' })");
  await desk.until("solidus.state.part === 'plate.step' && solidus.stage.picture.bodies.length === 1 && solidus.stage.picture.bodies[0].high[2] > 0.02");
}

/** A tablet held upright: the picture stands above the steps, a tap says what lies there, and nothing is wider than the screen. */
async function onATablet(server, browser) {
  const desk = await Desk.open(browser, server.address, { mobile: true });
  await desk.page.send("Emulation.setDeviceMetricsOverride", { width: 820, height: 1180, deviceScaleFactor: 1, mobile: true });
  await desk.page.send("Emulation.setTouchEmulationEnabled", { enabled: true });
  await desk.until("solidus.stage.picture.bodies.length > 0 && solidus.stage.picture.canvas.clientWidth > 500");
  await desk.page.run("solidus.stage.picture.look([0, 0, 1])");
  const [x, y] = await desk.atRest("(() => { const b = solidus.stage.picture.canvas.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()");
  for (const type of ["touchStart", "touchEnd"]) await desk.page.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchStart" ? [{ x, y }] : [] });
  await desk.until("!document.querySelector('.place-card').hidden && !!document.querySelector('#place-probe')");
  check("on a tablet a tap says what lies there, and the page fits its screen", await desk.page.run("document.documentElement.scrollWidth <= 820 && document.querySelector('.desk').getBoundingClientRect().top < document.querySelector('#steps').getBoundingClientRect().top"));
}

/** A browser without WebGL: no picture, and all else. */
async function withoutPictures(server, browser) {
  const desk = await Desk.open(browser, server.address, { noPictures: true });
  await desk.until("solidus.state.part === 'plate.step' && !!document.querySelector('#no-picture')");
  check("without WebGL the page says that there is no picture, and nothing fails", await desk.page.run("document.querySelector('#failure').hidden"));
  const before = (await server.state()).choices.risers.length;
  await desk.click("#riser-on-top");
  await desk.until(`solidus.state.choices.risers.length === ${before + 1}`);
  await desk.choose("#process", "gravity_die");
  await desk.until("solidus.state.choices.process === 'gravity_die'");
  check("there too the process is chosen, and a riser is put on the highest place", true);
}

const server = await Server.open(program, folder, "block");
const browser = await Browser.open();
try {
  const desk = await Desk.open(browser, server.address);
  await ofACase(server, desk);
  await ofAHeldButton(server, desk);
  await ofConditions(server, desk);
  await ofMistakes(server, desk);
  await ofPages(server, browser, desk);
  await ofStopping(server, desk);
  await ofAPart(server, desk);
  await ofDropping(server, desk);
  await onATablet(server, browser);
  await withoutPictures(server, browser);
  await checkInFirefox(check, server);
} catch (error) {
  check("nothing stands in the way", false, error.stack ?? String(error));
} finally {
  await browser.close();
  check("Ctrl-C ends the server", (await server.close()) === 0, server.text);
}
console.log(`${passed} of ${passed + failed} checks hold`);
process.exit(failed ? 1 : 0);
