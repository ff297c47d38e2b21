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

# Asks the search of a site, as the browser does it, for each line of a JSON list; prints the pages that it finds, best first.
SEARCH = """
const fs = require("fs"), vm = require("vm"), folder = process.argv[1], workers = folder + "/assets/javascripts/workers/";
let answered;
const world = {console, addEventListener: (_, listen) => { world.listen = listen; }, postMessage: message => answered(message)};
world.self = world;
vm.runInNewContext(fs.readFileSync(workers + fs.readdirSync(workers).find(name => /^search.*[.]min[.]js$/.test(name)), "utf8"), world);
const ask = data => new Promise(resolve => { answered = resolve; world.listen({data}); });
(async () => {
  const index = JSON.parse(fs.readFileSync(folder + "/search/search_index.json"));
  await ask({type: 0, data: {...index, options: {pipeline: ["trimmer", "stopWordFilter"], suggestions: false}}});
  const found = [];
  for (const query of JSON.parse(fs.readFileSync(0, "utf8")))
    found.push((await ask({type: 2, data: query})).data.items.map(([best]) => best.location.split("#")[0]));
  console.log(JSON.stringify(found));
})();
"""

# What somebody types who wants to do what a page of the guide is for: in the words of its heading, in words of his own, and in others.
TASKS = {
    "assistants": ["let an assistant compute a casting", "chatbot or language model", "use ChatGPT with Solidus"],
    "block_iterative": ["solve both phases in alternation", "iterate between heat and mechanics", "coupling scheme that iterates"],
    "calibrate": ["heat transfer coefficient from thermocouples", "fit the interface to measurements", "inverse heat conduction"],
    "case_file": ["write a case file", "describe a casting in a text file", "keys of a case"],
    "citing": ["cite Solidus in a paper", "reference for a publication", "how do I cite the program"],
    "command_line": ["which commands can I type", "options of the command line", "list of commands"],
    "compare": ["compare two runs", "difference between two results", "compare a run with another run"],
    "contact": ["contact with friction between two bodies", "friction coefficient", "friction of the casting in the die"],
    "criteria": ["find hot spots and porosity", "shrinkage porosity Niyama", "where will there be porosity"],
    "customer": ["report for a customer as PDF", "PDF with our logo", "print the results for a customer"],
    "design": ["find the smallest riser", "design risers automatically", "optimise feeders and chills"],
    "dies": ["cooling channels of a die", "water in a die", "how many shots does a die live", "thermal fatigue of a die", "soldering of a die"],
    "enclosure": ["radiation between surfaces", "view factors of a furnace", "parts of a tree radiate to each other"],
    "export": ["residual stress for a structural analysis", "export to Abaqus or CalculiX", "take residual stress to Ansys"],
    "external_laws": ["use my own constitutive law", "MFront law", "my UMAT subroutine"],
    "feeding": ["is the riser large enough", "riser pipe and shrinkage cavity", "does the feeder reach the hot spot"],
    "filling": ["how does the metal fill the mould", "misrun and cold shut", "simulate mould filling with OpenFOAM"],
    "findings": ["what does the warning of check mean", "check finds mistakes in my case", "what does check look at"],
    "formats": ["read a mesh of another program", "Abaqus, Nastran or UNV mesh", "import a Nastran mesh"],
    "gas": ["gas pores from hydrogen", "hydrogen porosity in aluminium", "nitrogen blowholes in steel"],
    "getting_started": ["build from the sources", "compile Solidus", "build Solidus myself"],
    "heat_treatment": ["quench a casting in water", "solution treatment and ageing", "stress relief annealing"],
    "heat_through_contact": ["heat through an air gap", "heat transfer coefficient between casting and mould", "heat transfer coefficient of a die coating"],
    "install": ["install on Debian", "install the Debian package", "how to install on Ubuntu"],
    "interfaces": ["find the faces between casting and mould", "interface between bodies of a STEP file", "interfaces found automatically"],
    "loads": ["load that changes over place and time", "centrifugal casting of a pipe", "metallostatic pressure on a core"],
    "material_import": ["import a material from JMatPro", "Thermo-Calc table", "material from pycalphad"],
    "materials": ["write a material card", "alloy is not in the library", "add an alloy"],
    "melt": ["how the melt is described", "viscosity of the melt", "stress in liquid metal"],
    "new_case": ["from a STEP file to a case", "start with a STEP file", "case from CAD geometry"],
    "open": ["graphical user interface", "set up a casting by clicking", "preprocessor with a mouse"],
    "parallel": ["run on several processes", "how many processors", "run with mpirun on a cluster"],
    "pattern": ["pattern allowance for contraction", "compare a scanned part with the drawing", "shape of the pattern"],
    "places": ["film coefficient that varies over place", "temperature given by a formula", "spray only on part of the surface"],
    "plots": ["draw pictures of a run", "plot a temperature curve", "picture of the temperature field"],
    "point": ["test a material at a point", "tensile test of a material", "creep curve of a material"],
    "python": ["drive a run from Python", "Python script", "run Solidus in a Jupyter notebook"],
    "report": ["look at a run in the browser", "share the result with a colleague", "HTML report"],
    "reporting": ["report a problem", "I have found a bug", "where do I report a bug"],
    "restart": ["stop a run and restart it", "computer was switched off during a run", "continue an interrupted run"],
    "results": ["what the files of results hold", "open results in ParaView", "which files does a run write"],
    "sand": ["sand that gives way as the casting contracts", "mould restraint of furan sand", "strength of a sand core"],
    "shots": ["many shots into a warm die", "die temperature after ten shots", "temperature of the die in the periodic state"],
    "simultaneous": ["solve both fields at once", "monolithic scheme", "fully coupled solution"],
    "stages": ["open the mould after a time", "shake out the casting", "eject the casting after 60 s"],
    "study": ["run many variants of a case", "parameter study", "vary a parameter"],
    "time_steps": ["choose the time step", "run is too slow", "adaptive time steps"],
    "travelling": ["heat source that moves along a weld", "weld bead that is deposited along a path", "Goldak double ellipsoid"],
    "troubleshooting": ["understand an error message", "step does not converge", "Newton fails"],
    "uncertain": ["how uncertain is the answer", "uncertain material data", "sensitivity to material data"],
    "windows": ["use Solidus under Windows", "WSL", "files of Windows with decimal commas"],
    "versions": ["what changes between versions", "compatible with an older version", "will my case run with the next version"],
}


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

    def test_states_of_the_search_are_told_apart(self):
        text = 't.TokenSet.prototype.toString=function(){for(;i<n;i++){var s=r[i],o=this.edges[s];e=e+s+o.id}return e},t.x=function(){}'
        self.assertEqual(site.with_separated_states(text), text.replace("o.id}", 'o.id+","}'))
        (worker,) = self.root.glob("assets/javascripts/workers/search.*.min.js")
        self.assertRegex(worker.read_text(), r'\.id\+","\}return')

    def test_a_stop_word_is_not_the_beginning_of_others(self):
        text = "map(r=>/(^[+-]|[~^]\\d+$)/.test(r)?r:`${r}*`).join"
        whole = "lunr.stopWordFilter&&!lunr.stopWordFilter(r.toLowerCase())?r:`${r}*`"
        self.assertEqual(site.with_whole_stop_words(text), text.replace("`${r}*`", whole))
        self.assertEqual(site.with_whole_stop_words("of another version"), "of another version")

    def test_the_search_finds_each_page_of_the_guide_by_its_task_among_the_first_three(self):
        self.assertEqual(set(TASKS), {file.stem for file in (links.ROOT / "docs/guide").glob("*.md")})
        wanted = [(f"docs/guide/{page}.html", task) for page, tasks in TASKS.items() for task in tasks]
        done = subprocess.run(["node", "-e", SEARCH, self.root], input=json.dumps([task for _, task in wanted]), capture_output=True,
                              text=True, check=True)
        found = json.loads(done.stdout)
        self.assertEqual([f"{task}: {pages[:3]}" for (place, task), pages in zip(wanted, found) if place not in pages[:3]], [])

    def test_words_of_the_search_are_single_and_belong_to_pages(self):
        words = site.yaml.safe_load((links.ROOT / "docs/site/words.yml").read_text())
        self.assertEqual([name for name in words if not (links.ROOT / name).is_file()], [])
        self.assertEqual([(name, word) for name, list_ in words.items() for word in list_ if not word.isalnum() or word != word.lower()], [])


if __name__ == "__main__":
    unittest.main()
