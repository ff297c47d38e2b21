"""README and the guide, page by page: the command lines on them are typed one after the other, as they are, in a folder
that has what the page speaks of (page_scenes.py). `./dev nightly` types all of them and lets runs end; else runs end after a moment of
the casting, and what takes long (pictures, coupled parts) is left out: LONG. Pages whose commands are typed by tests of their own:
python.md, and the numbered part of getting_started.md."""

import os
import re
import shutil
import subprocess
import tomllib
import unittest

from page_scenes import ELSEWHERE, SCENES, Scene
from pages import blocks, is_pattern, typed_lines
from program import PATIENCE, PROGRAM, SOURCES, ProgramTest

WHOLE = "SOLIDUS_WHOLE_PAGES" in os.environ
PAGES = [SOURCES / "README.md", *sorted((SOURCES / "docs/guide").glob("*.md"))]
# Left out but by `./dev nightly`.
LONG = [r"(^|/)dev (run|plot|point|materials) ", r"^solidus (plot|compare) ", r"^solidus run cases/(crankshaft|heat_treatment)", r"--coupled",
        r"--pictures", r"--watch", r"--shots", r"^solidus (study|uncertain|calibrate) (?!.*--dry-run)", r"^mpirun -n 8", r"--sure",
        r"--pdf", r"^solidus pattern "]
# Programs that pages speak of and that a release may lack, as ./dev has them.
OPTIONAL = {"ccx": "CalculiX is not installed (ccx; Debian 13 has no package of it)"}
# The first page's walk, which is typed by guide_test.py.
WALKED = [r"^cd ~/solidus$", r"part( |$)|part\.step|results/part/", r"cases/aluminium_cylinder", r"bracket\.geo \.$"]
RUNNER = """#!/bin/bash
# The program; its runs are shortened where SHORT says how.
for word in "$@"; do
  [[ $word == -* ]] && continue
  [[ $word == run && -n $SHORT ]] && eval "set -- \\"\\$@\\" $SHORT"
  break
done
exec {program} "$@"
"""


class TypedPages(ProgramTest):
    def prepare(self, page, scene):
        """The reader's folder: the files of the scene, `~/solidus` and `./dev`, the program on the path."""
        folder = self.folder / page.stem
        (folder / ".git").mkdir(parents=True)  # within a clone results go to its root, and the folder of the test may lie in one
        (folder / "cases").symlink_to(SOURCES / "cases")
        (folder / "home").mkdir()
        (folder / "home/solidus").symlink_to(SOURCES)
        (folder / "bin").mkdir()
        for name, text in {"bin/solidus": RUNNER.format(program=PROGRAM),
                           "bin/srun": "#!/bin/sh\n[ \"$1\" = --mpi=pmix ] && shift || exit 7\nexec mpirun -n 2 --bind-to none --oversubscribe \"$@\"\n",
                           "dev": f"#!/bin/sh\nexec {SOURCES}/dev \"$@\"\n"}.items():
            (folder / name).write_text(text)
            (folder / name).chmod(0o755)
        for name, source in scene.files.items():
            if (SOURCES / source).is_dir():
                shutil.copytree(SOURCES / source, folder / name)
            else:
                shutil.copy(SOURCES / source, folder / name)
        for name, source in scene.texts.items():
            origin = SOURCES / "docs/guide" / source if source.endswith(".md") else page
            start = 'title = "A steel block' if origin != page else source
            found = [block.text for block in blocks(origin.read_text()) if block.text.startswith(start)]
            self.assertEqual(len(found), 1, f"{page.name}: the block that begins with {start!r}")
            (folder / name).write_text(found[0])
        return folder

    def type(self, folder, line, scene):
        environment = {**os.environ, "PATH": f"{folder}/bin:/usr/bin:/bin", "HOME": str(folder / "home"),
                       "SOLIDUS_PROGRAM": str(folder / "bin/solidus"), "PYTHONPATH": str(SOURCES / "python"),
                       "OMPI_MCA_rmaps_base_oversubscribe": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
                       "MPLBACKEND": "Agg",
                       "SHORT": "" if WHOLE or "time.end" in line else f"--set time.end='{scene.end}'"}
        done = subprocess.run(["bash", "-ec", line], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=3600 * PATIENCE)
        self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout[-1500:]}{done.stderr[-1500:]}")

    @staticmethod
    def put_in(line, scene):
        """The line with CASE, FOLDER and the like replaced; None where something stays open."""
        words = {"CASE": "case.toml", "FOLDER": "somewhere", "NAME": "aluminium_alsi7mg", **scene.words}
        for word in set(filter(is_pattern, re.split(r"[\s:]", line))):  # FOLDER:VARIANT too
            if word not in words:
                return None
            line = re.sub(rf"(?<!\S){word}(?![^\s:])", words[word], line)
        return line

    def test_every_command_of_every_page_can_be_typed_as_it_stands(self):
        typed = long = 0
        for page in PAGES:
            if page.name == "python.md":
                continue
            scene = SCENES.get(page.name, Scene())
            lines = list(dict.fromkeys(typed_lines(page.read_text())))
            if not lines:
                continue
            folder = self.prepare(page, scene)
            ready = False
            for line in lines:
                bare = re.sub(r"\s+#.*", "", line)
                if bare in ELSEWHERE or (page.name == "getting_started.md" and any(re.search(p, bare) for p in WALKED)):
                    continue
                if not WHOLE and any(re.search(pattern, bare) for pattern in LONG):
                    long += 1
                    continue
                for before in [] if ready else scene.lines:
                    self.type(folder, before, scene)
                ready = True
                with self.subTest(page=page.name, line=line):
                    program = bare.split()[0]
                    if program in OPTIONAL and shutil.which(program) is None:
                        self.skipTest(OPTIONAL[program])
                    whole = self.put_in(line.replace("/usr/share/solidus", str(SOURCES)), scene)
                    self.assertIsNotNone(whole, "a place that page_scenes.py does not fill")
                    self.type(folder, whole, scene)
                    typed += 1
        self.assertGreater(typed, 50 if not WHOLE else 70)
        self.assertLess(long, 42)

    def test_whole_cases_and_point_files_on_every_page_run(self):
        """As they are; the cases end after a moment unless all is whole."""
        for page in PAGES:
            for number, block in enumerate(blocks(page.read_text())):
                is_case = all(word in block.text for word in ("[analysis]", "[mesh]", "[[body]]", "[time]"))
                if block.language != "toml" or not (is_case or "[[segment]]" in block.text):
                    continue
                if page.name == "getting_started.md":  # run by guide_test.py
                    continue
                with self.subTest(page=page.name, block=block.text.splitlines()[0]):
                    folder = self.folder / f"{page.stem}_{number}"
                    folder.mkdir()
                    (folder / ".git").mkdir()
                    for name in re.findall(r'^file = "(\w+\.geo)"', block.text, re.M):
                        shutil.copy(sorted(SOURCES.glob(f"cases/*/{name}"))[0], folder)
                    (folder / "case.toml").write_text(block.text)
                    verb = "run" if is_case else "point"
                    step = tomllib.loads(block.text)["time"]["step"] if is_case else None
                    short = ["--set", f"time.end={step}"] if is_case and not WHOLE else []
                    self.done(verb, "case.toml", *short, cwd=folder, timeout=3600)

    def test_what_is_said_to_be_typed_elsewhere_stands_on_a_page(self):
        all_lines = {re.sub(r"\s+#.*", "", line) for page in PAGES for line in typed_lines(page.read_text())}
        self.assertEqual(set(ELSEWHERE) - all_lines, set())


if __name__ == "__main__":
    unittest.main()
