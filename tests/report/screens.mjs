// The screens of the report in README.md and docs: node tests/report/screens.mjs FOLDER makes docs/images/report_*.png from pages
// FOLDER/NAME.html, which `solidus report` wrote; those that are not there are left out. Look at them before they are committed.
import { existsSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser.mjs";

const bench = "solidus.bench";
const press = (text, among = "#panel") => `[...document.querySelectorAll('${among} button')].find((b) => b.textContent === '${text}').click()`;
const show = (body, state) => `document.querySelector('button[data-body="${body}"][data-state="${state}"]').click()`;
/** Picture: page, and what is done there before it is taken. */
const SCREENS = {
  crankshaft: { page: "crankshaft", height: 840, steps: [`${bench}.setField('temperature')`, `${bench}.goTo(240)`, show("sand", "shown"), press("z"), `${bench}.look([0.25, -0.6, 0.75])`] },
  last_to_freeze: { page: "crankshaft", height: 840, steps: [press("Last to freeze", ".presets"), `${bench}.look([0.55, -0.75, 0.45])`] },
  pores: { page: "crankshaft", height: 840, steps: [press("Pores", ".presets"), `${bench}.goTo(1e9)`, `${bench}.look([0.55, -0.75, 0.45])`] },
  aluminium_cylinder: { page: "aluminium_cylinder", dark: true, steps: [`${bench}.setField('temperature')`, `${bench}.goTo(10)`, press("¾"), `${bench}.look([0.3, 0.45, 0.85])`] },
  hot_spots: { page: "hot_spots", steps: [`${bench}.setField('solidified_at')`, `${bench}.goTo(120)`, "document.querySelector('#only').click()"] },
  shots: { page: "wheel_in_die", height: 760, steps: ["document.querySelector('#shots').scrollIntoView({ behavior: 'instant' })"] },
};

const browser = await Browser.open();
try {
  for (const [name, { page: file, dark, height, steps }] of Object.entries(SCREENS)) {
    const path = resolve(process.argv[2], `${file}.html`);
    if (!existsSync(path)) continue;
    const page = await browser.page(1280, height ?? 800, { dark });
    await page.go(`file://${path}`);
    for (const step of steps) {
      await page.run(`(() => { ${step}; })()`);
      await page.settle();
    }
    if (page.messages.length) throw new Error(`${file}: ${page.messages.join("; ")}`);
    writeFileSync(fileURLToPath(new URL(`../../docs/images/report_${name}.png`, import.meta.url)), await page.screenshot());
    console.log(`docs/images/report_${name}.png`);
  }
} finally {
  await browser.close();
}
