"""Groups C++ sources into files that are compiled as one: batches.py STEM FILES LINES SOURCE...

Writes STEM_1.cpp, STEM_2.cpp, ... of at most FILES sources and LINES lines each, which include them, and prints their
paths and those of the sources that stay alone.

Sources that are included into one file share its scope. What one of them declares for itself (in an unnamed
namespace, `static` or by `using`) must therefore not be a name that another one uses (of a function: calls), unless both
mean the same by the same `using`. Where it is one, a source goes into another batch, or its name gets a suffix in the
batch: all headers are included in front, so that the macro that does it sees the source alone. Nor do sources share a
batch where headers next to them declare the same name twice: of two overloads neither sees the other alone.
"""
import collections
import os
import re
import sys

COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<end>[^(\s]*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.DOTALL)
INCLUDE = re.compile(r'^#include ([<"][^>"]*[>"])', re.MULTILINE)
DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(\w+)(?:\\\n|[^\n])*", re.MULTILINE)
TOKEN = re.compile(r"::|->|\w+|\S")
NOT_A_NAME = set("alignas auto const constexpr consteval constinit decltype explicit extern final friend if inline "
                 "mutable noexcept operator override requires return sizeof static static_assert template "
                 "thread_local typedef typename using void volatile bool char short int long float double signed "
                 "unsigned struct class enum union concept namespace public private protected".split())
TESTS = ("TEST", "TEST_F", "TEST_P", "TYPED_TEST", "INSTANTIATE_TEST_SUITE_P")
LIBRARIES = {"testing", "std", "fmt", "Eigen"}  # whose names a namespace of the project may hide
FOUND_BY_ARGUMENT = {"PrintTo", "begin", "end", "swap"}  # headers find these by their name


def is_name(token):
    return token.isidentifier() and token not in NOT_A_NAME


def declared(tokens):
    """The name that a declaration declares; `tokens` are those in front of its body, initialiser or end."""
    if tokens[0] in TESTS:
        return "_".join([t for t in tokens if is_name(t)][1:3] + ["Test"])
    while tokens[:1] == ["template"]:  # template <...>
        depth, end = 0, 1
        for end in range(1, len(tokens)):
            depth += {"<": 1, ">": -1}.get(tokens[end], 0)
            if depth == 0:
                break
        tokens = tokens[end + 1:]
    if "(" in tokens:
        tokens = tokens[:tokens.index("(")]
    elif any(t in ("struct", "class", "enum", "union", "concept") for t in tokens):
        return next((t for t in tokens if is_name(t)), None)
    depth, name = 0, None
    for token in tokens:
        depth += {"<": 1, "[": 1, ">": -1, "]": -1}.get(token, 0)
        if depth == 0 and is_name(token):
            name = token
    return name


class Source:
    """Names of a source.

    own:        what it declares for itself: name -> the declaration where that says all (`using`), else None
    functions:  the functions among them
    used:       names that it uses without saying whose they are
    called:     those that a parenthesis or a template's arguments follow
    fixed:      names that must stay as they are: those of members, of other namespaces and of tests
    opened:     namespaces besides the project's that it opens to all of the file (`using namespace`)
    spaces:     namespaces called as a library's that it and headers next to it are in
    """

    def __init__(self, path):
        self.path = path
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.lines = text.count("\n")
        self.includes = INCLUDE.findall(text)
        self.own, self.functions, self.opened, self.spaces = {}, set(), set(), set()
        self.fixed = set(FOUND_BY_ARGUMENT)
        text = COMMENT_OR_TEXT.sub(lambda match: " " if match[0][0] == "/" else '""', text)
        self.plain = set(DIRECTIVE.findall(text)) <= {"include"}
        tokens = TOKEN.findall(DIRECTIVE.sub("", text))
        self.used, self.called = set(), set()
        for before, token, after in zip([""] + tokens, tokens, tokens[1:] + [""]):
            if before in (".", "->", "::"):
                self.fixed.add(token)
            elif is_name(token):
                self.used.add(token)
                if after in ("(", "<"):
                    self.called.add(token)
        try:
            self.read(tokens)
        except ValueError as error:
            print(error, file=sys.stderr)
            self.plain = False  # it stays alone
        self.mentioned = self.used | self.fixed
        self.headers = {}  # names that headers next to the source declare -> those headers
        self.follow(path, set())

    def follow(self, path, seen):
        includes = self.includes if path == self.path else Header.of(path).includes
        for header in includes:
            beside = os.path.normpath(os.path.join(os.path.dirname(path), header[1:-1]))
            if header[0] == '"' and beside not in seen and os.path.exists(beside):
                seen.add(beside)
                self.mentioned |= Header.of(beside).mentioned
                self.spaces |= Header.of(beside).spaces
                for name in Header.of(beside).own:
                    self.headers.setdefault(name, set()).add(beside)
                self.follow(beside, seen)

    def read(self, tokens):
        scopes, start, depth, i = [], 0, 0, 0  # scopes: whether a namespace has no name
        while i < len(tokens):
            token, words = tokens[i], tokens[start:i]
            depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(token, 0)
            if depth == 0 and token == "{" and "namespace" in words[:2]:
                scopes.append(words[-1] == "namespace")
                self.spaces.update(LIBRARIES.intersection(words))
                start = i + 1
            elif depth == 0 and token == "}" and not words:
                if not scopes:
                    raise ValueError(f"{self.path}: its braces are not understood")
                scopes.pop()
                start = i + 1
            elif depth == 0 and token in "{;=" and words:
                self.declare(words, tokens, i, any(scopes))
                i = self.end(tokens, i, any(scopes) or "static" in words)
                start = i + 1
            elif token == ";":
                start = i + 1
            i += 1

    def declare(self, words, tokens, i, unnamed):
        if words[:2] == ["using", "namespace"]:
            if words[2:3] != ["solidus"]:  # those of the project are in reach of its sources anyway
                self.opened.add("".join(words[2:]))
        elif words[0] in ("using", "namespace") and tokens[i] == "=":
            self.own[words[1]] = "".join(tokens[i - len(words):tokens.index(";", i)])
        elif words[0] == "using":
            for other in "".join(words[1:]).split(","):
                self.own[other.split("::")[-1]] = other.removeprefix("::")
        else:
            if words[0] in TESTS:
                self.fixed.update(words)
            name = declared(words)
            if name and (unnamed or "static" in words or words[0] in TESTS):
                self.own[name] = None
                if "(" in words and words[0] not in TESTS:
                    self.functions.add(name)

    def end(self, tokens, i, own):
        """Index of the last token of a declaration, which may declare other variables behind commas."""
        level, body = 0, tokens[i] == "{"
        while i < len(tokens) - 1:
            level += {"{": 1, "(": 1, "}": -1, ")": -1}.get(tokens[i], 0)
            if level == 0 and tokens[i] == ";":
                return i
            if level == 0 and tokens[i] == "}" and body and tokens[i + 1] not in (",", ";", "{"):
                return i
            if level == 0 and tokens[i] == "," and own and is_name(tokens[i + 1]) and tokens[i + 2] in "={,;":
                self.own[tokens[i + 1]] = None
            i += 1
        return i

    def disturbs(self, other):
        """Names that this source declares for itself and that mean something else in the other one."""
        for name, meaning in self.own.items():
            if name in other.own:
                if meaning is None or meaning != other.own[name]:
                    yield name
            elif name in (other.called if name in self.functions else other.used):
                yield name

    def can_rename(self, name):
        return name in self.own and name not in self.fixed

    def sees_more(self, other):
        """Whether the other one brings a namespace by whose name this one means a library's (solidus::testing), or its
        headers declare a name again that this one has from its own."""
        return bool((other.spaces - self.spaces) & self.used) or any(
            name in self.mentioned and not other.headers.get(name, found) <= found
            for name, found in self.headers.items())


class Header(Source):
    """What a header declares, in whatever namespace."""
    known = {}

    @classmethod
    def of(cls, path):
        if path not in cls.known:
            cls.known[path] = cls(path)
        return cls.known[path]

    def follow(self, path, seen):
        pass

    def declare(self, words, tokens, i, unnamed):
        super().declare(words, tokens, i, words[0] not in ("using", "namespace"))


def agreement(a, b):
    """Names to be changed for two sources to share a file: those in a, those in b; None where they cannot."""
    if a.opened != b.opened or a.sees_more(b) or b.sees_more(a):
        return None
    in_a, in_b = set(), set()
    for source, other, names, others in ((a, b, in_a, in_b), (b, a, in_b, in_a)):
        for name in source.disturbs(other):
            if source.can_rename(name):
                names.add(name)
            elif other.can_rename(name):
                others.add(name)
            else:
                return None
    return in_a, in_b


def batches(sources, most_files, most_lines):
    """Lists of pairs of a source and the names to be changed in it.

    A source goes to those that share a library with it which few use, then to where no name need be changed, then to
    those that share most headers with it.
    """
    users = collections.Counter(header for source in sources for header in source.includes)
    rare = {header for header, n in users.items() if header[0] == "<" and "/" in header and n <= most_files}
    result = []
    for source in sources:
        best, best_rank, changes = None, None, None
        for batch in result:
            if (len(batch) >= most_files or not source.plain or not batch[0][0].plain
                    or sum(s.lines for s, _ in batch) + source.lines > most_lines):
                continue
            agreements = [agreement(source, other) for other, _ in batch]
            if None in agreements:
                continue
            shared = set(source.includes) & {header for other, _ in batch for header in other.includes}
            rank = (bool(shared & rare),
                    not any(mine or its for mine, its in agreements), len(shared))
            if best is None or rank > best_rank:
                best, best_rank, changes = batch, rank, agreements
        if best is None:
            result.append([(source, set())])
            continue
        for (_, names), (_, its) in zip(best, changes):
            names |= its
        best.append((source, set().union(*[mine for mine, _ in changes])))
    return result


def text_of(batch):
    """A file that includes the sources of a batch."""
    lines = ["// Made by cmake/batches.py."]
    if any(names for _, names in batch):
        for source, _ in batch:
            for header in source.includes:
                beside = os.path.join(os.path.dirname(source.path), header[1:-1])
                lines.append(f'#include "{beside}"' if header[0] == '"' and os.path.exists(beside)
                             else f"#include {header}")
    for number, (source, names) in enumerate(batch, 1):
        lines += [f"#define {name} {name}_{number}" for name in sorted(names)]
        lines.append(f'#include "{source.path}"')
        lines += [f"#undef {name}" for name in sorted(names)]
    return "\n".join(lines) + "\n"


def main(stem, most_files, most_lines, *paths):
    number = 0
    for batch in batches([Source(path) for path in paths], int(most_files), int(most_lines)):
        if len(batch) == 1:
            print(batch[0][0].path)
            continue
        number += 1
        path, text = f"{stem}_{number}.cpp", text_of(batch)
        if not os.path.exists(path) or open(path, encoding="utf-8").read() != text:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        print(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
