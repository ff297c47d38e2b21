"""The site of the documents, by mkdocs with the theme of Material (Debian's mkdocs-material and libjs-katex).

    python3 -m solidus_docs.site FOLDER

The pages are copied as they lie in the repository, with everything that they link to, so that the links of the Markdown hold.
The site needs no net, nor a server: index.html opens from the disk, with its search.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import yaml

from solidus_docs.links import ROOT, links, pages, resolved

KATEX = pathlib.Path("/usr/share/javascript/katex")
ITEM = re.compile(r"^( *)([-*]|\d+\.)( +)\S")
FENCE = re.compile(r"^ *(```+|~~~+)")


class Names(yaml.SafeLoader):
    """Keeps `!!python/name:…` as it is: mkdocs reads it."""


class Name(str):
    pass


Names.add_multi_constructor("tag:yaml.org,2002:python/name:", lambda loader, suffix, node: Name(suffix))
yaml.SafeDumper.add_representer(Name, lambda dumper, name: dumper.represent_scalar(
    f"tag:yaml.org,2002:python/name:{name}", ""))


def configuration():
    """The configuration with the pages of decisions, logs and cases, which are as many as there are."""
    config = yaml.load((ROOT / "docs/site/mkdocs.yml").read_text(), Names)

    def titled(files):
        named = []
        for file in files:
            title = re.search(r"^# (.*)", file.read_text(), re.M)[1]
            named.append({re.sub(r"[`*]", "", title): str(file.relative_to(ROOT))})
        return named

    decisions = ROOT / "docs/decisions"
    lists = {"Decisions": [str((decisions / "README.md").relative_to(ROOT)),
                           *titled(sorted(file for file in decisions.glob("*.md") if file.name != "README.md"))],
             "Logs": titled(sorted((ROOT / "docs/log").rglob("*.md"))),
             "Cases": titled(sorted((ROOT / "cases").rglob("*.md")))}

    def fill(entries):
        for entry in entries:
            for name, value in entry.items() if isinstance(entry, dict) else ():
                if name in lists and value == []:
                    entry[name] = lists[name]
                elif isinstance(value, list):
                    fill(value)

    fill(config["nav"])
    return config


def listed(entries):
    """The pages of a nav."""
    for entry in entries:
        if isinstance(entry, str):
            yield entry
        else:
            for value in entry.values():
                yield from listed([value] if isinstance(value, str) else value)


def for_python_markdown(text):
    """What GitHub reads otherwise than Python's Markdown: what belongs to an item of a list is indented by four columns, and a list
    needs an empty line in front of it."""
    lines, inside, width, before = [], None, 0, ""
    for line in text.splitlines():
        fence = FENCE.match(line)
        indent = len(line) - len(line.lstrip(" "))
        if inside is None and line.strip():
            item = ITEM.match(line)
            if item and not item[1]:
                if before.strip() and not width:
                    lines.append("")
                width = len(item[2]) + len(item[3])
            elif indent < width and not (before.strip() and indent > 0):
                if not before.strip() or fence or line.startswith("#"):
                    width = 0
        shift = 4 - width if width and indent >= width else 0
        lines.append(" " * shift + line if line.strip() and shift > 0 else line)
        if fence:
            mark = fence[1]
            if inside is None:
                inside = mark
            elif mark.startswith(inside) and line.strip() == mark:
                inside = None
        before = line
    return "\n".join(lines) + "\n"


def with_words(index):
    """The index of the search with the words of docs/site/words.yml, as tags of the entries that stand for whole pages."""
    words = yaml.safe_load((ROOT / "docs/site/words.yml").read_text())
    for entry in index["docs"]:
        tags = words.get(entry["location"].removesuffix(".html") + ".md")
        if tags:
            entry["tags"] = tags
    return index


def with_separated_states(worker):
    """The script of the search with states of its automaton that cannot be taken for each other.

    lunr merges states whose texts are alike; a text is that of the characters and numbers of the states they lead to, put together
    without a sign between: "1" to state 23 is "12" to state 3. Which words collide hangs on all pages; a search for one fails.
    """
    return re.sub(r"(TokenSet\.prototype\.toString=function\(\)\{.{0,250}?\+\w+\+\w+\.id)\}", r'\1+","}', worker)


def with_whole_stop_words(worker):
    """The script of the search with stop words that do not stand for all words that begin with them.

    Material for MkDocs 9 takes each word of a query for the beginning of one, so that "a" and "in" find whatever begins so, and lunr drops
    no stop word that has a wildcard. Version 8 has no such expression, and its script stays as it is.
    """
    return re.sub(r"(\[~\^\]\\d\+\$\)/\.test\((\w+)\)\?\2:)(`\$\{\2\}\*`)",
                  r"\1lunr.stopWordFilter&&!lunr.stopWordFilter(\2.toLowerCase())?\2:\3", worker)


def build(folder):
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    copies = folder / "pages"
    for page in pages():
        to = copies / page.relative_to(ROOT)
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(for_python_markdown(page.read_text()))
        for target in links(page):
            place, _ = resolved(page, target)
            to = copies / place.relative_to(ROOT)
            if place.is_file() and place.suffix != ".md" and not to.exists():
                to.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(place, to)
    assets = copies / "site_assets"
    shutil.copytree(ROOT / "docs/site/assets", assets)
    shutil.copytree(KATEX, assets / "katex", ignore=shutil.ignore_patterns("*.mjs", "katex.js", "katex.css", "*.ttf", "*.woff"))
    shutil.copytree(ROOT / "docs/site/theme", folder / "theme")
    (folder / "mkdocs.yml").write_text(yaml.dump(configuration(), Dumper=yaml.SafeDumper, sort_keys=False,
                                                 allow_unicode=True))
    done = subprocess.run(["mkdocs", "build", "--strict", "-f", folder / "mkdocs.yml"], capture_output=True, text=True,
                          env={**os.environ, "PYTHONWARNINGS": "ignore"})
    if done.returncode:
        raise SystemExit(f"mkdocs:\n{done.stdout}{done.stderr}")
    index = with_words(json.loads((folder / "site/search/search_index.json").read_text()))
    (folder / "site/search/search_index.json").write_text(json.dumps(index, separators=(",", ":")))
    (folder / "site/search/search_index.js").write_text(
        f"var __search = {{index: Promise.resolve({json.dumps(index, separators=(',', ':'))})}};\n")
    for worker in (folder / "site").glob("assets/javascripts/workers/search.*.min.js"):
        worker.write_text(with_whole_stop_words(with_separated_states(worker.read_text())))
    return folder / "site/index.html"


if __name__ == "__main__":
    print(build(sys.argv[1]))
