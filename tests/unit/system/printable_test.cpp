#include <gtest/gtest.h>

#include "system/input_file.hpp"

namespace solidus {
namespace {

TEST(Printable, KeepsTextsOfAnyLanguage) {
  for (const char* text : {"", "plain\n\ttext", "Größe 5 µm, 20 °C", "鋳物", "\xf0\x9f\x98\x80"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ShowsControlCharactersAsQuestionMarks) {
  EXPECT_EQ(printable("a\x1b[31mb\x7f"), "a?[31mb?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "??31m");  // the same in one character of the second set
}

TEST(Printable, ShowsBytesThatAreNoUtf8AsQuestionMarks) {
  EXPECT_EQ(printable("a\xff"
                      "b"),
            "a?b");
  EXPECT_EQ(printable("Gr\xf6\xdf"
                      "e"),
            "Gr??e");                      // Latin-1
  EXPECT_EQ(printable("\xe4\xb8"), "??");  // ends within a character
  EXPECT_EQ(printable("\xc2\x1b"), "??");  // a character that a control character breaks off
  EXPECT_EQ(printable("\xc0\x9b"), "??");  // two bytes for what one holds
}

}  // namespace
}  // namespace solidus
