// Builds the viewer into one file: src/*.ts and the packages by esbuild, with styles and licences in it.
// `node build.mjs OUT`; without OUT built/viewer.html.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const read = (file) => readFileSync(join(here, file), "utf8");
const common = { bundle: true, minify: true, write: false, absWorkingDir: here, legalComments: "none", charset: "ascii", target: "es2021" };
const script = (await build({ ...common, entryPoints: ["src/main.ts"], format: "iife" })).outputFiles[0].text.trim();
const style = (await build({ ...common, entryPoints: ["src/style.css"] })).outputFiles[0].text.trim();

const licences = ["three", "uplot", "fflate"].map((name) => {
  const { version, license, homepage } = JSON.parse(read(`node_modules/${name}/package.json`));
  return `${name} ${version}, ${license}${homepage ? `, ${homepage}` : ""}\n\n${read(`node_modules/${name}/LICENSE`).trim()}`;
});
const solidus = `Solidus, the viewer of reports, BSD-3-Clause\n\n${read("../../LICENSE").trim()}`;
const maps = "Colour maps viridis, inferno and cividis: CC0 (S. van der Walt, N. Smith, E. Firing; J. Nunez, C. Anderson, R. Renslow);\nblue-red: K. Moreland, public domain. Colours of curves: M. Okabe, K. Ito.";
const escape = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/[\u0080-\uffff]/g, (c) => `&#${c.charCodeAt(0)};`);

// Nothing runs but the script whose fingerprint stands here, and nothing is loaded from anywhere.
const fingerprint = `sha256-${createHash("sha256").update(script).digest("base64")}`;
const policy = `default-src 'none'; script-src '${fingerprint}'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'`;
const page = `<!doctype html>
<!-- Written by Solidus: a report. Open it in a browser; it needs no net. -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="Solidus">
<title>Solidus report</title>
<style>${style}</style>
</head>
<body>
${read("src/page.html").trim().replace("<!--LICENCES-->", () => escape([solidus, ...licences, maps].join("\n\n\n")))}
<!--SOLIDUS-DATA-->
<script>${script}</script>
</body>
</html>
`;
const out = process.argv[2] ?? join(here, "built/viewer.html");
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
console.log(`${out}: ${(page.length / 1000).toFixed(0)} kB`);
