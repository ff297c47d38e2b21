"""Imports of the sources run one way: between rooms, between headers, and between a room and its folders of laws and schemes."""

import ast
import pathlib
import re
import unittest

SOURCES = pathlib.Path(__file__).resolve().parents[2] / "src"
PACKAGES = SOURCES.parent / "python"
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
DECLARED_IN_ADVANCE = re.compile(r"^(template <[^>]*>\s*)?(class|struct|enum class) \w+( : \w+)?;", re.MULTILINE)
# What all rooms are built on has no namespace of its own but `solidus` (decision 0076).
BASE = ("numbers", "system", "input")
# Wrappers of a library within a room, in a namespace that has the library's name.
WRAPPERS = {"parallel": "petsc"}


def imports():
    """Of every header and source of src/ the files of src/ that it includes, as paths in it."""
    graph = {}
    for file in sorted(SOURCES.rglob("*.[ch]pp")):
        included = INCLUDE.findall(file.read_text(encoding="utf-8"))
        graph[file.relative_to(SOURCES).as_posix()] = [name for name in included if (SOURCES / name).exists()]
    return graph


def foreign_namespaces(file, text):
    """The namespaces that a file of src/ opens and that are not those of its room. What another room declares may be declared in advance in
    the namespace of that room."""
    room = file.split("/")[0]
    own = [f"solidus::{name}" for name in (room, WRAPPERS.get(room)) if name]
    found = []
    for opened in re.finditer(r"^namespace (solidus[\w:]*) \{[^\n]*\n", text, re.MULTILINE):
        name = opened.group(1)
        if room in BASE:
            is_own = not (SOURCES / name.partition("::")[2].partition("::")[0]).is_dir() or name == "solidus"
        else:
            is_own = any(name == prefix or name.startswith(prefix + "::") for prefix in own)
        body = text[opened.end():text.index("\n}", opened.end() - 1)]
        if not is_own and DECLARED_IN_ADVANCE.sub("", re.sub(r"//[^\n]*", "", body)).strip():
            found.append(name)
    return found


def python_imports(package):
    """Of every module of a package, but its __init__ and __main__, which put it together, the modules of it that it imports: within
    functions and for types alone too."""
    graph = {}
    for file in sorted(package.rglob("*.py")):
        name = file.relative_to(package).with_suffix("").as_posix()
        if file.name in ("__init__.py", "__main__.py"):
            continue
        graph[name] = []
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level:
                folder = file.parents[node.level - 1] / (node.module or "").replace(".", "/")
                named = [folder / one.name for one in node.names] + [folder]
                graph[name] += [one.relative_to(package).as_posix() for one in named if one.with_suffix(".py").is_file()]
    return graph


def is_interface(file):
    """A header, but for those that hold the bodies of templates (X_impl.hpp), which are to their header what a source is."""
    return file.endswith(".hpp") and not file.endswith("_impl.hpp")


def merged(graph, name):
    """The graph of what `name` calls the files, without imports of a group by itself."""
    groups = {}
    for file, included in graph.items():
        groups.setdefault(name(file), set()).update(name(other) for other in included if name(other) != name(file))
    return groups


def circle(graph):
    """The names along one circle of a graph, the first one again at the end; empty where there is none."""
    done, way = set(), []

    def visit(node):
        if node in way:
            return way[way.index(node):] + [node]
        if node in done:
            return []
        way.append(node)
        for other in sorted(graph.get(node, ())):
            if found := visit(other):
                return found
        way.pop()
        done.add(node)
        return []

    for start in graph:
        if found := visit(start):
            return found
    return []


class Imports(unittest.TestCase):
    def test_modules_of_a_python_package_import_one_way(self):
        for package in sorted(PACKAGES.glob("solidus_*/__init__.py")):
            self.assertEqual(circle(python_imports(package.parent)), [], package.parent.name)

    def test_a_case_from_python_knows_nothing_of_results(self):
        graph = python_imports(PACKAGES / "solidus_casting")
        below, todo = set(), ["case"]
        while todo:
            module = todo.pop()
            below.add(module)
            todo += [other for other in graph[module] if other not in below]
        self.assertEqual(below & {"results", "moment", "child", "simulation"}, set())

    def test_a_circle_is_found_and_named(self):
        self.assertEqual(circle({"a": ["b"], "b": ["c"], "c": ["b"]}), ["b", "c", "b"])
        self.assertEqual(circle({"a": ["b", "c"], "b": ["c"], "c": []}), [])

    def test_rooms_import_one_way(self):
        self.assertEqual(circle(merged(imports(), lambda file: file.split("/")[0])), [])

    def test_inner_folders_import_one_way(self):
        """Within a room too: a folder of it is one place, and so is what is in the room itself. What is plugged in (laws, schemes)
        is included by the registries next to it."""
        plugged_in = ("laws", "schemes")
        for room in sorted({file.split("/")[0] for file in imports()}):
            within = {file: [other for other in included if other.startswith(room + "/") and other.split("/")[1] not in plugged_in]
                      for file, included in imports().items() if file.startswith(room + "/") and file.split("/")[1] not in plugged_in}
            folders = merged(within, lambda file: file.split("/")[1] if file.count("/") > 1 else ".")
            self.assertEqual(circle(folders), [], room)

    def test_a_foreign_namespace_is_found(self):
        self.assertEqual(foreign_namespaces("heat/a.hpp", "namespace solidus::mesh {\nclass Mesh;\n}\n\nnamespace solidus::heat {\nint a;\n}\n"), [])
        self.assertEqual(foreign_namespaces("heat/a.hpp", "namespace solidus::mesh {\nint a;\n}\n"), ["solidus::mesh"])
        self.assertEqual(foreign_namespaces("cases/a.hpp", "namespace solidus {\nstruct A {\n};\n}\n"), ["solidus"])
        self.assertEqual(foreign_namespaces("system/a.hpp", "namespace solidus::logging {\nint a;\n}\n"), [])

    def test_a_namespace_is_that_of_the_folder(self):
        """A room is a folder of src/ and a namespace of the same name, whatever inner folders it has."""
        for file in imports():
            self.assertEqual(foreign_namespaces(file, (SOURCES / file).read_text(encoding="utf-8")), [], file)

    def test_headers_import_one_way(self):
        graph = imports()
        headers = {file: list(filter(is_interface, graph[file])) for file in filter(is_interface, graph)}
        self.assertGreater(len(headers), 300)
        self.assertEqual(circle(headers), [])

    def test_headers_know_no_law_of_contact_and_no_scheme_by_name(self):
        """Laws and schemes are plugged in: their registry, a source, is the one place that includes them. Laws include one another."""
        for file, included in imports().items():
            for room, folder in (("contact", "laws"), ("coupling", "schemes")):
                if is_interface(file) and not file.startswith(f"{room}/{folder}/"):
                    named = [name for name in included if name.startswith(f"{room}/{folder}/")]
                    self.assertEqual(named, [], file)

    def test_no_text_outside_of_their_room_names_a_scheme(self):
        """Advice takes the names from the schemes (names_of_schemes), a default from default_scheme()."""
        schemes = {name for file in SOURCES.glob("coupling/schemes/*.hpp")
                   for name in re.findall(r'string_view name = "(\w+)"', file.read_text(encoding="utf-8"))}
        self.assertGreaterEqual(len(schemes), 5)
        quoted = re.compile(r'\\?"(' + "|".join(sorted(schemes)) + r')\\?"')
        for file in sorted(SOURCES.rglob("*.[ch]pp")):
            if file.relative_to(SOURCES).parts[0] == "coupling":
                continue
            code = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.lstrip().startswith("//")]
            self.assertEqual([line for line in code if quoted.search(line)], [], file)

    def test_a_law_of_a_material_is_compiled_with_few_sources(self):
        """A law that changes compiles its registry again, one that is called directly the return mapping too, and never a kernel."""
        graph = imports()
        reached = {}
        for file in graph:
            seen, next_ones = set(), [file]
            while next_ones:
                seen.add(name := next_ones.pop())
                next_ones += [other for other in graph[name] if other not in seen]
            reached[file] = seen
        laws = [file for file in graph if file.startswith("material/laws/") and not file.endswith(("_law.hpp", "law_list.hpp", "parameter.hpp"))]
        self.assertGreater(len(laws), 12)
        for law in laws:
            sources = [file for file, seen in reached.items() if law in seen and file.endswith(".cpp")]
            self.assertLessEqual(len(sources), 10, f"{law}: {sources}")
            kernels = [file for file, seen in reached.items() if law in seen and file.startswith("mechanics/") and is_interface(file)]
            self.assertEqual(kernels, [], law)
        for law in ("voce", "swift", "measured_hardening"):
            sources = [file for file, seen in reached.items() if f"material/laws/{law}.hpp" in seen and file.endswith(".cpp")]
            self.assertEqual(sources, ["material/laws/hardening_laws.cpp"])

    def test_mpi_and_petsc_are_seen_by_few_files_and_by_no_header_outside_their_rooms(self):
        library = re.compile(r"^#include <(petsc[^>]*|mpi\.h)>", re.MULTILINE)
        graph = imports()
        seen = {file for file in graph if library.search((SOURCES / file).read_text(encoding="utf-8"))}
        reached = set(seen)
        while more := {file for file, included in graph.items() if file not in reached and reached & set(included)}:
            reached |= more
        self.assertGreater(len(seen), 10)
        self.assertLessEqual(len(reached), 60)
        headers = sorted(file for file in reached if is_interface(file))
        self.assertEqual(headers, ["linear/linear_solver_implementation.hpp", "parallel/petsc_vectors.hpp"])


if __name__ == "__main__":
    unittest.main()
