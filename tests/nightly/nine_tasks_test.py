"""A newcomer's nine tasks, each by the changes that its page shows, in a copy of the sources that is then built as Solidus: nine_tasks.py."""

import os
from pathlib import Path
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(Path(__file__).parent))

import nine_tasks  # noqa: E402

PARTS = ("CMakeLists.txt", "CMakePresets.json", "CITATION.cff", "LICENSE", "cmake", "src", "python", "docs/developers", "docs/theory", "materials", "interfaces",
         "tests/laws", "web/report/built")


class NineTasks(unittest.TestCase):
    def test_each_touches_two_files_at_most_and_works_in_solidus(self):
        tree = Path(os.environ["SOLIDUS_FOLDER"]) / "nine_tasks"
        shutil.rmtree(tree, ignore_errors=True)
        for part in PARTS:
            source, target = nine_tasks.ROOT / part, tree / part
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, target)
        subprocess.run(["cmake", "--preset", "release", "-DSOLIDUS_TESTS=OFF", "-DSOLIDUS_BATCHES=ON"], cwd=tree, check=True)
        nine_tasks.main(tree, tree / "build/release")


if __name__ == "__main__":
    unittest.main()
