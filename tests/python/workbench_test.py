"""The workbench (`solidus open`): who is answered, what is changed in files, and that pages do not fight. The program is a stand-in here; the
page itself, with the program, is tested in a browser (tests/workbench)."""

import http.client
import json
import os
import pathlib
import stat
import struct
import tempfile
import threading
import time
import unittest
from unittest import mock

from solidus_casting import verbs
from solidus_casting.errors import InputError
from solidus_casting.workbench import choices, findings, runs, skin, toml_edit
from solidus_casting.workbench.case_folder import CaseFolder
from solidus_casting.workbench.server import Server

CASE = '''# Made for a test.
title = "a plate"   # what it is

[time]
end = "10 s"  # at the latest
points = [
  1,  # first
  2,
]

[[body]]   # the metal
name = "casting"
material = "pure_tin"

[body.start]
temperature = "300 degC"

# sand around it
[[body]]
name = "mould"
material = "green_sand"
'''

# A program that answers as solidus does, at once.
PROGRAM = '''#!/usr/bin/env python3
import pathlib, signal, sys, time
verb, words = sys.argv[1], sys.argv[2:]
given = dict(w[2:].split("=", 1) for w in words if w.startswith("--") and "=" in w)
last = words[-1] if words else ""
if verb == "version":
    print("Solidus 0.0.0")
elif verb == "materials":
    print("pure_tin   Pure tin\\ngreen_sand   Green sand")
elif verb == "mesh-info":
    if "hostile" in last:
        sys.exit("solidus: hostile.step: this file is refused")
    pathlib.Path(given["faces"]).write_text("# vtk DataFile Version 3.0\\nfaces [m]\\nASCII\\nDATASET POLYDATA\\nPOINTS 6 double\\n"
        "0 0 0\\n1 0 0\\n0 1 0\\n1 0 0\\n1 1 0\\n0 1 0\\nPOLYGONS 2 8\\n3 0 1 2\\n3 3 4 5\\nCELL_DATA 2\\nSCALARS face int 1\\nLOOKUP_TABLE default\\n"
        "4\\n5\\nSCALARS body int 1\\nLOOKUP_TABLE default\\n0\\n0\\n")
    print("face  owner                  faces\\n   4  a plate                      91      2744.4  (0, 0, 0)    curved")
elif verb == "new" and "--preview" in words:
    print('{"low": [0, 0, 0], "high": [1, 1, 1], "walls": null, "shell": 0, "size": 0.006, "smallest": 0.003, "mould_size": 0.01, "risers": []}')
elif verb == "new":
    folder = pathlib.Path(given["output"])
    folder.mkdir(parents=True)
    print("plate.step: pure_tin\\n  hot spot    a sphere of 29.7 mm at (1, -40.5, 0.5) mm\\n  mould       walls of 45 mm")
    (folder / "case.toml").write_text(pathlib.Path(__file__).with_name("case.toml").read_text() + "# " + " ".join(words) + "\\n")
    (folder / "risers.step").write_text("solids")
elif verb == "check":
    print("warning: case.toml:12:1: 'casting' is thin at (1, -2, 3e1) mm\\n  look there", file=sys.stderr)
    print("The case is in order.")
elif verb == "report" and "--pdf" in words:
    pathlib.Path(words[0], "report.pdf").write_bytes(b"%PDF-1.4")
elif verb == "run":
    folder = pathlib.Path(given["output"])
    folder.mkdir(parents=True)
    signal.signal(signal.SIGINT, lambda *_: sys.exit(130))
    print("Watch it in a browser on this machine: http://127.0.0.1:9/aa/", flush=True)
    (folder / "steps.csv").write_text("time[s],step[1],solid_fraction[1]\\n1,1,0.25\\n5,2,0.5\\n")
    if "--coupled" in words:
        time.sleep(60)
    (folder / "summary.json").write_text('{"outcome": "finished", "warnings": ["thin at (1, 2, 3) mm"], "steps": 2, '
        '"answers": {"yield": 0.5, "castings": {"plate": {"last_melt_froze": {"value[s]": 9, "at[m]": [0, 1, 2]}}}}}')
    (folder / "report.html").write_text("<p>report")
'''


class Keys(unittest.TestCase):
    def test_a_key_is_replaced_and_all_else_stays(self):
        text = toml_edit.with_value(CASE, ["time", "end"], "20 s")
        self.assertEqual(text, CASE.replace('end = "10 s"  # at', 'end = "20 s"  # at'))
        text = toml_edit.with_value(CASE, ["body", 1, "material"], "furan_sand")
        self.assertEqual(text, CASE.replace('"green_sand"', '"furan_sand"'))
        self.assertEqual(toml_edit.with_value(CASE, ["time", "points"], [3]).count("points = [3]"), 1)

    def test_a_key_is_added_to_its_own_section(self):
        document = toml_edit.parsed(toml_edit.with_value(CASE, ["body", 0, "role"], "casting"))
        self.assertEqual(document["body"][0]["role"], "casting")
        self.assertEqual(toml_edit.parsed(toml_edit.with_value(CASE, ["output", "every"], "1 s"))["output"], {"every": "1 s"})
        self.assertEqual(toml_edit.parsed(toml_edit.with_value(CASE, ["note"], 'a "b" # c'))["note"], 'a "b" # c')

    def test_sections_come_and_go_with_their_comments(self):
        text = toml_edit.with_section(CASE, ["probe"], {"name": "T_1", "point": ["1 mm", "2 mm", "3 mm"]})
        self.assertEqual(toml_edit.parsed(text)["probe"][0]["name"], "T_1")
        self.assertEqual(toml_edit.without(text, ["probe", 0]).strip(), CASE.strip())
        self.assertNotIn("sand around it", toml_edit.without(CASE, ["body", 1]))
        self.assertEqual(toml_edit.parsed(toml_edit.without(CASE, ["body", 0]))["body"], [{"name": "mould", "material": "green_sand"}])
        self.assertEqual(toml_edit.parsed(toml_edit.with_section(CASE, ["body"], {"name": "core"}))["body"][2], {"name": "core"})

    def test_what_has_no_place_is_refused(self):
        for path in (["body", 7, "name"], ["title", "x"], ["body", "name"]):
            with self.assertRaises(InputError, msg=path):
                toml_edit.with_value(CASE, path, "x")
        with self.assertRaisesRegex(InputError, "there is no time.start"):
            toml_edit.without(CASE, ["time", "start"])
        with self.assertRaisesRegex(InputError, "no TOML"):
            toml_edit.parsed("a = = 1")

    def test_a_line_tells_its_section(self):
        self.assertEqual(toml_edit.section_at(CASE, 5), ("time", "end"))
        self.assertEqual(toml_edit.section_at(CASE, 20), ("body", 1, "name"))
        self.assertEqual(toml_edit.section_at(CASE, 19), ("body", 1))
        self.assertEqual(toml_edit.section_at(CASE, 1), ())


class Findings(unittest.TestCase):
    def test_a_message_tells_line_places_and_bodies(self):
        found = findings.finding("warning", "a/case.toml:20:1: 'mould' is thin at (1, -2, 3e1) mm\n  look there", CASE, toml_edit.parsed(CASE))
        self.assertEqual((found["line"], found["section"], found["bodies"]), (20, "body.2.name", ["mould"]))
        self.assertEqual(found["places"], [[0.001, -0.002, 0.03]])
        self.assertEqual(found["message"], "'mould' is thin at (1, -2, 3e1) mm\nlook there")

    def test_lines_that_go_on_belong_to_their_message(self):
        lines = ["info: a", "warning: b", "  more", "info: c", "  not more", "solidus: d"]
        self.assertEqual(findings.grouped(lines, {"warning:": "warning", "solidus:": "error"}), [("warning", "b\nmore"), ("error", "d")])


class Skins(unittest.TestCase):
    def test_an_stl_of_either_kind_is_welded_and_read_in_its_unit(self):
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        with tempfile.TemporaryDirectory() as folder:
            binary, text = pathlib.Path(folder, "a.stl"), pathlib.Path(folder, "b.stl")
            binary.write_bytes(bytes(80) + struct.pack("<I", 2) + b"".join(
                struct.pack("<12fH", 0, 0, 0, *(v for corner in corners[k:k + 3] for v in corner), 0) for k in (0, 3)))
            text.write_text("solid a\n" + "\n".join(f"vertex {x} {y} {z}" for x, y, z in corners))
            for file in (binary, text):
                read = skin.of_stl(file, "mm")
                self.assertEqual((len(read.nodes), read.triangles.shape), (4, (2, 3)))
                self.assertAlmostEqual(float(read.nodes.max()), 1e-3, 8)
            binary.write_bytes(binary.read_bytes()[:-7])
            with self.assertRaises(InputError):
                skin.of_stl(binary, "mm")

    def test_a_block_is_a_line_and_arrays_at_multiples_of_four(self):
        import numpy as np

        zeros = np.zeros(1, np.int32)
        for name in ("a", "ab", "abc", "abcd"):
            block = skin.Skin(np.zeros((3, 3), np.float32), np.zeros((1, 3), np.uint32), zeros, zeros, [name]).packed()
            line = block[:block.index(b"\n") + 1]
            self.assertEqual((len(line) % 4, len(block) - len(line), json.loads(line)["names"]), (0, 36 + 12 + 8, [name]))


class Chosen(unittest.TestCase):
    def test_choices_become_words_of_new(self):
        chosen = choices.checked({"alloy": "pure_tin", "riser": "placed", "risers": [{"foot": [0, 0.01, 0.02], "diameter": 0.03, "height": 0.05}],
                                  "roles": {"a": "core", "b": ""}, "gate": [0, 0, 0.001]})
        words = choices.words(chosen, pathlib.Path("p.step"), pathlib.Path("own"), pathlib.Path("out"))
        self.assertEqual(words, ["--alloy=pure_tin", "--process=sand", "--fineness=1", "--output=out", "--riser=own/feeders.toml",
                                 "--gate=0 mm, 0 mm, 1 mm", "--as=a=core", "p.step"])
        self.assertIn('foot = ["0 mm", "10 mm", "20 mm"]', choices.feeders_text(chosen))

    def test_a_riser_next_to_the_part_keeps_where_its_neck_leads(self):
        riser = {"name": "aside", "foot": [0.1, 0, 0], "diameter": 0.03, "height": 0.06, "neck_diameter": 0.02, "neck_to": [0.05, 0, 0.01]}
        chosen = choices.checked({"riser": "placed", "risers": [riser]})
        self.assertEqual(chosen["risers"], [riser])
        self.assertIn('neck_to = ["50 mm", "0 mm", "10 mm"]', choices.feeders_text(chosen))
        with self.assertRaisesRegex(InputError, "aside: neck_to"):
            choices.checked({"risers": [{**riser, "neck_to": [0, 1]}]})

    def test_gating_goes_into_a_file_of_its_own_whatever_the_risers(self):
        gating = {"name": "gating_1", "gate": [0.06, 0.03, 0.008], "gate_width": 0.02, "gate_height": 0.008, "gate_length": 0.012,
                  "runner_width": 0.016, "runner_height": 0.014, "sprue": [0.1, 0.06, 0.08], "foot_diameter": 0.012, "top_diameter": 0.02}
        chosen = choices.checked({"alloy": "pure_tin", "riser": "auto", "gatings": [gating]})
        self.assertEqual(chosen["gatings"], [gating])
        words = choices.words(chosen, pathlib.Path("p.step"), pathlib.Path("own"), pathlib.Path("out"))
        self.assertEqual(words[-3:], ["--riser=auto", "--gating=own/gating.toml", "p.step"])
        self.assertEqual(toml_edit.parsed(choices.files(chosen)["gating.toml"]), {"gating": [{
            "name": "gating_1", "gate": ["60 mm", "30 mm", "8 mm"], "gate_size": ["20 mm", "8 mm"], "gate_length": "12 mm",
            "runner_size": ["16 mm", "14 mm"], "sprue": ["100 mm", "60 mm", "80 mm"], "foot_diameter": "12 mm", "top_diameter": "20 mm"}]})
        self.assertEqual(choices.gating_text(choices.defaults()).strip(), "")
        with self.assertRaisesRegex(InputError, "gating_1: runner_width"):
            choices.checked({"gatings": [{key: value for key, value in gating.items() if key != "runner_width"}]})

    def test_what_is_of_another_kind_is_refused(self):
        for wrong in ({"alloy": 3}, {"process": "magic"}, {"fineness": float("nan")}, {"roles": {"a": "king"}}, {"risers": [{"foot": [1, 2]}]},
                      {"risers": "x"}, {"gate": [0, 0, "1"]}, {"other": 1}, [], {"alloy": "a\nb"}):
            with self.assertRaises(InputError, msg=wrong):
                choices.checked(wrong)


class Runs(unittest.TestCase):
    def test_a_riser_is_judged_by_when_it_froze_and_by_the_errors(self):
        def froze(seconds, error, **role):
            return {"riser": False, "gating": False, **role, "last_melt_froze": {"value[s]": seconds, "error[s]": error}}

        castings = {"part": froze(100.0, 5.0), "late": froze(130.0, 6.0, riser=True), "near": froze(104.0, 1.0, riser=True),
                    "early": froze(80.0, 1.0, riser=True), "runner": froze(20.0, 1.0, gating=True)}
        self.assertEqual([(v["good"], v["text"].split(":")[0].rstrip(".")) for v in runs.verdicts({"castings": castings})],
                         [(True, "late outlived the part by 30 ± 6 s"), (None, "near froze 4 ± 5 s after the part"), (False, "early froze 20 ± 5 s before the part")])
        self.assertEqual(runs.verdicts({"castings": {"part": {"riser": False, "gating": False}, "late": castings["late"]}}), [])
        self.assertEqual(runs.verdicts({"castings": {"part": castings["part"]}, "pools_cut_off": {"number": 0}}), [])
        self.assertEqual([v["text"] for v in runs.verdicts({"pools_cut_off": {"number": 2, "largest[m3]": 3.21e-6}})],
                         ["2 pools of melt cut off from what feeds the part; the largest had 3.21 cm³."])

    def test_a_run_is_named_only_by_its_number(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(f"{folder}/run_3")
            os.symlink("/", f"{folder}/run_4")
            self.assertEqual(runs.next_name(pathlib.Path(folder)), "run_5")
            self.assertEqual(runs.folder_of(pathlib.Path(folder), "run_3").name, "run_3")
            for name in ("../x", "run_", "run_4", "run_9", "", None, "run_3/.."):
                with self.assertRaises(InputError, msg=name):
                    runs.folder_of(pathlib.Path(folder), name)


class Served(unittest.TestCase):
    """A server with a stand-in for the program, in a folder of its own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name).resolve() / "work"
        self.folder.mkdir()
        program = self.folder.parent / "solidus"
        program.write_text(PROGRAM)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        (self.folder.parent / "case.toml").write_text(CASE)
        (self.folder / "plate.step").write_text("a part")
        environment = mock.patch.dict(os.environ, {"SOLIDUS_PROGRAM": str(program)})
        environment.start()
        self.addCleanup(environment.stop)
        verbs._cached.cache_clear()
        self.server = Server(self.folder)
        self.thread = threading.Thread(target=self.server.serve, daemon=True)
        self.thread.start()
        self.addCleanup(self._folder.cleanup)
        self.addCleanup(self.server.close)

    def raw(self, method, path, body=None, host=None, origin=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=20)
        connection.putrequest(method, path, skip_host=True)
        connection.putheader("Host", host or f"127.0.0.1:{self.server.port}")
        if origin:
            connection.putheader("Origin", origin)
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        data = answer.read()
        connection.close()
        return answer.status, data

    def get(self, way):
        status, data = self.raw("GET", f"/{self.server.token}/{way}")
        return status, json.loads(data) if data.startswith(b"{") else data

    def post(self, way, **given):
        origin = f"http://127.0.0.1:{self.server.port}"
        status, data = self.raw("POST", f"/{self.server.token}/{way}", json.dumps(given).encode(), origin=origin)
        return status, json.loads(data)

    def at_rest(self):
        """The state once nothing is computed."""
        for _ in range(400):
            _, state = self.get("state")
            if state["job"] is None:
                return state
            time.sleep(0.02)
        self.fail("the job does not end")

    def made(self):
        """The state with a part opened and a case made of it."""
        self.post("open", name="plate.step")
        state = self.at_rest()
        status, state = self.post("choose", seen=state["edits"], choices={**state["choices"], "alloy": "pure_tin"})
        self.assertEqual(status, 200, state)
        status, state = self.post("make", seen=state["edits"])
        self.assertEqual(status, 200, state)
        return self.at_rest()

    def test_what_would_be_made_is_shown_and_goes_with_the_choices(self):
        self.post("open", name="plate.step")
        state = self.at_rest()
        self.assertEqual(self.post("preview", seen=state["edits"])[0], 400, "without an alloy")
        _, state = self.post("choose", seen=self.get("state")[1]["edits"], choices={**state["choices"], "alloy": "pure_tin"})
        self.assertIsNone(state["preview"])
        status, state = self.post("preview", seen=state["edits"])
        self.assertEqual(status, 200, state)
        state = self.at_rest()
        self.assertEqual(state["preview"]["size"], 0.006)
        self.assertFalse((self.folder / "plate" / "case.toml").exists(), "nothing is made")
        probe = {"name": "T_1", "point": [0.0, 0.0, 0.0]}
        _, state = self.post("choose", seen=state["edits"], choices={**state["choices"], "probes": [probe]})
        self.assertIsNotNone(state["preview"], "a probe changes nothing that it shows")
        _, state = self.post("choose", seen=state["edits"], choices={**state["choices"], "process": "gravity_die"})
        self.assertIsNone(state["preview"])

    def test_pages_for_the_customer_are_printed_and_served(self):
        self.made()
        self.post("run", physics="heat")
        self.assertIsNone(self.at_rest()["runs"][0]["printed"])
        self.assertEqual(self.raw("GET", f"/{self.server.token}/run/run_1/printed")[0], 404)
        self.assertEqual(self.post("print", run="../plate")[0], 400)
        self.assertEqual(self.post("print", run="run_1")[0], 200)
        self.assertEqual(self.at_rest()["runs"][0]["printed"], "report.pdf")
        self.assertEqual(self.raw("GET", f"/{self.server.token}/run/run_1/printed"), (200, b"%PDF-1.4"))

    # Who is answered

    def test_only_the_loopback_address_is_listened_to(self):
        self.assertEqual(self.server._http.server_address[0], "127.0.0.1")

    def test_another_token_host_or_origin_gets_nothing(self):
        own = f"/{self.server.token}/state"
        self.assertEqual(self.raw("GET", own)[0], 200)
        self.assertEqual(self.raw("GET", own, host=f"localhost:{self.server.port}")[0], 200)
        wrong = self.server.token[:-1] + ("0" if self.server.token[-1] != "0" else "1")
        for path in ("/", "/state", f"/{wrong}/state", f"/{self.server.token[:-1]}/state", f"/x/{self.server.token}/state", "/%00/state"):
            self.assertEqual(self.raw("GET", path)[0], 404, path)
        for host in ("evil.example", f"evil.example:{self.server.port}", "127.0.0.1", f"127.0.0.1:{self.server.port + 1}", f"192.168.0.1:{self.server.port}"):
            self.assertEqual(self.raw("GET", own, host=host)[0], 404, host)
        self.assertEqual(self.raw("GET", own, origin="http://evil.example")[0], 404)
        self.assertEqual(self.raw("GET", own, Sec_Fetch_Site="cross-site")[0], 404)

    def test_nothing_is_changed_for_a_page_that_is_not_named_or_another(self):
        path, body = f"/{self.server.token}/open", b'{"name": "plate.step"}'
        for origin in (None, "null", "http://evil.example", f"https://127.0.0.1:{self.server.port}", f"http://127.0.0.1:{self.server.port + 1}"):
            self.assertEqual(self.raw("POST", path, body, origin=origin)[0], 404, origin)
        self.assertIsNone(self.get("state")[1].get("name"))

    def test_requests_of_no_use_are_refused_and_the_server_goes_on(self):
        origin = f"http://127.0.0.1:{self.server.port}"
        for body in (b"", b"[]", b"{", b'{"a": ' + b"[" * 100000, b'{"name": 3}', b'{"name": "\\u0000"}'):
            status, _ = self.raw("POST", f"/{self.server.token}/open", body, origin=origin)
            self.assertEqual(status, 400, body[:20])
        self.assertEqual(self.raw("POST", f"/{self.server.token}/state", b"{}", origin=origin)[0], 404)
        self.assertEqual(self.raw("DELETE", f"/{self.server.token}/state")[0], 501)
        self.assertEqual(self.get("state")[0], 200)

    # Files

    def test_paths_stay_in_the_folder(self):
        (self.folder / "out.step").symlink_to("/etc/passwd")
        for name in ("../case.toml", "/etc/passwd", "out.step", "..", "plate.step/../../solidus"):
            status, answer = self.post("open", name=name)
            self.assertEqual(status, 400, name)
        for way in ("run/..%2f..%2fx/report", "run/run_1%2f..%2f..%2f/report", "run/../report", "compared/../../report", "skin/..", "run//report"):
            self.assertIn(self.get(way)[0], (400, 404), way)

    def test_a_file_that_is_brought_goes_into_the_folder_under_a_free_name(self):
        origin = f"http://127.0.0.1:{self.server.port}"
        status, state = self.raw("POST", f"/{self.server.token}/upload?name=plate.step", b"another part", origin=origin)
        self.assertEqual((status, (self.folder / "plate_2.step").read_bytes(), (self.folder / "plate.step").read_text()), (200, b"another part", "a part"))
        self.assertEqual(self.at_rest()["part"], "plate_2.step")
        for name in ("..%2fx.step", "a.sh", "case.toml", ".x.step", "", "a%00.step", "a%2fb.step", "x.geo"):
            self.assertEqual(self.raw("POST", f"/{self.server.token}/upload?name={name}", b"x", origin=origin)[0], 400, name)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir() if p.is_file()), ["plate.step", "plate_2.step"])

    def test_a_hostile_part_is_refused_in_the_words_of_the_program(self):
        (self.folder / "hostile.step").write_text("x")
        self.post("open", name="hostile.step")
        state = self.at_rest()
        self.assertEqual((state["last"]["ok"], state["last"]["message"], state["skins"]), (False, "hostile.step: this file is refused", {}))

    # From a part to a run

    def test_a_part_becomes_a_case_that_is_checked_run_and_judged(self):
        state = self.made()
        self.assertIn("--alloy=pure_tin", state["case"]["text"])
        self.assertEqual((self.folder / "plate" / "risers.step").read_text(), "solids")
        self.assertTrue(state["made"])
        self.assertEqual([(f["message"], f["places"]) for f in state["thickest"]],
                         [("a sphere of 29.7 mm at (1, -40.5, 0.5) mm", [[0.001, -0.0405, 0.0005]])])
        self.assertEqual((state["check"]["current"], state["check"]["findings"][0]["places"]), (True, [[0.001, -0.002, 0.03]]))
        self.assertEqual(json.loads(self.raw("GET", f"/{self.server.token}/skin/part")[1].split(b"\n")[0])["names"], ["a plate"])
        self.assertEqual(self.post("run", physics="heat")[0], 200)
        state = self.at_rest()
        self.assertEqual([(r["name"], r["outcome"], r["report"]) for r in state["runs"]], [("run_1", "finished", True)])
        # Answers and warnings lead to places, and the end of the run is told even to a page that has not seen it go on.
        run = state["runs"][0]
        self.assertEqual([(a["name"], a["at"]) for a in run["answers"]], [("plate: last melt froze", [0, 1, 2]), ("yield", None)])
        self.assertEqual(run["warnings"][0]["places"], [[0.001, 0.002, 0.003]])
        self.assertEqual((state["last"]["run"], state["last"]["number"]), ("run_1", 3))
        self.assertEqual(self.raw("GET", f"/{self.server.token}/run/run_1/report")[1], b"<p>report")

    def test_a_run_goes_on_without_a_page_is_found_again_and_stopped(self):
        self.made()
        self.post("run", physics="coupled")
        for _ in range(400):
            job = self.get("state")[1]["job"]
            if job["progress"] and job["watch"]:
                break
            time.sleep(0.02)
        self.assertEqual((job["run"], job["watch"], job["progress"]["solid"]), ("run_1", "http://127.0.0.1:9/aa/", 0.5))
        status, answer = self.post("run", physics="heat")
        self.assertEqual(status, 409, "one job at a time")
        self.post("stop")
        state = self.at_rest()
        self.assertTrue(state["last"]["stopped"])
        self.assertEqual([r["name"] for r in state["runs"]], ["run_1"])

    def test_keys_are_changed_undone_and_done_again(self):
        state = self.made()
        before = state["case"]["text"]
        status, state = self.post("set", seen=state["edits"], path=["time", "end"], value="99 s")
        self.assertEqual((status, state["case"]["document"]["time"]["end"], state["check"]["current"]), (200, "99 s", False))
        self.assertIn('"99 s"', (self.folder / "plate" / "case.toml").read_text())
        status, state = self.post("undo", seen=state["edits"])
        self.assertEqual((state["case"]["text"], (self.folder / "plate" / "case.toml").read_text()), (before, before))
        status, state = self.post("redo", seen=state["edits"])
        self.assertEqual(state["case"]["document"]["time"]["end"], "99 s")
        while state["undo"]:
            status, state = self.post("undo", seen=state["edits"])
        self.assertIsNone(state["case"])
        self.assertEqual(state["choices"]["alloy"], "")

    def test_two_pages_do_not_fight_and_an_editor_is_heard(self):
        state = self.made()
        seen = state["edits"]
        self.assertEqual(self.post("set", seen=seen, path=["title"], value="first")[0], 200)
        status, answer = self.post("set", seen=seen, path=["title"], value="second")
        self.assertEqual((status, "another page" in answer["error"]), (409, True))
        file = self.folder / "plate" / "case.toml"
        state = self.get("state")[1]
        file.write_text(file.read_text().replace("first", "by hand"))
        self.assertEqual(self.post("set", seen=state["edits"], path=["title"], value="third")[0], 409)
        state = self.get("state")[1]
        self.assertEqual(state["case"]["document"]["title"], "by hand")
        self.assertEqual(self.post("undo", seen=state["edits"])[1]["case"]["document"]["title"], "first")

    def test_a_case_that_was_looked_at_alone_is_left_as_it_was(self):
        (self.folder / "own").mkdir()
        (self.folder / "own" / "case.toml").write_text(CASE)
        self.post("open", name="own")
        self.at_rest()
        self.assertTrue((self.folder / "own" / "open" / "address").exists())
        (self.folder / "own" / "case.toml").write_text(CASE.replace("a plate", "by hand"))
        state = self.get("state")[1]
        self.assertEqual(self.post("undo", seen=state["edits"])[1]["case"]["text"], CASE)
        self.assertEqual(self.post("open", name="own")[0], 200, "once more")
        self.at_rest()
        self.post("open", name="plate.step")
        self.at_rest()
        self.assertFalse((self.folder / "own" / "open" / "address").exists())

    def test_a_second_server_leaves_the_folder_to_the_first(self):
        self.made()
        other = Server(self.folder)
        self.addCleanup(other.close)
        with self.assertRaisesRegex(Exception, f"open already, at {self.server.address}"):
            other.bench.open("plate.step")

    def test_an_opened_case_finds_its_choices_check_and_runs_again(self):
        self.made()
        self.post("run", physics="heat")
        self.at_rest()
        self.server.bench.close()
        again = Server(self.folder)
        self.addCleanup(again.close)
        again.bench.open("plate")
        state = again.bench.state()
        self.assertEqual((state["part"], state["choices"]["alloy"], state["check"]["current"], [r["name"] for r in state["runs"]]),
                         ("plate.step", "pure_tin", True, ["run_1"]))


class Folders(unittest.TestCase):
    def test_a_damaged_file_of_choices_is_as_none(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a")
            (path / "open").mkdir(parents=True)
            (path / "open" / "choices.json").write_text('{"alloy": 3}')
            self.assertEqual(CaseFolder(path, None).choices, choices.defaults())


if __name__ == "__main__":
    unittest.main()
