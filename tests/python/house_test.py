"""The figures of the sources: what the scanner counts, and that it reads all of them."""

import unittest

from solidus_docs import house, links

TEXT = '''
namespace solidus {
// class NotThis { void f(); };
class Small final : public Base {
 public:
  explicit Small(int a) : a_(a) { use("{"); }
  int twice() const { return 2 * a_; }
  void set(int a);

 private:
  void hidden();
  int a_, b_ = 0;
  std::map<int, int> both_{};
};
struct Data {
  double x = 0;
  double y = 0;
};
template <class T>
int count(const T& list) {
  if (list.empty()) {
    return 0;
  }
  const auto f = [&](int i) { return i; };
  return f(1);
}
}  // namespace solidus
'''


class House(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = house.house(links.ROOT)

    def test_counts_methods_members_and_lines(self):
        functions, classes = house.scan(TEXT, "text.hpp")
        self.assertEqual([(c.name, c.methods, c.members) for c in classes], [("Data", 0, 2), ("Small", 3, 3)][::-1])
        self.assertEqual({f.name: f.lines for f in functions}, {"Small": 1, "twice": 1, "count": 7})

    def test_comments_above_the_head_and_in_the_body_are_a_functions(self):
        text = "// Of the file.\n\n// Adds.\n// Twice.\nint\nadd(int a) {\n  // First.\n  return a;  // not alone\n}\nint other() {\n  return 1;\n}\n"
        functions, _ = house.scan(text, "text.cpp")
        self.assertEqual({f.name: house.comments_of(f, text.splitlines()) for f in functions}, {"add": 3, "other": 0})

    def test_functions_of_thirty_lines_tell_their_steps(self):
        found = self.found
        self.assertEqual([f"{f.file}:{f.line} {f.name}" for f in house.untold(found)], [])
        self.assertGreaterEqual(house.share_of_comments(found), 0.08)

    def test_an_enumeration_is_no_class(self):
        self.assertEqual(house.scan("enum class Colour { red, green };\n", "text.hpp")[1], [])

    def test_classes_that_are_large_for_a_reason_are_there_and_large(self):
        large = {house.placed(c) for c in self.found.classes if c.large}
        self.assertEqual(sorted(set(house.reasons()) - large), [])

    def test_reads_all_rooms(self):
        found = self.found
        self.assertEqual({folder.split("/")[0] for folder in found.rooms}, {path.name for path in (links.ROOT / "src").iterdir() if path.is_dir()})
        text = house.text_of(found)
        self.assertIn("functions, the median has", text)
        self.assertIn("classes,", text)


if __name__ == "__main__":
    unittest.main()
