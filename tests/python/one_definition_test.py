"""Each class has a name of its own in its namespace. Two of one name are taken for one by the linker, with the members of either."""

import re
from pathlib import Path
import unittest

ROOT = Path(__file__).resolve().parents[2]
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
WORD = re.compile(r"namespace\s*([\w:]*)\s*\{|\b(?:struct|class)\s+(?:\[\[[^\]]*\]\]\s*)?(\w+)(?:\s+final)?\s*(?::(?!:)[^;{}()]*)?\{|\{|\}")


def definitions(text):
    """Full names of the classes that a text defines in named namespaces, nested ones left out."""
    blocks = []  # names of namespaces; None for any other block
    for word in WORD.finditer(COMMENT.sub("", text)):
        if word[0] == "}":
            if blocks:
                blocks.pop()
        elif word[0].startswith("namespace"):
            blocks.append(word[1])
        else:
            if word[2] and all(blocks):
                yield "::".join([*blocks, word[2]])
            blocks.append(None)


class Names(unittest.TestCase):
    def test_no_class_of_a_namespace_is_defined_in_two_files(self):
        places = {}
        for file in sorted((ROOT / "src").rglob("*.[ch]pp")):
            for name in set(definitions(file.read_text(encoding="utf-8"))):
                places.setdefault(name, []).append(file.relative_to(ROOT).as_posix())
        self.assertGreater(len(places), 500)
        self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})

    def test_what_counts_as_one(self):
        text = "namespace a { namespace { struct C {}; } struct C : B { struct D {}; }; struct C::E {}; struct F; class G final {}; }"
        self.assertEqual(list(definitions(text)), ["a::C", "a::G"])


if __name__ == "__main__":
    unittest.main()
