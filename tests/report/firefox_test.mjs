// The page of report_test.mjs in Firefox.
import { join } from "node:path";
import { Firefox, FIREFOX, SCREEN } from "./firefox.mjs";
import { colourful, pixels } from "./picture.mjs";

/** @param folder  of report_test.mjs, with the report of the block in it */
export async function checkInFirefox(check, folder) {
  if (!FIREFOX || !SCREEN) {
    console.log("skipped in Firefox: firefox-esr or xvfb is not installed (./dev test installs both)");
    return;
  }
  const firefox = await Firefox.open();
  try {
    const url = `file://${join(folder, "block/report.html")}`;
    await firefox.go(url);
    check("Firefox opens the page", (await firefox.run("document.title")).startsWith("A <b>block</b>"));
    const box = await firefox.run("(() => { const r = document.querySelector('.stage')?.getBoundingClientRect(); return r && [r.left, r.top, r.width, r.height]; })()");
    check("Firefox draws in three dimensions", box !== null && box[2] > 300, box);
    const looked = colourful(pixels(await firefox.screenshot()));
    check("the picture shows many colours of the scale there too", looked.n > 500 && looked.colours > 12, looked);
    await firefox.run("(() => { const s = document.querySelector('#time'); s.value = 5; s.dispatchEvent(new Event('input')); })()");
    check("its slider goes to its moment", (await firefox.run("document.querySelector('#clock').textContent")) === "t = 3 min 20 s");
    await firefox.run("[...document.querySelectorAll('#panel button')].find((b) => b.textContent === 'x').click()");
    check("its cut is on", (await firefox.run("page.solidus.bench.choice.cut.on")) === true);
    await firefox.settle();
    await firefox.click(Math.round(box[0] + box[2] / 2), Math.round(box[1] + box[3] * 0.44));
    check("a click shows the curve of a node there too", (await firefox.run("document.querySelector('#probed figcaption')?.textContent ?? ''")).startsWith("Temperature at the nodes clicked"));
    const said = await firefox.messages(url);
    check("nothing was said on Firefox's console", said.length === 0, said);
  } finally {
    await firefox.close();
  }
}
