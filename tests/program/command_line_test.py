"""The command line: help, versions, completion in its shells, the manual page, editors, colours, signals."""

import json
import os
from pathlib import Path
import pty
import re
import select
import shutil
import signal
import subprocess
import time
import tomllib
import unittest

from program import PATIENCE, PROGRAM, SOURCES, ProgramTest, solidus

VERBS = {"run", "check", "resolve", "variants", "explain", "schema", "point", "mesh-info", "materials", "export", "version", "plot", "compare",
         "study", "init-editor", "completion", "man", "help"}
LONG_CASE = """
title = "A block that cools for ever"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["40 mm", "20 mm"]
divisions = [40, 20]
[time]
end = "1000000 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "200 degC"
[output]
every = "100000 s"
"""


def open_terminal():
    """Both ends of a terminal."""
    try:
        return pty.openpty()
    except OSError as error:
        raise unittest.SkipTest(f"no terminal can be opened, as where /dev/pts is not mounted ({error})") from None


def on_terminal(*command, env=None):
    """What a command writes on a terminal."""
    master, slave = open_terminal()
    process = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave,
                               env={**os.environ, "TERM": "xterm", **(env or {})})
    os.close(slave)
    text = b""
    while True:
        try:
            read = os.read(master, 65536)
        except OSError:  # the other end is closed
            break
        if not read:
            break
        text += read
    os.close(master)
    process.wait()
    return text.decode()


def children(parent):
    """Numbers of the processes that a process has started and that still are."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            number, _, rest = stat.read_text().partition(" ")
        except OSError:  # it has ended
            continue
        if int(rest.rpartition(")")[2].split()[1]) == parent:
            found.append(int(number))
    return found


class CommandLine(ProgramTest):
    def test_help_and_version_are_where_people_look_for_them(self):
        self.assertRegex(self.done("--version"), r"^Solidus \d+\.\d+\.\d+(\+\d{8}\.[0-9a-f]{7,}(\.modified)?)?\n$")
        everything = self.done("help")
        for verb in VERBS:
            self.assertRegex(everything, rf"(?m)^  {verb} ")
            self.assertNotIn("{", self.done("help", verb))  # no marks of the library that reads the command line
        self.assertEqual(self.done("help", "run"), self.done("run", "--help").replace(PROGRAM, "solidus"))
        wrong = solidus("help", "rum")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("did you mean 'run'?", wrong.stderr)

    def test_one_thread_of_linear_algebra_unless_the_environment_says_otherwise(self):
        if shutil.which("cc") is None:
            self.skipTest("no C compiler")
        # Before whichever BLAS the machine has, one is loaded that tells how many threads it was given.
        self.write("blas.c", '#include <stdio.h>\nvoid openblas_set_num_threads(int n) { printf("threads %d\\n", n); fflush(stdout); }\n')
        subprocess.run(["cc", "-shared", "-fPIC", "-o", "blas.so", "blas.c"], cwd=self.folder, check=True)
        silent = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
        for given, told in (({}, True), ({"OPENBLAS_NUM_THREADS": "2"}, False), ({"OMP_NUM_THREADS": "2"}, False)):
            said = subprocess.run([PROGRAM, "version"], env={**silent, **given, "LD_PRELOAD": str(self.folder / "blas.so")},
                                  capture_output=True, text=True, check=True).stdout
            self.assertEqual("threads 1\n" in said, told, given)

    def test_what_is_missing_is_said_with_where_to_look(self):
        self.write("part.step", "ISO-10303-21;")
        self.write("plate/case.toml", "")
        for arguments, *said in (
                (["new", "part.step"], "what is cast?", "those that `solidus materials` lists"),
                (["new"], "PART is required", "`solidus help new` shows its options"),
                (["run", "--unknown", "case.toml"], "--unknown", "`solidus help run` shows its options"),
                ([], "which verb?", "`solidus --help` shows all of them"),
                (["run", "part.step"], "part.step: this is a geometry or a mesh, not a case", "`solidus new` makes one"),
                (["check", "."], ".: the folder has no case.toml"),
                (["check", "bracket"], "bracket: there is no such file or folder", "a case file, or a folder"),
                (["check", "plat"], "plat: there is no such file or folder", "did you mean 'plate'?"),
                (["new", "nothing.step", "--alloy", "brass"], "nothing.step: there is no such file"),
                (["plot", "."], ".: the folder has no results", "names at its end"),
                (["plot", "nothing"], "nothing: there is no such folder", "names at its end")):
            result = solidus(*arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 1, arguments)
            for text in said:
                self.assertIn(text, result.stderr, arguments)

    def test_a_place_that_cannot_be_written_is_named_with_the_reason(self):
        self.done("run", SOURCES / "cases/hot_spots", "--heat-only", "-o", "out", "--set", "time.end=4 s")
        self.write("file", "where a folder would be made")
        part = SOURCES / "tests/parts/flange.step"
        for arguments, said in (
                (("new", part, "--alloy", "aluminium_alsi7mg", "-o", "file/case"),
                 "file/case: the case cannot be written there: Not a directory\n  -o names another folder"),
                (("report", "out", "-o", "file/page.html"), "file/page.html: cannot open for writing: Not a directory"),
                (("materials", "aluminium_alsi7mg", "-o", "file/tables"),
                 "file/tables: cannot make this folder: Not a directory\n  -o names another one"),
                (("mesh-info", part, "--pictures", "file/faces"),
                 "file/faces: cannot make this folder: Not a directory\n  --pictures names another one")):
            result = solidus(*arguments, cwd=self.folder)
            error = result.stderr[result.stderr.find("solidus: "):].strip()  # a slow machine says before that it is meshing
            self.assertEqual((result.returncode, error), (1, "solidus: " + said), arguments)

    def test_a_folder_for_temporary_files_that_cannot_be_written_stops_nothing(self):
        file = self.write("file", "where a folder is meant")
        self.assertIn("aluminium_alsi7mg", self.done("materials", env={"TMPDIR": str(file / "temporary")}))

    def test_a_run_ends_with_where_its_results_are_and_how_to_look_at_them(self):
        self.write("case.toml", LONG_CASE.replace("1000000 s", "3 s").replace("100000 s", "3 s"))
        self.assertTrue(self.done("run", "case.toml", "-o", "one").endswith(
            "\nResults in one. Next: solidus report one; solidus plot one\n"))
        self.assertTrue(self.done("run", "case.toml", "--report", "-o", "other").endswith("\nResults in other.\n"))

    def test_the_fields_of_page_and_pictures_are_those_of_the_program(self):
        """When this fails: ./dev docs, or the two lines of it that write these files."""
        for option, file in (("--json", "python/solidus_plots/fields.json"), ("--manual", "docs/reference/fields.md")):
            self.assertEqual(self.done("explain", "--fields", option), (SOURCES / file).read_text(encoding="utf-8"), file)

    def test_the_columns_of_tables_are_listed_once(self):
        for option, file in (("--json", "python/solidus_plots/tables.json"), ("--manual", "docs/reference/tables.md")):
            self.assertEqual(self.done("explain", "--tables", option), (SOURCES / file).read_text(encoding="utf-8"))
        listed = self.done("explain", "--tables", "feeding")
        self.assertIn("balance_defect[1]", listed)
        self.assertNotIn("stored_heat", listed)
        result = solidus("explain", "--tables", "histories", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("history", result.stderr)
        self.assertEqual(solidus("explain", "--findings", "--json", cwd=self.folder).returncode, 1)

    def test_the_page_of_findings_is_that_of_the_program(self):
        """When this fails: ./dev docs, or its line that writes this page."""
        self.assertEqual(self.done("explain", "--findings", "--manual"), (SOURCES / "docs/reference/findings.md").read_text(encoding="utf-8"))

    def test_findings_are_listed_by_what_they_are_about(self):
        listed = self.done("explain", "--findings", "contacts")
        self.assertIn("two contacts join the same surfaces: in either order, at the same time (error)", listed)
        self.assertNotIn("probe", listed)
        result = solidus("explain", "--findings", "contact", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("did you mean 'contacts'?", result.stderr)

    def test_a_field_is_explained_and_one_that_is_not_there_is_refused(self):
        self.assertIn("called Von Mises stress, shown in MPa", self.done("explain", "--fields", "von_mises"))
        result = solidus("explain", "--fields", "von_mise", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("there is no field 'von_mise'", result.stderr)
        self.assertIn("von_mises", result.stderr)

    def test_bash_completes_verbs_options_keys_and_materials(self):
        script = self.write("solidus.bash", self.done("completion", "bash"))

        def completed(*words):
            text = f"source {script}; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; " \
                   "compopt() { :; }; _solidus; printf '%s\\n' \"${COMPREPLY[@]}\""
            return subprocess.run(["bash", "-c", text], capture_output=True, text=True, check=True).stdout.split()

        self.assertLessEqual(VERBS, set(completed("solidus", "''")))
        self.assertEqual(completed("solidus", "mesh"), ["mesh-info"])
        self.assertEqual(completed("solidus", "run", "--res"), ["--restart"])
        self.assertIn("time.step=", completed("solidus", "run", "--set", "time.st"))
        self.assertIn("time.step", completed("solidus", "explain", "time.st"))
        self.assertEqual(completed("solidus", "materials", "green"), ["green_sand", "green_sand_yielding"])
        self.assertEqual(completed("solidus", "completion", "z"), ["zsh"])

    def test_zsh_completes_too(self):
        zsh = self.write("_solidus", self.done("completion", "zsh"))
        master, slave = open_terminal()
        shell = subprocess.Popen(["zsh", "-f", "-i"], stdin=slave, stdout=slave, stderr=slave, start_new_session=True,
                                 env={**os.environ, "TERM": "dumb", "ZDOTDIR": str(self.folder)})
        os.close(slave)

        def shown_after(keys, wanted):
            os.write(master, keys.encode())
            seen, end = "", time.monotonic() + 20
            while wanted not in seen and time.monotonic() < end:
                if select.select([master], [], [], 0.2)[0]:
                    seen += os.read(master, 65536).decode(errors="replace").replace("\a", "")  # no bell
            return seen

        prepare = f"unset zle_bracketed_paste; fpath=({zsh.parent} $fpath); autoload -Uz compinit; " \
                  "compinit -u -D; echo is''ready\n"
        self.assertIn("isready", shown_after(prepare, "isready"))
        self.assertIn("--restart", shown_after("solidus run --resta\t", "--restart"))
        self.assertIn("mesh-info", shown_after("\x15solidus mesh-\t", "mesh-info"))
        shell.kill()
        shell.wait()
        os.close(master)

    def test_fish_completes_too(self):
        fish = self.write("solidus.fish", self.done("completion", "fish"))

        def completed(line):
            text = f"source {fish}; complete -C {line!r}"
            found = subprocess.run(["fish", "--no-config", "-c", text], capture_output=True, text=True, check=True)
            return [row.split("\t")[0] for row in found.stdout.splitlines()]

        self.assertLessEqual(VERBS, set(completed("solidus ")))
        self.assertEqual(completed("solidus run --resta"), ["--restart"])
        self.assertIn("time.step=", completed("solidus run --set time.st"))

    def test_the_manual_page_has_every_verb_and_no_mistake(self):
        page = self.write("solidus.1", self.done("man"))
        shown = subprocess.run(["groff", "-man", "-Tutf8", "-ww", page], capture_output=True, text=True, check=True)
        self.assertEqual(shown.stderr, "")
        text = re.sub(".\x08", "", shown.stdout)  # letters struck twice are bold
        for verb in VERBS:
            self.assertTrue(f"solidus {verb}" in text, verb)
        self.assertTrue("130" in text)

    def test_variants_are_listed_run_and_refused_with_the_nearest_name(self):
        folder = SOURCES / "cases/thick_cylinder"
        lines = self.done("variants", folder).splitlines()
        self.assertEqual(len(lines), 94)
        titles = dict(line.partition(" ")[::2] for line in lines)
        self.assertEqual(titles["te_x6_isothermal"].strip(),
                         "Thick-walled cylinder: elastic, alpha x 6, isothermal split, literal form")
        self.assertIn("has no variants", self.done("variants", SOURCES / "cases/hot_spots"))
        self.assertIn('scheme = "simultaneous"', self.done("resolve", f"{folder}:te_x1_simultaneous"))
        wrong = solidus("run", f"{folder}:te_x1_simultanous")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("did you mean 'te_x1_simultaneous'?", wrong.stderr)
        self.done("run", f"{folder}:te_x1_isothermal", "--set", "time.end=20 s", "-o", self.folder / "out")
        self.assertEqual(json.loads((self.folder / "out/summary.json").read_text())["variant"], "te_x1_isothermal")

    def test_an_editor_learns_which_schema_a_file_has(self):
        self.done("init-editor")
        rules = tomllib.loads((self.folder / ".taplo.toml").read_text())["rule"]
        schemas = [json.loads((self.folder / rule["schema"]["path"].removeprefix(f"file://{self.folder}/")).read_text())
                   for rule in rules]
        self.assertEqual([schema["title"] for schema in schemas], ["Solidus material", "Solidus point", "Variants of a Solidus case", "Solidus case"])
        self.assertIn("**/plots.toml", rules[-1]["exclude"])
        self.assertIn("**/variants.toml", rules[-1]["exclude"])
        of_variants = schemas[2]["properties"]["variant"]["additionalProperties"]["$ref"]
        self.assertTrue((self.folder / ".solidus" / of_variants).is_file())
        self.assertIn("even-better-toml", (self.folder / ".vscode/extensions.json").read_text())
        self.done("init-editor")  # again: its own files are replaced
        self.write(".taplo.toml", "# mine\n")
        refused = solidus("init-editor", cwd=self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("is yours", refused.stderr)
        self.assertEqual((self.folder / ".taplo.toml").read_text(), "# mine\n")
        self.write("full/.solidus", "a file where the folder would be made")
        refused = solidus("init-editor", "full", cwd=self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, r"^solidus: full/\.solidus: cannot make this folder: \w[^\n]*\n  the folder of your cases")

    def test_a_present_folder_that_is_gone_is_named(self):
        command = f"mkdir gone && cd gone && rmdir ../gone && exec '{PROGRAM}' run '{SOURCES}/cases/hot_spots'"
        refused = subprocess.run(["sh", "-c", command], cwd=self.folder, text=True, capture_output=True, timeout=120)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn("solidus: the present folder: No such file or directory\n", refused.stderr)

    def test_colours_are_for_terminals_and_no_color_is_heeded(self):
        wrong = [PROGRAM, "run", "nowhere"]
        self.assertNotIn("\x1b[", solidus(*wrong[1:]).stderr)
        self.assertIn("\x1b[1;31msolidus:\x1b[0m", on_terminal(*wrong))
        self.assertNotIn("\x1b[", on_terminal(*wrong, env={"NO_COLOR": "1"}))
        self.assertNotIn("\x1b[", on_terminal(*wrong, env={"TERM": "dumb"}))

    def test_ctrl_c_ends_a_run_with_130_and_a_checkpoint_other_signals_with_2(self):
        self.write("case.toml", LONG_CASE)
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 2), (signal.SIGHUP, 2)):
            folder = self.folder / number.name
            run = subprocess.Popen([PROGRAM, "run", ".", "-o", folder, "--no-progress"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            for line in run.stdout:  # until steps are taken
                if line.split()[:1] == ["5"]:
                    break
            # One process has no use for MPI's daemon, nor for its search for fast networks, half a second at each start.
            self.assertEqual(children(run.pid), [])
            self.assertNotIn("/mca_mtl_", Path(f"/proc/{run.pid}/maps").read_text())
            run.send_signal(number)
            _, said = run.communicate(timeout=60 * PATIENCE)
            self.assertEqual(run.returncode, code, said)
            self.assertIn("--restart", said)
            self.assertTrue((folder / "checkpoint/state.h5").exists())


if __name__ == "__main__":
    unittest.main()
