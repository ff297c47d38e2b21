"""Assistants: the server of the Model Context Protocol, driven by a client over pipes."""

import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest

from cooling_block import CASE
from mcp_client import Client, misfits
from program import PATIENCE, SOURCES, ProgramTest, solidus

from solidus_casting.mcp import landlock
from solidus_casting.toml_text import document_text

WITH_LANDLOCK = landlock.version() > 0
OPTIONS = [] if WITH_LANDLOCK else ["--trust-files"]
SECRET = "[analysis]\nkind = 'of nobody else 4711'\n"


class McpTest(ProgramTest):
    """A folder, and a session in it; what a test leaves running is ended."""

    def setUp(self):
        super().setUp()
        self.room, self.temporary = self.folder / "room", self.folder / "temporary"
        self.room.mkdir()
        self.temporary.mkdir()
        self.case("block")

    def case(self, name, **changes):
        """Writes the case of a block that cools, with sections changed."""
        self.write(f"room/{name}/case.toml", document_text({**CASE, **changes}))

    def session(self, version="2025-11-25", cwd=None):
        client = Client(self.room, *OPTIONS, cwd=cwd, temporary=self.temporary)
        self.addCleanup(lambda: client.process.poll() is None and (client.process.kill(), client.close()))
        self.information = client.initialize(version)
        self.tools = {tool["name"]: tool for tool in client.ask("tools/list")["result"]["tools"]}
        return client

    def good(self, client, tool, **arguments):
        """The structured result of a call that must succeed; its text is the same."""
        result = client.call(tool, **arguments)
        self.assertFalse(result["isError"], result)
        found = result["structuredContent"]
        self.assertEqual(json.loads(result["content"][0]["text"]), found)
        self.assertEqual(misfits(self.tools[tool]["outputSchema"], found), [])
        return found

    def wrong(self, client, tool, **arguments):
        """The error of a call that must fail."""
        result = client.call(tool, **arguments)
        self.assertTrue(result["isError"], result)
        self.assertEqual(misfits(self.tools[tool]["outputSchema"], result["structuredContent"]), [])
        error = result["structuredContent"]["error"]
        self.assertEqual(result["content"], [{"type": "text", "text": error["message"]}])
        self.assertNotIn("4711", json.dumps(result))
        return error


class Protocol(McpTest):
    def test_the_version_is_that_of_the_client_where_it_is_served_else_the_newest(self):
        for asked, given in (("2025-11-25", "2025-11-25"), ("2025-06-18", "2025-06-18"), ("2024-11-05", "2025-11-25"),
                             ("2099-01-01", "2025-11-25")):
            client = self.session(asked)
            self.assertEqual(self.information["protocolVersion"], given)
            self.assertEqual(self.information["capabilities"], {"tools": {}})
            self.assertEqual(self.information["serverInfo"]["name"], "solidus")
            self.assertEqual(client.close(), 0)

    def test_tools_are_those_that_the_guide_names_with_schemas_of_what_they_take_and_give(self):
        client = self.session()
        self.assertEqual(list(self.tools), ["new", "check", "run", "report", "compare", "materials", "explain"])
        for name, tool in self.tools.items():
            for schema in (tool["inputSchema"], tool["outputSchema"]):
                self.assertEqual((schema["type"], schema["additionalProperties"]), ("object", False), name)
            self.assertEqual(tool["annotations"]["openWorldHint"], False)
            self.assertIn(f"`{name}`", (SOURCES / "docs/guide/assistants.md").read_text())
        self.assertTrue(self.tools["check"]["annotations"]["readOnlyHint"])
        self.assertFalse(self.tools["run"]["annotations"]["readOnlyHint"])
        self.assertEqual(client.close(), 0)

    def test_what_is_no_request_is_an_error_of_the_protocol_and_the_session_goes_on(self):
        client = Client(self.room, *OPTIONS)
        self.assertEqual(client.ask("tools/list")["error"]["code"], -32600)  # before initialize
        self.assertEqual(client.ask("ping")["result"], {})
        self.assertEqual(client.ask("initialize", {"capabilities": {}})["error"]["code"], -32602)
        client.initialize()
        self.assertEqual(client.ask("initialize", {"protocolVersion": "2025-11-25"})["error"]["code"], -32600)
        for line, code in (("{", -32700), ('[{"jsonrpc": "2.0", "id": 1, "method": "ping"}]', -32600), ('{"id": 1, "method": "ping"}', -32600),
                           ('{"jsonrpc": "2.0", "id": null, "method": "ping"}', -32600),
                           ('{"jsonrpc": "2.0", "id": 1, "method": "ping", "params": []}', -32602),
                           ('{"jsonrpc": "2.0", "id": 2, "method": "ping", "params": {"x": "' + "a" * (1 << 20) + '"}}', -32600)):
            client.send(line)
            self.assertEqual(client.answer()["error"]["code"], code, line[:80])
        for method, params, code, text in (
                ("resources/list", {}, -32601, "no method 'resources/list'"),
                ("tools/list", {"cursor": "2"}, -32602, "cursor"),
                ("tools/call", {"name": "runn"}, -32602, "no tool 'runn'"),
                ("tools/call", {"name": "check", "arguments": []}, -32602, "objects"),
                ("tools/call", {"name": "check", "_meta": {"progressToken": True}}, -32602, "progressToken")):
            error = client.ask(method, params)["error"]
            self.assertEqual(error["code"], code)
            self.assertIn(text, error["message"])
        client.notify("notifications/unheard_of")
        client.notify("notifications/cancelled", requestId=999)
        client.send('{"jsonrpc": "2.0", "id": 77, "result": {}}')
        self.assertEqual(client.ask("ping")["result"], {})
        self.assertEqual(client.close(), 0)

    def test_arguments_that_do_not_fit_are_results_from_which_an_assistant_can_learn(self):
        client = self.session()
        for tool, arguments, found, allowed in (
                ("check", {}, "the argument 'case' is missing", "case.toml"),
                ("check", {"case": "block", "phisics": "heat"}, "no argument 'phisics'", "did you mean 'physics'?"),
                ("check", {"case": "block", "physics": "chemistry"}, "not among the choices", "heat, thermomechanical"),
                ("check", {"case": 4}, "4 is no string", "case file"),
                ("check", {"case": "b" * 3000}, "there is no case", "`new` makes one"),
                ("check", {"case": "block", "set": {"time.step": None}}, "None", "a text"),
                ("check", {"case": "blocks"}, "there is no case 'blocks'", "`new` makes one"),
                ("new", {"part": "a.step", "alloy": "aluminium_alsi7mg", "fineness": 9}, "9 is out of range", "0.3 to 5"),
                ("report", {"results": []}, "0 entries", "1 to 16"),
                ("report", {"results": ["block"], "output": "block/case.toml"}, "is no page", ".html"),
                ("run", {"case": "block", "output": "block"}, "holds something else than results", "a new folder"),
                ("materials", {"name": "--output"}, "'--output' is none", "A material"),
                ("materials", {"name": "aluminium_alsi7"}, "there is no material 'aluminium_alsi7'", "aluminium_alsi7mg"),
                ("explain", {"key": "time.stp"}, "no key", "step")):
            error = self.wrong(client, tool, **arguments)
            self.assertEqual(error["kind"], "input", error)
            self.assertIn(found, error["found"])
            self.assertIn(allowed, error["allowed"])
        self.assertEqual(client.close(), 0)


class Tools(McpTest):
    def test_the_session_of_the_guide_gives_what_stands_there(self):
        page = (SOURCES / "docs/guide/assistants.md").read_text()
        asked = [json.loads(line) for line in page.splitlines() if line.startswith('{"name": ')]
        self.assertEqual([request["name"] for request in asked], ["new", "run", "report", "run", "compare", "run"])
        shutil.copy(SOURCES / "tests/parts/stepped_plate.step", self.room)
        client = self.session()
        made, cold, report, warm, compared = (self.good(client, request["name"], **request["arguments"]) for request in asked[:-1])
        self.assertEqual(made["case"], "plate")
        self.assertIn("freezes", made["text"])
        self.assertIn("The case is in order.", made["check"]["text"])
        again = self.wrong(client, asked[0]["name"], **asked[0]["arguments"])
        self.assertIn("plate", again["message"])
        self.assertNotIn(str(self.room), again["message"])  # paths are seen from the folder
        self.assertIn(report["page"], page)
        shown = {name: (float(value), float(error)) for name, value, error in
                 re.findall(r"`(results/\w+)`[^`]*?(\d+) ± (\d+) s", page)}
        for run in (cold, warm):
            froze = next(answer for answer in run["answers"] if answer["name"] == "casting: last melt froze")
            value, error = shown[run["results"]]  # another version of Gmsh makes another mesh
            self.assertAlmostEqual(froze["value"], value, delta=error)
            self.assertAlmostEqual(froze["error"], error, delta=error)
        clear = {row["name"]: row["clear"] for row in compared["answers"]}
        self.assertEqual((clear["casting: last melt froze"], clear["least Niyama"]), (True, False))
        self.assertIn(self.wrong(client, asked[-1]["name"], **asked[-1]["arguments"])["allowed"].partition("?")[0], page)
        self.assertEqual(client.close(), 0)

    def test_a_run_gives_its_answers_with_errors_and_findings_and_so_do_its_report_and_a_comparison(self):
        client = self.session()
        checked = self.good(client, "check", case="block", set={"time.end": "3 min"})
        self.assertIn("180 s", checked["text"])
        ran = self.good(client, "run", case="block", set={"time.end": "3 min"}, token="t-1")
        self.assertEqual((ran["results"], ran["outcome"], ran["end_time_s"]), ("results/block", "finished", 180))
        summary = json.loads((self.room / "results/block/summary.json").read_text())
        froze = next(answer for answer in ran["answers"] if answer["name"] == "block: last melt froze")
        stated = summary["answers"]["castings"]["block"]["last_melt_froze"]
        self.assertEqual((froze["unit"], froze["value"], froze["error"]), ("s", stated["value[s]"], stated["error[s]"]))
        self.assertEqual(ran["places_si"], summary["answers"])
        self.assertEqual(len(ran["findings"]), len(summary["warnings"]))
        self.assertEqual([finding["message"] for finding in ran["findings"]], [finding["message"] for finding in checked["findings"]])

        told = [note["params"] for note in client.notifications]
        self.assertEqual({note["progressToken"] for note in told}, {"t-1"})
        self.assertEqual({note["total"] for note in told}, {180.0})
        done = [note["progress"] for note in told]
        self.assertEqual(done, sorted(set(done)))

        page = self.good(client, "report", results=["results/block"])
        self.assertEqual((page["page"], page["runs"]), ("results/block/report.html", [ran]))
        self.assertGreater((self.room / page["page"]).stat().st_size, 100_000)
        self.good(client, "run", case="block", set={"time.end": "3 min", "body.block.initial_temperature": "750 degC"}, output="hot")
        compared = self.good(client, "compare", results="results/block", other="hot")
        later = next(row for row in compared["answers"] if row["name"] == "block: last melt froze")
        self.assertAlmostEqual(later["difference"], later["second"] - later["first"])
        self.assertEqual(later["error_of_first"], froze["error"])
        self.assertEqual(later["clear"], later["difference"] > later["error_of_first"] + later["error_of_second"])
        self.assertIn(("temperature", "K"), [(row["name"], row["unit"]) for row in compared["fields"]])
        self.assertIn(("T_inside", "K"), [(row["name"], row["unit"]) for row in compared["curves"]])
        self.assertEqual(client.close(), 0)

    def test_a_case_that_check_refuses_is_not_run_and_what_it_doubts_is_told(self):
        client = self.session()
        for tool in ("check", "run"):
            error = self.wrong(client, tool, case="block", set={"thermal_condition.air.group": "x_mx"})
            self.assertIn("x_mx", error["found"])
            self.assertIn("x_max", error["allowed"])
        self.assertFalse((self.room / "results").exists())
        self.write("room/block/wrong.toml", 'include = "case.toml"\n[time]\nstep = "6 parsec"\n')
        error = self.wrong(client, "check", case="block/wrong.toml")
        self.assertEqual((error["file"], error["line"]), ("block/wrong.toml", 3))
        self.assertIn("parsec", error["found"])
        doubted = self.good(client, "check", case="block", set={"thermal_condition.air.coefficient": "0.2 W/m2/K"})
        self.assertTrue(any("0.2" in finding["message"] for finding in doubted["findings"]), doubted["findings"])
        self.assertTrue(all(finding["file"].startswith("block/case.toml") for finding in doubted["findings"] if "file" in finding))
        self.assertEqual(client.close(), 0)

    def test_a_run_that_cannot_go_on_is_an_error_of_its_own_kind(self):
        client = self.session()
        self.case("frozen", thermal_condition=[{"name": "sink", "group": "block", "kind": "source", "power": "-1e12 W/m3"}])
        error = self.wrong(client, "run", case="frozen")
        self.assertEqual(error["kind"], "stopped", error)
        self.assertIn("could not go on", error["message"])
        self.assertEqual(client.close(), 0)

    def test_materials_and_keys_are_explained(self):
        client = self.session()
        names = [material["name"] for material in self.good(client, "materials")["materials"]]
        self.assertIn("aluminium_alsi7mg", names)
        card = self.good(client, "materials", name="aluminium_alsi7mg")
        self.assertIn("A356", card["text"])
        self.assertIn("latent_heat", [row["property"] for row in card["spread"]])
        self.assertIn("quantity [s]", self.good(client, "explain", key="time.step")["text"])
        self.assertIn("latent_heat", self.good(client, "explain", key="phase_change.latent_heat", file="material")["text"])
        self.assertEqual(client.close(), 0)


class Cancellation(McpTest):
    def wait_for(self, condition):
        limit = time.monotonic() + 60 * PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), limit)
            time.sleep(0.05)

    def long_run(self, client):
        number = client.request("tools/call", {"name": "run", "arguments": {
            "case": "block", "set": {"time.step": "0.002 s", "time.adaptive": False}, "output": "long"},
            "_meta": {"progressToken": 5}})
        self.wait_for(lambda: client.notifications)
        return number

    def test_a_run_that_is_cancelled_stops_behind_a_step_is_not_answered_and_goes_on_from_there(self):
        client = self.session()
        number = self.long_run(client)
        self.assertEqual(client.ask("ping")["result"], {})  # while it runs
        waiting = client.request("tools/call", {"name": "check", "arguments": {"case": "block"}})
        client.notify("notifications/cancelled", requestId=number, reason="enough")
        answer = client.answer()  # of the check, which had to wait; the run has none
        self.assertEqual(answer["id"], waiting)
        summary = self.summary(self.room / "long")
        self.assertEqual(summary["outcome"], "stopped: as asked")
        told = len(client.notifications)
        gone_on = self.good(client, "run", case="block", set={"time.step": "6 s", "time.adaptive": True}, output="long", restart=True)
        self.assertEqual((gone_on["outcome"], gone_on["end_time_s"]), ("finished", 60))
        self.assertGreater(gone_on["steps"], summary["steps"])
        self.assertEqual(len(client.notifications), told)  # without a token nothing is told
        self.assertEqual(client.close(), 0)

    def test_with_the_end_of_the_input_what_runs_is_stopped(self):
        client = self.session()
        self.long_run(client)
        self.assertEqual(client.close(), 0)
        self.assertEqual(self.summary(self.room / "long")["outcome"], "stopped: as asked")
        left = [file.name for file in self.temporary.iterdir() if not file.name.startswith("ompi.")]
        self.assertEqual(left, [])  # Open MPI 5 keeps an empty folder that all processes of a user share


class Confinement(McpTest):
    def setUp(self):
        super().setUp()
        self.outside = self.write("outside/secret.toml", SECRET)
        (self.room / "leads_out").symlink_to(self.outside.parent)

    def test_arguments_that_lead_out_of_the_folder_are_refused(self):
        client = self.session()
        self.write("outside/case.toml", document_text(CASE))
        for path in (str(self.outside.parent), "../outside", "leads_out", "block/../../outside", "leads_out/case.toml"):
            for tool, arguments in (("check", {"case": path}), ("run", {"case": "block", "output": path + "/results"}),
                                    ("report", {"results": [path]}), ("compare", {"results": path, "other": path}),
                                    ("new", {"part": path + "/part.step", "alloy": "aluminium_alsi7mg"}),
                                    ("new", {"part": "part.step", "alloy": path + "/secret.toml"}),
                                    ("new", {"part": "part.step", "alloy": "aluminium_alsi7mg", "folder": path + "/new"}),
                                    ("materials", {"name": path + "/secret.toml"})):
                error = self.wrong(client, tool, **arguments)
                self.assertIn("lies outside of the folder of the server", error["found"], (tool, arguments))
        self.assertEqual(sorted(path.name for path in self.outside.parent.iterdir()), ["case.toml", "secret.toml"])
        self.assertEqual(client.close(), 0)

    def test_files_that_a_case_names_are_refused_where_they_lie_outside(self):
        for name, changes in (("include", {"include": "../../outside/secret.toml"}), ("mesh", {"mesh": {"file": str(self.outside)}}),
                              ("card", {"body": [{**CASE["body"][0], "material": "../leads_out/secret.toml"}]}),
                              ("table", {"thermal_condition": [{**CASE["thermal_condition"][0], "ambient": {"file": "/etc/passwd"}}]}),
                              ("nested", {"include": ["base.toml"]})):
            self.case(name, **changes)
        self.write("room/nested/base.toml", 'include = "../leads_out/secret.toml"\n')
        client = self.session()
        for name in ("include", "mesh", "card", "table", "nested"):
            for tool in ("check", "run"):
                error = self.wrong(client, tool, case=name)
                self.assertIn("lies outside of the folder of the server", error["found"], name)
                self.assertEqual(error["file"], "nested/base.toml" if name == "nested" else f"{name}/case.toml")
        for value in ({"body.block.material": "../leads_out/secret.toml"}, {"mesh.file": "/etc/passwd"},
                      {"thermal_condition.air.ambient": {"file": "../../outside/secret.toml"}}):
            self.assertIn("lies outside", self.wrong(client, "check", case="block", set=value)["found"])
        self.assertEqual(client.close(), 0)

    def test_a_summary_that_no_run_has_written_is_an_error_of_its_own(self):
        client = self.session()
        self.good(client, "run", case="block")
        for text in ("{", "[]", '{"answers": []}', '{"answers": {"relative_energy_defect": NaN}}', '{"warnings": 3}'):
            self.write("room/results/block/summary.json", text)
            error = self.wrong(client, "report", results=["results/block"])
            self.assertIn("summary", error["message"], text)
        self.assertEqual(client.close(), 0)

    def test_results_with_a_link_that_leads_out_are_refused(self):
        client = self.session()
        self.good(client, "run", case="block")
        (self.room / "results/block/pools.csv").unlink(missing_ok=True)
        (self.room / "results/block/pools.csv").symlink_to(self.outside)
        for tool, arguments in (("report", {"results": ["results/block"]}), ("compare", {"results": "results/block", "other": "results/block"})):
            self.assertIn("lies outside", self.wrong(client, tool, **arguments)["found"])
        self.assertEqual(client.close(), 0)

    def test_scripts_and_laws_of_a_case_are_not_trusted(self):
        self.write("room/script/box.geo", f'SetFactory("OpenCASCADE");\nBox(1) = {{0, 0, 0, 1, 1, 1}};\nSystemCall "touch {self.room}/made";\n')
        self.case("script", analysis={"kind": "solid", "physics": "heat"}, mesh={"file": "box.geo"}, probe=[])
        client = self.session()
        self.assertIn("SystemCall", self.wrong(client, "check", case="script")["message"])
        self.assertIn("SystemCall", self.wrong(client, "run", case="script")["message"])
        self.assertFalse((self.room / "made").exists())
        self.assertEqual(client.close(), 0)

    def test_python_takes_no_module_from_the_folder(self):
        for module in ("numpy", "json", "solidus_casting", "solidus_plots", "matplotlib"):
            self.write(f"room/{module}.py", f"open({str(self.room / 'made')!r}, 'w')\nraise ImportError('taken')\n")
        client = self.session(cwd=self.room)
        self.good(client, "run", case="block", set={"time.end": "3 min"})
        self.good(client, "compare", results="results/block", other="results/block")
        self.assertEqual(client.close(), 0)
        self.assertEqual(solidus("compare", "results/block", "results/block", "--no-plots", cwd=self.room).returncode, 0)
        self.assertFalse((self.room / "made").exists())
        unsafe = subprocess.run([sys.executable, "-m", "solidus_casting.mcp", str(self.room)], capture_output=True, text=True, input="",
                                env={**os.environ, "PYTHONPATH": str(SOURCES / "python")}, cwd=self.folder, timeout=60 * PATIENCE)
        self.assertEqual((unsafe.returncode, unsafe.stdout), (1, ""))
        self.assertIn("python3 -P -m solidus_casting.mcp", unsafe.stderr)

    @unittest.skipUnless(WITH_LANDLOCK, "this kernel has no Landlock")
    def test_the_system_refuses_other_files_and_programs_of_the_folder_and_connections(self):
        program = self.write("room/program", "#!/bin/sh\necho started\n")
        program.chmod(0o755)
        script = f"""
import socket, subprocess, sys, tempfile
from pathlib import Path
from solidus_casting.mcp.room import Room
temporary = Path(tempfile.mkdtemp())
without_network = Room({str(self.room)!r}).confine(temporary)
def refused(action):
    try:
        action()
    except PermissionError:
        return True
    return False
inside = Path({str(self.room)!r})
(inside / "new").write_text("x")
print(refused(lambda: Path({str(self.outside)!r}).read_text()), refused(lambda: (inside / "leads_out/secret.toml").read_text()),
      refused(lambda: Path({str(self.folder)!r}, "new").write_text("x")), refused(lambda: Path({str(self.outside)!r}).unlink()),
      refused(lambda: (inside / "link").symlink_to("/etc")), refused(lambda: subprocess.run([inside / "program"])),
      not without_network or refused(lambda: socket.socket().connect(("127.0.0.1", 9))),
      subprocess.run(["cat", {str(self.outside)!r}], capture_output=True).returncode)
"""
        done = subprocess.run([sys.executable, "-P", "-c", script], capture_output=True, text=True, timeout=60 * PATIENCE,
                              env={**os.environ, "PYTHONPATH": str(SOURCES / "python")})
        self.assertEqual(done.stdout.split(), ["True"] * 7 + ["1"], done.stderr)

    @unittest.skipUnless(WITH_LANDLOCK, "this kernel has no Landlock")
    def test_what_files_name_that_the_server_does_not_read_is_refused_by_the_system(self):
        nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
        self.write("outside/nodes.inp", nodes)
        self.write("room/mesh/mesh.inp", f"*NODE, INPUT={self.outside.parent}/nodes.inp\n*ELEMENT, TYPE=C3D4, ELSET=block\n1, 1, 2, 3, 4\n")
        self.case("mesh", analysis={"kind": "solid", "physics": "heat"}, mesh={"file": "mesh.inp"}, probe=[])
        client = self.session()
        error = self.wrong(client, "check", case="mesh")
        self.assertNotIn("group", error["message"])  # the file was not read as far as that
        self.assertEqual(client.close(), 0)

    def test_a_system_that_cannot_refuse_files_is_told_and_has_to_be_trusted(self):
        script = "from solidus_casting.mcp import landlock, __main__\nlandlock.version = lambda: 0\nimport sys\nsys.exit(__main__.main())"
        for options, code in (([], 1), (["--trust-files"], 0)):
            done = subprocess.run([sys.executable, "-P", "-c", script, str(self.room), *options], capture_output=True, text=True, input="",
                                  env={**os.environ, "PYTHONPATH": str(SOURCES / "python")}, timeout=60 * PATIENCE)
            self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
            self.assertIn("Landlock", done.stderr)
        self.assertNotEqual(Client(self.folder / "nowhere").close(), 0)


if __name__ == "__main__":
    unittest.main()
