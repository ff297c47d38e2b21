// `solidus mcp` and the client of npm's @modelcontextprotocol/sdk: node client_test.mjs PROGRAM FOLDER. The client holds every result
// to the schema that its tool declares. Each check is a sentence; the last line counts them.
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Client, LATEST_PROTOCOL_VERSION, StdioClientTransport } from "./built/client.mjs";

const program = resolve(process.argv[2]), folder = resolve(process.argv[3]);
const options = process.argv.slice(4); // of the server
const parts = join(dirname(fileURLToPath(import.meta.url)), "../parts");
const patience = 1000 * 300 * Number(process.env.SOLIDUS_TEST_PATIENCE ?? 1); // [ms]
let passed = 0, failed = 0;
function check(sentence, holds, detail = "") {
  holds ? ++passed : ++failed;
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds ? "" : `: ${JSON.stringify(detail)}`}`);
}
async function refusal(action) {
  try {
    return { result: await action() };
  } catch (error) {
    return { error };
  }
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
copyFileSync(join(parts, "stepped_plate.step"), join(folder, "plate.step"));
const transport = new StdioClientTransport({ command: program, args: ["mcp", folder, ...options], env: process.env, stderr: "pipe" });
let heard = "";
transport.stderr?.on("data", (data) => (heard += data));
const client = new Client({ name: "solidus-test", version: "1.0.0" }, { capabilities: {} });
const strange = [];
client.onerror = (error) => strange.push(String(error));
await client.connect(transport);
const call = (name, args, more = {}) => client.callTool({ name, arguments: args }, undefined, { timeout: patience, ...more });

check("the server names itself, and says how to use it", client.getServerVersion()?.name === "solidus" && client.getInstructions()?.includes("finding"));
check("the newest version of the protocol is spoken", transport.protocolVersion === undefined || transport.protocolVersion === LATEST_PROTOCOL_VERSION);
const { tools } = await client.listTools();
check("there are seven tools, each with schemas of what it takes and gives", tools.length === 7 && tools.every((tool) => tool.inputSchema && tool.outputSchema), tools);
check("a ping is answered", JSON.stringify(await client.ping()) === "{}");

const made = await call("new", { part: "plate.step", alloy: "aluminium_alsi7mg", fineness: 0.5 });
check("a case is made from a STEP file", !made.isError && made.structuredContent.case === "plate", made);
check("with what `check` finds in it", made.structuredContent.check.text.includes("The case is in order."), made.structuredContent);
const checked = await call("check", { case: "plate", physics: "heat" });
check("the case is checked", !checked.isError && Array.isArray(checked.structuredContent.findings), checked);

const told = [];
const ran = await call("run", { case: "plate", physics: "heat" }, { onprogress: (progress) => told.push(progress) });
const froze = ran.structuredContent?.answers?.find((answer) => answer.name.endsWith("last melt froze"));
check("a run answers when the casting froze, with an error", !ran.isError && froze?.value > 1 && froze?.error > 0, ran);
check("and tells its progress, which grows", told.length > 1 && told.every((each, i) => i === 0 || each.progress > told[i - 1].progress), told);
const page = await call("report", { results: ["results/plate"] });
check("the report is a page in the folder", readFileSync(join(folder, page.structuredContent.page), "utf8").startsWith("<!doctype html>"), page);
const warm = await call("run", { case: "plate", physics: "heat", set: { "body.mould.initial_temperature": "200 degC" }, output: "results/warm" });
check("a run with another value is made", !warm.isError, warm);
const compared = await call("compare", { results: "results/plate", other: "results/warm" });
const later = compared.structuredContent?.answers?.find((row) => row.name.endsWith("last melt froze"));
check("two runs are compared, and the warm mould is clearly slower", later?.difference > 0 && later?.clear === true, compared);

const wrong = await call("run", { case: "plate", set: { "time.stp": "1 s" } });
check("a wrong key is an error of the tool, with what is allowed", wrong.isError && wrong.structuredContent.error.allowed.includes("step"), wrong);
const outside = await call("check", { case: "../plate" });
check("a path that leads out is refused", outside.isError && outside.structuredContent.error.found.includes("lies outside"), outside);
const unknown = await refusal(() => call("mesh", {}));
check("a tool that does not exist is an error of the protocol", unknown.error?.code === -32602, unknown);

const stop = new AbortController();
const cancelled = await refusal(() => call("run", { case: "plate", physics: "heat", set: { "time.step": "0.01 s", "time.adaptive": false, "time.until": "end" },
  output: "results/long" }, { signal: stop.signal, onprogress: () => stop.abort("enough") }));
check("a run that is cancelled gives nothing", cancelled.error !== undefined, cancelled);
check("and has stopped when the next one is answered", !(await call("check", { case: "plate", physics: "heat" })).isError);
check("with a summary of how far it came", JSON.parse(readFileSync(join(folder, "results/long/summary.json"), "utf8")).outcome === "stopped: as asked");
await client.close();
check("nothing came that is no message", strange.length === 0, strange);
check("and no trace of a mistake", !heard.includes("Traceback"), heard);
check("nothing was left next to the folder", !existsSync(join(folder, "../plate")));
console.log(`${passed} hold, ${failed} do not`);
process.exit(failed ? 1 : 0);
