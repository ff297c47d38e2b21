"""Every page of the guide and the README: what they tell to type is typed, what they print as a file is checked, from the
page itself. The first page, getting_started.md, is run (see there), and the tutorials' runs are shortened; commands of the other
pages are checked here and typed by typed_pages_test.py."""

import functools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
import unittest

from fragments import fits
from pages import blocks, commands, is_pattern
from program import SOURCES, ProgramTest, solidus
from solidus_plots.calibrate_file import read_calibration
from solidus_plots.customer_template import read_template
from solidus_plots.plots_file import read_spec
from solidus_plots.study_file import read_study

PAGES = [SOURCES / "README.md", *sorted((SOURCES / "docs/guide").glob("*.md")), *sorted((SOURCES / "docs/tutorials").glob("*.md"))]
DEV = {"help"} | set(re.findall(r"^  (\w+) ", subprocess.run([SOURCES / "dev", "help"], capture_output=True, text=True,
                                                  check=True).stdout, re.M))
WHOLE = "SOLIDUS_WHOLE_PAGES" in os.environ  # every command of the first page, to its end
# What is typed as it is: quick, and it writes nothing but into the present folder.
TYPED = {"help", "explain", "schema", "version", "materials", "completion", "man", "init-editor", "check"}


def is_case(text):
    return "[analysis]" in text and "[mesh]" in text and "[[body]]" in text


@functools.cache
def schemas():
    return [json.loads(solidus("schema", *kind).stdout) for kind in ([], ["--material"], ["--point"])]


@functools.cache
def options():
    """Verb -> the options that it has, by the manual page."""
    page = solidus("man").stdout.replace("\\-", "-")
    verbs = re.split(r"^\.SS \\fBsolidus ", page, flags=re.M)[1:]
    found = {}
    for verb in verbs:  # `materials import` has what is listed under it and under `materials`
        found.setdefault(re.match(r"[a-z-]+", verb)[0], set()).update(re.findall(r"\\fB(--?[a-z][a-z-]*)", verb))
    return found


class Guide(ProgramTest):

    def type(self, words):
        """Types a command, or as much of it as can be typed: verbs and options must be there in any case."""
        if words[0] == "./dev":
            self.assertTrue(len(words) == 1 or words[1] in DEV, words)
            if words[1:2] not in (["run"], ["point"]):
                return
        arguments = [word for word in words[1:] if word not in ("...", "…")]
        if not arguments:
            return
        verb = next((word for word in arguments if not word.startswith("-") and word not in ("debug", "warn")), None)
        if verb is not None and not is_pattern(verb):
            for word in arguments:
                if re.match(r"^--?[a-z]", word) and word != "--":
                    self.assertIn(word, options()[verb] | {"--log", "-heat_ksp_monitor"}, words)
        if any(map(is_pattern, arguments)):
            return
        if verb == "run":
            arguments = ["check", *self.without_run_options(arguments)]
            verb = "check"
        if verb is not None and verb not in TYPED:
            return
        paths = [word for word in arguments if word.startswith("cases/")]
        places = [word for word in arguments if word.endswith(".toml") and word not in paths]
        if any(not (self.folder / place).exists() for place in places) or (verb == "check" and not paths + places):
            return
        if tuple(arguments) not in self.typed:
            self.typed.add(tuple(arguments))
            self.done(*arguments, cwd=SOURCES if paths else self.folder)

    @staticmethod
    def without_run_options(arguments):
        kept, skip = [], False
        for word in arguments[arguments.index("run") + 1:]:
            if skip:
                skip = False
            elif word in ("-o", "--output"):
                skip = True
            elif word not in ("--restart", "--no-progress", "--profile", "--watch", "--report", "--sure"):
                kept.append(word)
        return kept

    def test_commands_of_every_page_are_understood(self):
        self.typed, found = set(), set()
        for page in PAGES:
            for words in commands(page.read_text()):
                if tuple(words) in found:
                    continue
                found.add(tuple(words))
                with self.subTest(page=page.name, command=" ".join(words)):
                    self.type(words)
        self.assertGreater(len(found), 30)  # they are found at all
        self.assertGreater(len(self.typed), 10)

    def test_texts_of_files_on_every_page_have_keys_and_values_that_there_are(self):
        count = 0
        for page in PAGES:
            for block in blocks(page.read_text()):
                if block.language != "toml":
                    continue
                count += 1
                with self.subTest(page=page.name, block=block.text.splitlines()[0]):
                    fragment = tomllib.loads(self.without_second_values(block.text))
                    if page.name == "plots.md":
                        self.assertEqual(read_spec(self.write("plots.toml", block.text))[1], [])
                    elif page.name == "study.md":
                        read_study(self.write("study.toml", block.text))
                    elif page.name == "calibrate.md":
                        # A calibration seeks something: a part of one that shows other keys gets an unknown.
                        sought = "" if "unknown" in fragment else '\n[[unknown]]\nname = "clock"\nkind = "clock"\n'
                        read_calibration(self.write("calibrate.toml", block.text + sought))
                    elif page.name == "customer.md":
                        self.write("logo.svg", "<svg/>")
                        read_template(self.write("customer.toml", block.text))
                    elif set(fragment) <= {"part", "variant"}:  # sections of a case under names of their own
                        for pieces in fragment.values():
                            for piece in pieces.values():
                                self.assertEqual(fits(piece, schemas()), [])
                    else:
                        self.assertEqual(fits(fragment, schemas()), [])
        self.assertGreater(count, 40)

    @staticmethod
    def without_second_values(text):
        """Pages show several ways to write one key, one below the other: TOML allows the last of them alone."""
        lines, last = [], None
        for line in text.splitlines():
            key = re.match(r"^(\w+) = ", line)
            if key and key[1] == last:
                lines.pop()
            lines.append(line)
            last = key[1] if key else None
        return "\n".join(lines)

    def test_whole_cases_on_every_page_are_in_order(self):
        found = 0
        for page in PAGES:
            for number, block in enumerate(blocks(page.read_text())):
                if block.language != "toml" or not is_case(block.text):
                    continue
                found += 1
                with self.subTest(page=page.name):
                    folder = self.folder / f"{page.stem}_{number}"
                    folder.mkdir()
                    self.provide(folder, block.text)
                    (folder / "case.toml").write_text(block.text)
                    self.assertIn("The case is in order.", self.done("check", "case.toml", cwd=folder))
        self.assertGreaterEqual(found, 2)

    def provide(self, folder, text):
        for name in re.findall(r'^file = "([\w.]+)"', text, re.M):
            source = sorted(SOURCES.glob(f"cases/*/{name}"))[0]
            shutil.copy(source, folder)

    def follow(self, line):
        """Types a line of a page as it is, in the folder of the test; `~/solidus` is where the sources lie, and
        `dev run` the program that it would build. @return what was printed"""
        words = shlex.split(line.replace("~/solidus", str(SOURCES)), comments=True)
        words = words[:words.index("|")] if "|" in words else words
        if words[0] in ("./dev", f"{SOURCES}/dev"):
            words = ["solidus", words[1], "--report", *words[2:]]
        if words[0] != "solidus":
            return subprocess.run(words, cwd=self.folder, check=True, capture_output=True, text=True).stdout
        arguments = [str(SOURCES / word) if word.startswith("cases/") else word for word in words[1:]]
        return self.done(*arguments, cwd=self.folder, timeout=600)

    def test_a_newcomer_gets_from_the_first_page_to_results(self):
        """The commands of docs/guide/getting_started.md one after the other, as they are there and to their end, in an
        empty folder; then the Python of docs/guide/results.md reads what they left. `./dev nightly` runs all of them. Else
        the pictures and the coupled run of the part are left out, a minute of one core, and the second run of the cylinder and
        the case by hand, which has to be the one that its notebook runs, end after a second."""
        (self.folder / ".git").mkdir()  # within a clone results go to its root, and the folder of the test may lie in one
        page = (SOURCES / "docs/guide/getting_started.md").read_text()
        case, = (block.text for block in blocks(page) if block.language == "toml")
        indented = [line.strip() for line in page.splitlines() if re.match(r"    (\./dev|cp|solidus|~)", line)]
        shell = [line for block in blocks(page) if block.language == "sh" for line in block.text.splitlines()]
        *there, copy, make, heat, report, plot, coupled = indented
        self.assertEqual(len(there), 2)
        for number, line in enumerate(there):  # from the clone and from elsewhere: the same run, which once goes to its end
            once = number == 0 or WHOLE
            self.assertIn("solid; its last melt froze" if once else "% solid 1 s after pouring",
                          self.follow(line if once else f"{line} --set time.end='1 s'"), line)
        self.assertTrue((self.folder / "results/aluminium_cylinder/default/report.html").is_file())
        self.follow(copy)
        self.assertIn("Written to part/case.toml. Next: solidus check part", self.follow(make))
        self.assertRegex(self.follow(heat), r"casting 'casting' +solid; its last melt froze")
        part = self.folder / "results/part/default"
        self.follow(report)
        self.assertGreater((part / "report.html").stat().st_size, 1e5)
        if WHOLE:
            self.follow(plot)
            self.assertGreater(len(list((part / "plots").glob("*.png"))), 3)
            said = self.follow(coupled)
            self.assertRegex(said, r"casting 'casting' +solid; its last melt froze")
            self.assertRegex(said, r"largest von Mises stress +[\d.]+ MPa")
        self.assertTrue(plot.startswith("solidus plot results/part/default") and "--coupled part" in coupled)
        self.write("case.toml", case)  # "a text file next to the mesh"
        self.assertEqual(tomllib.loads(case), tomllib.loads((SOURCES / "cases/bracket/case.toml").read_text()))
        copy, look, run = shell
        self.follow(copy)
        self.assertIn("part_surface", self.follow(look))
        said = self.follow(run if WHOLE else run.replace("case.toml", "case.toml --set time.end='1 s'", 1))
        self.assertRegex(said, r"casting 'part' +" + ("solid; its last" if WHOLE else r"\d+\.\d % solid 1 s after pouring"))
        # What the pages tell of other runs is read from these: any results will do.
        (self.folder / "results" / self.folder.name).rename(self.folder / "results/crankshaft")
        for name in ("results.md", "plots.md"):
            for block in blocks((SOURCES / "docs/guide" / name).read_text()):
                if block.language == "python":
                    done = subprocess.run([sys.executable, "-c", block.text], cwd=self.folder, capture_output=True,
                                          text=True, env={**os.environ, "PYTHONPATH": str(SOURCES / "python")})
                    self.assertEqual(done.returncode, 0, f"{name}: {done.stderr}")
                    self.assertTrue(done.stdout.strip())

    def test_the_tutorials_can_be_followed(self):
        """Their commands one after the other, in a folder each, as they are there; runs end after two seconds of the
        casting, the first one of shots after two shots and those next to it after one, coupled runs in space are left out, and so
        are pictures. Then their Python, as one program; every picture of theirs is there."""
        for page in sorted((SOURCES / "docs/tutorials").glob("*.md")):
            folder = self.folder / page.stem
            folder.mkdir()
            lines = [line for block in blocks(page.read_text()) if block.language == "sh" for line in block.text.splitlines()]
            for line in lines:
                with self.subTest(page=page.name, line=line):
                    words = shlex.split(line.replace("/usr/share/solidus", str(SOURCES)))
                    if words[0] != "solidus":
                        subprocess.run(words, cwd=folder, check=True)
                        continue
                    if words[1] == "run" and "bracket" in words and "--coupled" in words:
                        continue  # it was checked above; tests/cases/step_test.cpp runs a new case coupled
                    if words[1] == "run":
                        name = words[2] if not words[2].startswith("-") else words[3]
                        shots = 1 if "-o" in words else 2
                        words += ["--set", f"cycle.shots.repeat={shots}" if name == "wheel_in_die" else "time.end=2 s"]
                        words += [] if "-o" in words else ["-o", f"results/{name}/default"]
                    words += ["--no-plots"] if words[1] == "compare" else []
                    if words[1] != "plot" and "--riser" not in words:  # slow, and tests of their own
                        self.done(*words[1:], cwd=folder, timeout=600)
            python = [block.text for block in blocks(page.read_text()) if block.language == "python"]
            if python:
                with self.subTest(page=page.name, line="Python"):
                    done = subprocess.run([sys.executable, "-c", "\n".join(python)], cwd=folder, capture_output=True, text=True,
                                          env={**os.environ, "PYTHONPATH": str(SOURCES / "python"), "MPLBACKEND": "Agg"})
                    self.assertEqual(done.returncode, 0, done.stderr)
            if page.stem != "README":
                self.assertGreater(len(lines) + 2 * len(python), 3, page.name)
                pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", page.read_text())
                self.assertTrue(pictures, page.name)
                for picture in pictures:
                    self.assertTrue((page.parent / picture).is_file(), picture)

    def test_the_table_of_check_stands_on_its_page_as_it_is_printed(self):
        page = (SOURCES / "docs/guide/findings.md").read_text()
        shown = next(block for block in blocks(page) if "`solidus check cases/bracket` prints" in block.before)
        printed = self.done("check", "cases/bracket", cwd=SOURCES)

        def words(text):  # numbers depend on Gmsh's mesh and on the machine
            return [re.sub(r"[\d.]+(e-?\d+)?", "#", line).split() for line in text.splitlines() if line.strip()]

        self.assertEqual(words(shown.text), words(printed)[:len(words(shown.text))])


if __name__ == "__main__":
    unittest.main()
