// A headless Chromium over a pipe, by its own protocol: no package is needed.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((p) => existsSync(p));

export class Browser {
  static async open() {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), "solidus-report-"));
    browser.process = spawn(CHROMIUM, [
      "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe", `--user-data-dir=${browser.profile}`,
      "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking", "--disable-component-update",
      "--disable-extensions", "--hide-scrollbars", "--mute-audio", "--lang=en-US",
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.waiting = new Map();
    browser.listeners = [];
    browser.next = 1;
    let rest = "";
    browser.process.stdio[4].on("data", (data) => {
      rest += data.toString("utf8");
      const parts = rest.split("\0");
      rest = parts.pop();
      for (const part of parts) browser.receive(JSON.parse(part));
    });
    return browser;
  }
  receive(message) {
    if (message.id) {
      const { resolve, reject } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      message.error ? reject(new Error(message.error.message)) : resolve(message.result);
    } else for (const listener of this.listeners) listener(message);
  }
  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  async page(width, height, { dark = false, mobile = false } = {}) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await page.send(`${domain}.enable`);
    await page.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile });
    await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    await page.send("Network.emulateNetworkConditions", { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
    return page;
  }
  async close() {
    const gone = new Promise((resolve) => this.process.once("exit", resolve));
    await Promise.race([this.send("Browser.close").catch(() => {}), new Promise((r) => setTimeout(r, 3000))]);
    const timer = setTimeout(() => this.process.kill("SIGKILL"), 3000);
    await gone;
    clearTimeout(timer);
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 });
  }
}

export class Page {
  /** What the console, the log and the network said. */
  messages = [];
  requests = [];
  constructor(browser, session) {
    this.browser = browser;
    this.session = session;
    browser.listeners.push((m) => {
      if (m.sessionId !== session) return;
      if (m.method === "Runtime.consoleAPICalled") this.messages.push(`${m.params.type}: ${m.params.args.map((a) => a.value ?? a.description).join(" ")}`);
      if (m.method === "Runtime.exceptionThrown") this.messages.push(`exception: ${m.params.exceptionDetails.exception?.description ?? m.params.exceptionDetails.text}`);
      if (m.method === "Log.entryAdded") this.messages.push(`${m.params.entry.level}: ${m.params.entry.text}`);
      if (m.method === "Network.requestWillBeSent") this.requests.push(m.params.request.url);
      if (m.method === "Page.javascriptDialogOpening") this.messages.push(`dialog: ${m.params.message}`);
    });
  }
  send(method, params = {}) {
    return this.browser.send(method, params, this.session);
  }
  async go(url) {
    const loaded = new Promise((resolve) => this.browser.listeners.push((m) => m.sessionId === this.session && m.method === "Page.loadEventFired" && resolve()));
    await this.send("Page.navigate", { url });
    await loaded;
    await this.built();
    await this.settle();
  }
  /** Until the sections below the picture are there, or the page has said why not. */
  built() {
    return this.run(`new Promise((done) => {
      const look = () => (performance.getEntriesByName("built").length || document.querySelector("#failure:not([hidden])") ? done() : setTimeout(look, 10));
      look();
    })`);
  }
  /** Until the page has drawn twice. */
  settle() {
    return this.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))))");
  }
  /** The value of an expression; asked again where the page, which follows a run, reloads itself meanwhile. */
  async run(expression) {
    for (let attempt = 1; ; ++attempt) {
      let answer;
      try {
        answer = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
      } catch (error) {
        if (attempt === 5 || !/navigated|context/.test(error.message)) throw error;
        continue;
      }
      const { result, exceptionDetails } = answer;
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    }
  }
  async screenshot(options = {}) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", ...options });
    return Buffer.from(data, "base64");
  }
  async mouse(type, x, y, extra = {}) {
    await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, ...extra });
  }
  async click(x, y, extra = {}) {
    await this.mouse("mouseMoved", x, y, { buttons: 0, button: "none", ...extra });
    await this.mouse("mousePressed", x, y, extra);
    await this.mouse("mouseReleased", x, y, extra);
    await this.settle();
  }
  async drag(x0, y0, x1, y1) {
    await this.mouse("mousePressed", x0, y0);
    for (let i = 1; i <= 5; ++i) await this.mouse("mouseMoved", x0 + ((x1 - x0) * i) / 5, y0 + ((y1 - y0) * i) / 5);
    await this.mouse("mouseReleased", x1, y1);
    await this.settle();
  }
  async key(key) {
    const code = key.length === 1 ? { text: key, key } : { key };
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", ...code });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key });
    await this.settle();
  }
}
