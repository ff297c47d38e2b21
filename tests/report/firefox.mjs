// Firefox over its own protocol (Marionette): no package is needed. Without a screen of its own it has no WebGL, so it gets one of Xvfb,
// where Mesa draws by software.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const FIREFOX = ["/usr/bin/firefox-esr", "/usr/bin/firefox"].find((p) => existsSync(p));
export const SCREEN = ["/usr/bin/Xvfb"].find((p) => existsSync(p));

// No net, no first-run pages, nothing that the browser asks for by itself; WebGL by software too.
const PREFERENCES = {
  "marionette.port": 0, "network.manage-offline-status": false, "network.online": false, "webgl.force-enabled": true,
  "browser.shell.checkDefaultBrowser": false, "browser.startup.page": 0, "browser.aboutwelcome.enabled": false, "datareporting.policy.dataSubmissionEnabled": false,
  "toolkit.telemetry.enabled": false, "app.update.enabled": false, "extensions.update.enabled": false, "browser.safebrowsing.malware.enabled": false,
  "browser.safebrowsing.phishing.enabled": false, "services.settings.server": "data:,", "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false, "browser.newtabpage.enabled": false, "security.sandbox.content.level": 0,
};

export class Firefox {
  static async open() {
    const firefox = new Firefox();
    firefox.profile = mkdtempSync(join(tmpdir(), "solidus-firefox-"));
    writeFileSync(join(firefox.profile, "user.js"), Object.entries(PREFERENCES).map(([k, v]) => `user_pref(${JSON.stringify(k)}, ${JSON.stringify(v)});\n`).join(""));
    const display = await firefox.screen();
    firefox.process = spawn(FIREFOX, ["--marionette", "--remote-allow-system-access", "--no-remote", "--profile", firefox.profile, "about:blank"],
      { stdio: "ignore", env: { ...process.env, DISPLAY: display, LIBGL_ALWAYS_SOFTWARE: "1", HOME: firefox.profile } });
    const port = await firefox.port();
    firefox.waiting = new Map();
    firefox.next = 1;
    let rest = Buffer.alloc(0);
    await new Promise((resolve, reject) => {
      firefox.socket = connect(port, "127.0.0.1").on("error", reject);
      firefox.socket.on("data", (data) => {
        rest = Buffer.concat([rest, data]);
        for (let colon = rest.indexOf(":"); colon > 0; colon = rest.indexOf(":")) {
          const length = +rest.toString("latin1", 0, colon);
          if (rest.length < colon + 1 + length) break;
          const message = JSON.parse(rest.toString("utf8", colon + 1, colon + 1 + length));
          rest = rest.subarray(colon + 1 + length);
          Array.isArray(message) ? firefox.receive(message) : resolve();
        }
      });
    });
    await firefox.send("WebDriver:NewSession", { capabilities: { alwaysMatch: { timeouts: { script: 60000, pageLoad: 120000 } } } });
    return firefox;
  }
  /** Xvfb chooses a number that is free and writes it to its third channel. */
  async screen() {
    this.xvfb = spawn(SCREEN, ["-displayfd", "3", "-screen", "0", "1300x1000x24", "-nolisten", "tcp"], { stdio: ["ignore", "ignore", "ignore", "pipe"] });
    return `:${String(await new Promise((resolve) => this.xvfb.stdio[3].once("data", resolve))).trim()}`;
  }
  /** Firefox chooses it and writes it into its profile. */
  async port() {
    const file = join(this.profile, "MarionetteActivePort");
    for (const end = Date.now() + 120000; Date.now() < end; await new Promise((r) => setTimeout(r, 100)))
      if (existsSync(file) && +readFileSync(file, "utf8") > 0) return +readFileSync(file, "utf8");
    throw new Error("Firefox did not start within two minutes");
  }
  receive([, id, error, result]) {
    const { resolve, reject } = this.waiting.get(id);
    this.waiting.delete(id);
    error ? reject(new Error(`${error.error}: ${error.message}`)) : resolve(result?.value !== undefined ? result.value : result);
  }
  send(method, params = {}) {
    const id = this.next++, text = JSON.stringify([0, id, method, params]);
    this.socket.write(`${Buffer.byteLength(text)}:${text}`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  async go(url) {
    await this.send("Marionette:SetContext", { value: "chrome" });
    await this.script("Services.console.reset();");
    await this.send("Marionette:SetContext", { value: "content" });
    await this.send("WebDriver:Navigate", { url });
    await this.run('new Promise((done) => { const look = () => (performance.getEntriesByName("built").length ? done() : setTimeout(look, 10)); look(); })');
    await this.settle();
  }
  settle() {
    return this.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))))");
  }
  script(script) {
    return this.send("WebDriver:ExecuteScript", { script, args: [] });
  }
  /** What an expression is worth in the page, whose own names it sees as `page`. */
  run(expression) {
    return this.script(`const page = window.wrappedJSObject ?? window; return ${expression};`);
  }
  /** What the console has to say about a page: errors, warnings and console.log. */
  async messages(url) {
    await this.send("Marionette:SetContext", { value: "chrome" });
    const said = await this.script(`
      const api = Cc["@mozilla.org/consoleAPI-storage;1"].getService(Ci.nsIConsoleAPIStorage).getEvents().map((e) => [e.filename, e.level + ": " + e.arguments.join(" ")]);
      const errors = Services.console.getMessageArray().filter((m) => m instanceof Ci.nsIScriptError).map((m) => [m.sourceName, m.errorMessage]);
      return [...api, ...errors];`);
    await this.send("Marionette:SetContext", { value: "content" });
    return said.filter(([source]) => source?.startsWith(url.slice(0, 60))).map(([, text]) => text);
  }
  async screenshot() {
    return Buffer.from(await this.send("WebDriver:TakeScreenshot", { full: false }), "base64");
  }
  /** A click with the mouse, at a place of the window. */
  async click(x, y) {
    const actions = [{ type: "pointerMove", duration: 0, x, y, origin: "viewport" }, { type: "pointerDown", button: 0 }, { type: "pointerUp", button: 0 }];
    await this.send("WebDriver:PerformActions", { actions: [{ type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions }] });
    await this.settle();
  }
  async close() {
    const gone = new Promise((resolve) => this.process.once("exit", resolve));
    await Promise.race([this.send("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => {}), new Promise((r) => setTimeout(r, 5000))]);
    const timer = setTimeout(() => this.process.kill("SIGKILL"), 5000);
    await gone;
    clearTimeout(timer);
    this.socket.destroy();
    this.xvfb.kill();
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 });
  }
}
