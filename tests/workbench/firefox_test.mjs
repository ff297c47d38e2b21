// The workbench of workbench_test.mjs in Firefox: picture, click, a change that the server takes.
import { Firefox, FIREFOX, SCREEN } from "../report/firefox.mjs";

export async function checkInFirefox(check, server) {
  if (!FIREFOX || !SCREEN) {
    console.log("skipped in Firefox: firefox-esr or xvfb is not installed (./dev test installs both)");
    return;
  }
  const firefox = await Firefox.open();
  const until = async (expression) => {
    for (let i = 0; i < 300; ++i, await new Promise((r) => setTimeout(r, 100))) if (await firefox.run(`(() => { try { return ${expression}; } catch { return false; } })()`)) return true;
    return false;
  };
  try {
    await firefox.go(server.address);
    check("Firefox shows the bodies", await until("page.solidus.stage.picture.bodies.length > 0 && page.solidus.stage.picture.triangles > 0"));
    const [x, y] = await firefox.run("(() => { const b = document.querySelector('#stage').getBoundingClientRect(), { picture } = page.solidus.stage, { low, high } = picture.bodies[0], p = picture.project([0, 1, 2].map((i) => (low[i] + high[i]) / 2)); return [b.left + p[0], b.top + p[1]]; })()");
    await firefox.click(Math.round(x), Math.round(y));
    check("a click in Firefox says what lies there", await until("!document.querySelector('.place-card').hidden && /mm of it below/.test(document.querySelector('.place-card').textContent)"));
    await firefox.run("document.querySelector('#place-probe').click()");
    check("and places a probe", await until("page.solidus.state.choices.probes.length === 1 || (page.solidus.state.case?.document.probe ?? []).length === 1"), await server.state());
    await firefox.run("document.querySelector('#gating-aside').click()");
    check("gating is put at the side without a mouse, with fields that have names", await until("page.solidus.state.choices.gatings.length === 1 && document.querySelector('#gating-0-sprue-z')?.ariaLabel === 'gating_1, top of the sprue: z in mm'"), await server.state());
    const said = await firefox.messages(server.address);
    check("nothing was said on Firefox's console", said.length === 0, said);
  } finally {
    await firefox.close();
  }
}
