"""The pages of the documents: no dead link, a way on from each; and the site that mkdocs makes of them."""

import html
import json
import pathlib
import re
import subprocess
import tempfile
import unittest
import urllib.parse

from solidus_docs import links, site

# Renders every formula of a JSON list with KaTeX, and prints those that it cannot.
KATEX = """
const katex = require("/usr/share/javascript/katex/katex.js");
for (const [page, text, displayMode] of JSON.parse(require("fs").readFileSync(0, "utf8")))
  try { katex.renderToString(text, {displayMode, throwOnError: true}); } catch (error) { console.log(page + ": " + text + ": " + error.message); }
"""


def page(folder, name, text):
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


class Pages(unittest.TestCase):
    def test_no_link_is_dead_and_every_page_leads_on(self):
        self.assertEqual(links.mistakes(), [])
        self.assertGreater(len(links.pages()), 80)

    def test_dead_links_missing_headings_and_pages_without_a_way_on_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            page(folder, "README.md", "# A\n[b](docs/b.md#a-heading--of-it) [c](docs/c.md#nothing) [d](docs/d.md)\n")
            page(folder, "docs/b.md", "# B\n## A heading, – of *it*\n`[x](nowhere.md)`\n\n```\n[y](nowhere.md)\n```\n[a](../README.md)\n")
            page(folder, "docs/c.md", "# C\n[web](https://example.org)\n")
            self.assertEqual(links.mistakes(folder),
                             ["README.md: 'docs/c.md#nothing': the page has no such heading",
                              "README.md: 'docs/d.md' does not exist", "docs/c.md: no link leads on to another page"])

    def test_paths_of_sources_that_are_not_there_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            for file in ("src/heat/storage.cpp", "src/heat/storage.hpp", "tests/unit/heat/storage_test.cpp", "dev"):
                page(folder, file, "")
            text = "`heat/storage` `src/heat/{storage,flow}.hpp` `base/lane` `results/CASE` `kW/m2` `src/heat/*.cpp` `src/my_law.hpp`\n"
            page(folder, "docs/decisions/0001.md", text)
            page(folder, "docs/guide/run.md", text + "`tests/unit/heat` `tests/unit/base`\n")
            self.assertEqual(links.dead_paths(folder / "docs/decisions/0001.md", folder),
                             ["src/heat/{storage,flow}.hpp", "base/lane", "kW/m2"])
            self.assertEqual(links.dead_paths(folder / "docs/guide/run.md", folder), ["src/heat/{storage,flow}.hpp", "tests/unit/base"])

    def test_every_page_stands_in_the_navigation(self):
        listed = set(site.listed(site.configuration()["nav"]))
        elsewhere = {"tests/verification/reference/README.md"}
        self.assertEqual({str(file.relative_to(links.ROOT)) for file in links.pages()} - elsewhere, listed)

    def test_what_belongs_to_an_item_stands_four_columns_in(self):
        self.assertEqual(site.for_python_markdown("Text\n1. one\n\n   ```sh\n   x\n   ```\n2. two\n\nEnd\n   kept\n"),
                         "Text\n\n1. one\n\n    ```sh\n    x\n    ```\n2. two\n\nEnd\n   kept\n")
        self.assertEqual(site.for_python_markdown("```\nText\n- no item\n```\n"), "```\nText\n- no item\n```\n")


class Site(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.root = site.build(cls.temporary.name + "/docs").parent
        cls.pages = {file: file.read_text() for file in cls.root.rglob("*.html")}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_all_its_links_lead_somewhere_and_none_needs_the_net(self):
        anchors = {file: set(re.findall(r'id="([^"]*)"', text)) for file, text in self.pages.items()}
        dead, count = [], 0
        for file, text in self.pages.items():
            for loads in re.findall(r'(?:src|<link[^>]*href)="(https?:[^"]*)"', text):
                dead.append(f"{file.name} loads {loads}")
            for target in map(html.unescape, re.findall(r'href="([^"]*)"', text)):
                if re.match(r"[a-z]+:", target) or target.startswith("/"):
                    continue
                count += 1
                path, _, anchor = target.partition("#")
                place = (file.parent / urllib.parse.unquote(path.split("?")[0])).resolve() if path else file
                if not place.exists():
                    dead.append(f"{file.name}: {target}")
                elif anchor and place in anchors and urllib.parse.unquote(anchor) not in anchors[place]:
                    dead.append(f"{file.name}: {target}: no such heading")
        self.assertEqual(dead, [])
        self.assertGreater(count, 10000)

    def test_every_formula_can_be_drawn(self):
        formulas = []
        for file, text in self.pages.items():
            for mark, found in re.findall(r'class="arithmatex">\\([\[(])(.*?)\\[\])]</', text, re.S):
                formulas.append([file.name, html.unescape(found), mark == "["])
        self.assertGreater(len(formulas), 500)
        done = subprocess.run(["node", "-e", KATEX], input=json.dumps(formulas), capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stdout.splitlines(), [])

    def test_the_search_knows_the_pages_without_a_server(self):
        index = (self.root / "search/search_index.js").read_text()
        self.assertTrue(index.startswith("var __search = {index: Promise.resolve("))
        self.assertIn("Niyama", index)


if __name__ == "__main__":
    unittest.main()
