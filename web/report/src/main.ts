/** The page: reads its data, builds the sections, joins picture, curves and keys. */
import { byId, h } from "./dom";
import { drawForPaper, onTimePicked, redrawCharts } from "./charts";
import { Page } from "./run";
import { Workbench } from "./workbench";
import { buildHead } from "./head";
import { buildSections } from "./sections";

function theme(): void {
  const kept = (() => {
    try {
      return localStorage.getItem("solidus-theme");
    } catch {
      return null;
    }
  })();
  document.documentElement.dataset.theme = kept ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

function keysDialog(): void {
  const dialog = byId<HTMLDialogElement>("keys");
  const keys: [string, string][] = [
    ["Space", "play the moments"], ["← →", "moment before, after"], ["Home End", "first, last moment"], ["[ ]", "field before, after"],
    ["C", "cut on, off"], [", .", "move the cut"], ["M", "elements on, off"], ["F", "fit the picture"], ["1 … 6", "look along an axis"], ["7", "look from a corner"],
    ["T", "dark, light"], ["Esc", "take marks away"], ["?", "this list"],
  ];
  dialog.replaceChildren(
    h("h3", {}, "Keys"),
    h("dl", { class: "keys" }, ...keys.flatMap(([key, text]) => [h("dt", {}, ...key.split(" ").map((k) => h("kbd", {}, k))), h("dd", {}, text)])),
    h("p", { class: "hint" }, "Drag turns the picture, with Shift or the right button it moves it; the wheel zooms once the picture has been clicked. A click on a body shows the curves of that node, a click with Shift ends a line to the click before."),
    h("form", { method: "dialog" }, h("button", {}, "Close")),
  );
  byId("help").addEventListener("click", () => dialog.showModal());
}

/** Served by `solidus run --watch`: looks for a newer page and keeps what the reader has chosen. */
function watch(bench: Workbench): void {
  const key = "solidus-watch";
  const kept = sessionStorage.getItem(key);
  if (kept) bench.restore(JSON.parse(kept));
  const badge = document.querySelector<HTMLElement>("#head .badge");
  if (badge && badge.textContent === "not ended") {
    badge.textContent = "running";
    document.querySelectorAll("#warnings li").forEach((li) => li.textContent!.startsWith("There is no summary.json") && li.remove());
    if (!document.querySelector("#warnings li")) document.querySelector("#warnings")?.remove();
  }
  let busy = false, failures = 0;
  addEventListener("pointerdown", () => (busy = true));
  addEventListener("pointerup", () => (busy = false));
  const look = async () => {
    const mine = document.getElementById("stamp")?.textContent;
    try {
      const response = await fetch("stamp", { cache: "no-store" });
      const stamp = response.ok ? await response.text() : undefined;
      failures = 0;
      if (stamp && stamp !== mine && !busy) {
        sessionStorage.setItem(key, JSON.stringify(bench.state()));
        location.reload();
        return;
      }
    } catch {
      if (++failures === 2) {
        const finished = badge?.textContent === "finished";
        if (badge && !finished) badge.textContent = "no more news";
        byId("head").append(h("div", { class: "notice" }, "The run has ended: this page stays as it is. `solidus report` writes it as a file."));
        return;
      }
    }
    setTimeout(look, 1500);
  };
  setTimeout(look, 1500);
}

/** Builds head and picture. Returns what builds the sections below them. */
function start(): () => void {
  theme();
  keysDialog();
  const page = new Page();
  const bench = new Workbench(page);
  buildHead(page, bench);
  bench.begin();
  onTimePicked((time) => bench.goTo(time));
  byId("made").textContent = `Written by Solidus ${page.meta.solidus}, ${page.meta.made}. The page needs no net; numbers of fields are right to 1/16 000 of the range that their field has in the run.`;
  byId("theme").addEventListener("click", () => {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    try {
      localStorage.setItem("solidus-theme", root.dataset.theme);
    } catch {
      // A browser that keeps nothing for files asks again next time.
    }
    redrawCharts();
    bench.update();
  });
  return () => {
    const nav: [string, string][] = [["top", "Summary"]];
    if (bench.ready) nav.push(["view", "Picture"]);
    nav.push(...buildSections(page, bench));
    byId("nav").append(...nav.map(([id, text]) => h("a", { href: `#${id}` }, text)));
    if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
    if (location.protocol === "http:") watch(bench);
    (window as unknown as { solidus: unknown }).solidus = { page, bench };
  };
}

function forPaper(finish: () => void): void {
  let onScreen = "";
  byId("print").addEventListener("click", () => window.print());
  addEventListener("beforeprint", () => {
    finish();
    onScreen = document.documentElement.dataset.theme ?? "light";
    document.documentElement.dataset.theme = "light";
    document.querySelectorAll<HTMLDetailsElement>("main details").forEach((d) => (d.open = true));
    drawForPaper(true);
  });
  addEventListener("afterprint", () => {
    document.documentElement.dataset.theme = onScreen;
    drawForPaper(false);
    (window as unknown as { solidus: { bench: Workbench } }).solidus.bench.update();
  });
}

function failed(error: unknown): never {
  const box = byId("failure");
  box.hidden = false;
  box.textContent = `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
  throw error;
}

try {
  performance.mark("start");
  const sections = start();
  // The picture comes to the screen before the sections are built; a page in the background, which is not drawn, does not wait for it.
  let done = false;
  const finish = () => {
    if (done) return;
    done = true;
    try {
      sections();
      performance.mark("built");
    } catch (error) {
      failed(error);
    }
  };
  forPaper(finish);
  requestAnimationFrame(() => setTimeout(finish));
  setTimeout(finish, 1000);
} catch (error) {
  failed(error);
}
