"""`./dev release --tag`: the tag is there where the release was made, and taken back however it failed."""

import os
from pathlib import Path
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = Path(__file__).resolve().parents[2]
# What ./dev calls, in place of packages, a build of minutes and an archive: each does what it is named for, or what FAILS says.
TOOLS = {
    "dpkg-query": "printf installed",
    "cmake": 'case "$1" in\n'
             '  --build) [ "$FAILS" != build ] || exit 1\n'
             '    [ "$FAILS" != patience ] || { touch waits; exec sleep 60; }\n'
             '    mkdir -p build/portable/python && touch build/portable/python/_core.so ;;\n'
             '  *) [ "$FAILS" != configure ] || exit 1; mkdir -p build/portable ;;\n'
             'esac',
    "cpack": '[ "$FAILS" != cpack ]',
}
FILLS = 'import os, sys\nsys.exit("no archive") if os.environ.get("FAILS") == "archive" else print("build/releases/1.2.3")\n'


@unittest.skipIf(shutil.which("git") is None, "git is not installed")
class Tag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree, tools = Path(folder.name) / "tree", Path(folder.name) / "tools"
        package = self.tree / "python/solidus_release"
        package.mkdir(parents=True)
        tools.mkdir()
        shutil.copy(ROOT / "dev", self.tree)
        (self.tree / "CMakeLists.txt").write_text("project(solidus VERSION 1.2.3 LANGUAGES CXX)\n")
        (self.tree / ".gitignore").write_text("/build/\n/waits\n__pycache__/\n")
        for name, text in (("__init__", ""), ("notes", ""), ("__main__", FILLS)):
            (package / f"{name}.py").write_text(text)
        for name, text in TOOLS.items():
            (tools / name).write_text(f"#!/bin/sh\n{text}\n")
            (tools / name).chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8", "NO_COLOR": "1",
                            "PYTHONDONTWRITEBYTECODE": "1", "GIT_CONFIG_GLOBAL": "/dev/null"}
        for who in ("AUTHOR", "COMMITTER"):
            self.environment |= {f"GIT_{who}_NAME": "A Founder", f"GIT_{who}_EMAIL": "founder@example.org"}
        self.git("init", "-q")
        self.git("add", "--all")
        self.git("commit", "-q", "-m", "All there is")

    def git(self, *arguments):
        return subprocess.run(["git", *arguments], cwd=self.tree, env=self.environment, check=True, capture_output=True,
                              text=True).stdout.strip()

    def release(self, fails=""):
        return subprocess.Popen(["bash", "dev", "release", "--tag"], cwd=self.tree, env={**self.environment, "FAILS": fails}, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)

    def test_a_release_leaves_the_tag_of_its_version(self):
        release = self.release()
        said = release.communicate(timeout=60)[1]
        self.assertEqual(release.returncode, 0, said)
        self.assertIn("the tag v1.2.3 is made; git push origin v1.2.3 publishes it", said)
        self.assertIn("the release: build/releases/1.2.3", said)
        self.assertEqual(self.git("tag", "--list"), "v1.2.3")
        self.assertEqual(self.git("cat-file", "-t", "v1.2.3"), "tag")  # with a date and a name
        self.assertEqual(self.git("rev-parse", "v1.2.3^{commit}"), self.git("rev-parse", "HEAD"))

        again = self.release()
        said = again.communicate(timeout=60)[1]
        self.assertEqual(again.returncode, 1)
        self.assertIn("dev: the tag v1.2.3 could not be made", said)
        self.assertEqual(self.git("tag", "--list"), "v1.2.3")  # which is that of the release before

    def test_a_release_that_fails_takes_its_tag_back(self):
        for step in ("configure", "build", "cpack", "archive"):
            release = self.release(step)
            said = release.communicate(timeout=60)[1]
            self.assertEqual(release.returncode, 1, step)
            self.assertIn("the tag v1.2.3 is taken back", said, step)
            self.assertEqual(self.git("tag", "--list"), "", step)

    def test_a_release_that_is_interrupted_takes_its_tag_back(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            release = self.release("patience")
            deadline = time.monotonic() + 60
            while not (self.tree / "waits").exists() and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertEqual(self.git("tag", "--list"), "v1.2.3")
            os.killpg(release.pid, number)  # as a terminal does
            said = release.communicate(timeout=60)[1]
            self.assertNotEqual(release.returncode, 0)
            self.assertIn("the tag v1.2.3 is taken back", said)
            self.assertEqual(self.git("tag", "--list"), "")
            (self.tree / "waits").unlink()


if __name__ == "__main__":
    unittest.main()
