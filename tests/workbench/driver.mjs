// What tests of the workbench share: a server, a page that is worked by clicks alone, and the server's state.
import { spawn } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { Browser } from "../report/browser.mjs";

export const patience = Number(process.env.SOLIDUS_TEST_PATIENCE ?? 1);  // limits of time are multiplied by it

/** Processor time [s] of a process, of those that it has started, and of those of them that have ended; unlike wall clock time it does not depend on what else the machine does. */
export function effort(root) {
  const seconds = new Map(), parent = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /, "").split(" ").map(Number);
      parent.set(+pid, fields[1]);
      seconds.set(+pid, (fields[11] + fields[12] + fields[13] + fields[14]) / 100); // the clock of Linux ticks a hundred times a second
    } catch {
      continue; // a process that has ended meanwhile
    }
  }
  const belongs = (pid) => pid === root || (parent.has(pid) && belongs(parent.get(pid)));
  return [...seconds].reduce((sum, [pid, own]) => sum + (belongs(pid) ? own : 0), 0);
}

/** `solidus open`, started in a folder. */
export class Server {
  static async open(program, folder, part) {
    const server = new Server();
    server.process = spawn(program, ["open", part, "--no-browser"], { cwd: folder, stdio: ["ignore", "pipe", "pipe"], detached: true });
    server.text = "";
    server.gone = new Promise((resolve) => server.process.once("exit", (code) => resolve(code)));
    await new Promise((resolve, reject) => {
      const heard = (data) => {
        server.text += data;
        if ((server.address = /http:\S+/.exec(server.text)?.[0])) resolve();
      };
      server.process.stdout.on("data", heard);
      server.process.stderr.on("data", heard);
      server.process.once("exit", () => reject(new Error(server.text)));
    });
    return server;
  }
  async state() {
    return (await fetch(`${this.address}state`)).json();
  }
  /** Until nothing is computed. */
  async rest(seconds = 120) {
    for (const end = Date.now() + 1000 * seconds * patience; Date.now() < end; await new Promise((r) => setTimeout(r, 100))) {
      const state = await this.state();
      if (!state.job) return state;
    }
    throw new Error(`the job does not end: ${JSON.stringify((await this.state()).job)}`);
  }
  /** Ctrl-C, which a terminal sends to the program and what it has started. */
  close() {
    process.kill(-this.process.pid, "SIGINT");
    return this.gone;
  }
}

/** A page of the workbench; every press of the mouse is counted. */
export class Desk {
  clicks = 0;
  static async open(browser, address, options = {}) {
    const desk = new Desk();
    desk.page = await browser.page(1360, 900, options);
    await desk.page.send("Network.emulateNetworkConditions", { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: -1 });
    if (options.noPictures) // as in a browser without WebGL
      await desk.page.send("Page.addScriptToEvaluateOnNewDocument", { source: "{ const own = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : own.call(this, kind, ...rest); }; }" });
    await desk.page.go(address);
    return desk;
  }
  /** A page behind another one is not drawn. */
  front() {
    return this.page.send("Page.bringToFront");
  }
  /** The value of an expression once it is not false. */
  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds * patience; Date.now() < end; await new Promise((r) => setTimeout(r, 100))) {
      const value = await this.page.run(`(() => { try { return ${expression}; } catch { return false; } })()`);
      if (value) return value;
    }
    throw new Error(`never came: ${expression}; the page says: ${await this.page.run("document.querySelector('#told').textContent + ' ' + document.querySelector('#job').textContent")}`);
  }
  /** A place [px] once it is the same in two pictures that follow each other: nothing moves it any more. */
  async atRest(expression) {
    for (let before = "", i = 0; i < 100 * patience; ++i, await this.page.settle()) {
      const at = await this.page.run(expression), now = JSON.stringify(at);
      if (at && now === before) return at;
      before = now;
    }
    throw new Error(`never at rest: ${expression}`);
  }
  /** Clicks an element in its middle, as the mouse does, once it can be clicked and stands still. */
  async click(selector) {
    await this.until(`!!document.querySelector('${selector}') && !document.querySelector('${selector}').disabled`);
    const [x, y] = await this.atRest(`(() => {
      const e = document.querySelector('${selector}');
      if (!e || e.disabled) return null;
      e.scrollIntoView({ block: 'center', behavior: 'instant' });
      const b = e.getBoundingClientRect();
      return [b.left + b.width / 2, b.top + b.height / 2];
    })()`);
    const on = await this.page.run(`(() => { const e = document.elementFromPoint(${x}, ${y}), w = document.querySelector('${selector}'); return e === w || w.contains(e) || (e?.id ?? '') + ' ' + (e?.className ?? ''); })()`);
    if (on !== true) throw new Error(`${selector} is covered by '${on}'`);
    ++this.clicks;
    await this.page.click(x, y);
  }
  /** Chooses of a list, which takes two clicks: one opens it, one chooses. Lists that are open belong to the system, so the second is made by the page. */
  async choose(selector, value) {
    await this.until(`!!document.querySelector('${selector}') && !document.querySelector('${selector}').disabled && [...document.querySelector('${selector}').options].some((o) => o.value === '${value}')`);
    this.clicks += 2;
    await this.page.run(`(() => { const e = document.querySelector('${selector}'); e.value = '${value}'; e.dispatchEvent(new Event('change', { bubbles: true })); })()`);
    await this.page.settle();
  }
  /** Types into a field and leaves it. */
  async type(selector, value) {
    await this.click(selector);
    await this.page.run(`document.querySelector('${selector}').select()`);
    await this.page.send("Input.insertText", { text: value });
    await this.page.run(`document.querySelector('${selector}').blur()`);
    await this.page.settle();
  }
  /** Clicks the picture where a place of the part [m] is seen. */
  async clickPlace(at) {
    const [x, y] = await this.atRest(`(() => {
      const { picture } = solidus.stage, box = picture.canvas.getBoundingClientRect(), [px, py] = picture.project(${JSON.stringify(at)});
      return [box.left + px, box.top + py];
    })()`);
    ++this.clicks;
    await this.page.click(x, y);
  }
}

export { Browser };
