"""Sources that are compiled as one file (cmake/batches.py) must mean what they mean alone."""

import contextlib
import io
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "cmake"))
import batches  # noqa: E402


def unnamed(text):
    return f'#include <gtest/gtest.h>\n#include "body.hpp"\nnamespace solidus {{\nnamespace {{\n{text}\n}}\n}}\n'


class Batches(unittest.TestCase):
    def grouped(self, *texts, files=8, lines=1000):
        """For each batch its sources by number, and what is renamed in them."""
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, f"{i}.cpp") for i in range(len(texts))]
            for path, text in zip(paths, texts):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            found = batches.batches(list(map(batches.Source, paths)), files, lines)
            self.files = [batches.text_of(batch) for batch in found]
            return [[(paths.index(source.path), names) for source, names in batch] for batch in found]

    def test_sources_that_share_no_name_share_a_file_up_to_its_limits(self):
        one, two = unnamed("int one() { return 1; }"), unnamed("int two() { return 2; }")
        self.assertEqual(self.grouped(one, two), [[(0, set()), (1, set())]])
        self.assertEqual(len(self.grouped(one, two, files=1)), 2)
        self.assertEqual(len(self.grouped(one, two, lines=10)), 2)

    def test_a_name_that_two_declare_gets_a_suffix_in_both(self):
        found = self.grouped(unnamed("constexpr double k_a = 1, k_end = 2;\nstruct Row { double x; };"),
                             unnamed("constexpr double k_end = 3;\ndouble row() { return k_end; }"))
        self.assertEqual(found, [[(0, {"k_end"}), (1, {"k_end"})]])
        self.assertIn("#define k_end k_end_2\n", self.files[0])
        self.assertLess(self.files[0].index('#include "body.hpp"'), self.files[0].index("#define"))

    def test_a_function_that_another_calls_from_a_header_is_renamed_where_it_is_declared(self):
        found = self.grouped(unnamed("double norm(double x) { return x; }\ndouble f() { return norm(1); }"),
                             unnamed("double g() { return norm(2.5f); }"))
        self.assertEqual(found, [[(0, {"norm"}), (1, set())]])

    def test_names_of_members_and_tests_stay_and_part_the_sources(self):
        member = unnamed("double time() { return 0; }\ndouble f(const Row& r) { return r.time + time(); }")
        self.assertEqual(len(self.grouped(member, unnamed("double g() { return time(); }"))), 2)
        suite = unnamed("struct Tube {};\nTEST(Tube, Bends) {}")
        self.assertEqual(len(self.grouped(suite, unnamed("struct Tube {};\nTEST_F(Tube, Breaks) {}"))), 2)

    def test_the_same_using_is_shared_and_another_one_parts_the_sources(self):
        one, other = unnamed("using test::Body;"), unnamed("using other::Body;")
        self.assertEqual(len(self.grouped(one, one)), 1)
        self.assertEqual(len(self.grouped(one, other)), 2)

    def test_sources_with_macros_or_conditions_stay_alone(self):
        self.assertEqual(len(self.grouped("#define SIZE 3\n", unnamed("int n = 0;"))), 2)
        self.assertEqual(len(self.grouped("#if 0\n#endif\n", unnamed("int n = 0;"))), 2)
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(len(self.grouped("int f() {}\n}\n", unnamed("int n = 0;"))), 2)
        self.assertIn("braces are not understood", said.getvalue())

    def test_headers_that_declare_the_same_name_part_the_sources(self):
        with tempfile.TemporaryDirectory() as folder:
            def source(name, text):
                path = os.path.join(folder, name)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                return path
            source("metal.hpp", "namespace solidus::test {\ninline int metal(double x) { return 1; }\n}\n")
            source("blocks.hpp", "namespace solidus::test {\ninline int metal(bool alone) { return 2; }\n}\n")
            use = unnamed("int n = test::metal(1.0);").replace("body.hpp", "metal.hpp")
            one = batches.Source(source("one.cpp", use))
            other = batches.Source(source("other.cpp", '#include "blocks.hpp"\n'))
            both = batches.Source(source("both.cpp", '#include "metal.hpp"\n#include "blocks.hpp"\n'))
            self.assertIsNone(batches.agreement(one, other))
            self.assertIsNone(batches.agreement(other, one))
            self.assertIsNone(batches.agreement(one, both))
            self.assertEqual(batches.agreement(both, both), (set(), set()))

    def test_a_namespace_that_hides_another_parts_the_sources(self):
        hides = "namespace solidus::testing {\nint run();\n}\n"
        self.assertEqual(len(self.grouped(hides, unnamed("class Any : public testing::Test {};"))), 2)
        self.assertEqual(len(self.grouped(hides, unnamed("class Any : public ::testing::Test {};"))), 1)

    def test_comments_texts_and_bodies_declare_nothing(self):
        text = unnamed('/* int a; */ const char* k = R"(int b;)"; // int c;\nint f() { int d = \'{\'; return d; }\n'
                       "struct S { S() : x{1} { y = 2; } int x, y; };")
        with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
            file.write(text)
            file.flush()
            self.assertEqual(set(batches.Source(file.name).own), {"k", "f", "S"})


if __name__ == "__main__":
    unittest.main()
