#include "input/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace solidus {
namespace {

using ::testing::HasSubstr;

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Document, EveryValueKnowsItsFileLineAndColumn) {
  const Value v =
      parse_document("title = \"a\"\n[time]\n  end = \"90 s\"\n  steps = [1, 2.5, true]\n", "case.toml");
  const Value& end = *v.find("time")->find("end");
  EXPECT_EQ(end.where.text(), "case.toml:3:9");
  EXPECT_EQ(end.text(), "90 s");
  const Value& third = v.find("time")->find("steps")->items()[2];
  EXPECT_EQ(third.where.text(), "case.toml:4:20");
  EXPECT_TRUE(third.boolean());
}

TEST(Document, KeysKeepTheOrderOfTheFile) {
  const Value v = parse_document("z = 1\na = 2\nm = 3\n", "f");
  EXPECT_EQ(v.entries()[0].key, "z");
  EXPECT_EQ(v.entries()[2].key, "m");
}

TEST(Document, MalformedTextIsReportedWithItsPlace) {
  EXPECT_THAT(message([] { parse_document("a = 1\nb = = 2\n", "f.toml"); }), HasSubstr("f.toml:2:"));
  EXPECT_THAT(message([] { parse_document("a = 1\na = 2\n", "f.toml"); }), HasSubstr("f.toml:2:"));
  EXPECT_THAT(message([] { parse_document("", "f.toml"); }), HasSubstr("empty"));
  EXPECT_THAT(message([] { parse_document(std::string("a = 1\0", 6), "f.toml"); }),
              HasSubstr("not a text file"));
  EXPECT_THAT(message([] { parse_document("a = \"\xff\xfe\"", "f.toml"); }), HasSubstr("f.toml:1:"));
  EXPECT_THAT(message([] { parse_document("a = nan", "f.toml"); }), HasSubstr("not finite"));
  EXPECT_THAT(message([] { parse_document("a = 1e999", "f.toml"); }), HasSubstr("f.toml:1:"));
  EXPECT_THAT(message([] { parse_document("a = 2020-01-01", "f.toml"); }), HasSubstr("date"));
}

TEST(Document, MissingFilesAndFoldersAreToldApart) {
  EXPECT_THAT(message([] { load_document("/nowhere/case.toml"); }), HasSubstr("no such file"));
  EXPECT_THAT(message([] { load_document("/"); }), HasSubstr("folder"));
}

TEST(Document, ACommandLineValueIsTomlOrElseText) {
  EXPECT_EQ(parse_value("12", "--set").integer(), 12);
  EXPECT_EQ(parse_value("0.5 s", "--set").text(), "0.5 s");
  EXPECT_EQ(parse_value("steel", "--set").text(), "steel");
  EXPECT_EQ(parse_value("\"a b\"", "--set").text(), "a b");
  EXPECT_EQ(parse_value("[1, 2]", "--set").items().size(), 2u);
  EXPECT_EQ(parse_value("1\nb = 2", "--set").text(), "1\nb = 2");
}

TEST(Document, WrittenTomlReadsBackToTheSameTree) {
  const std::string text =
      "title = \"quote \\\" and \\\\ and \\n line\"\nx = 1.0\nsmall = 1e-09\nn = -3\nyes = true\nempty = []\n"
      "inline = { a = 1, b = [[0, \"1 K\"], [1, \"2 K\"]] }\n\n[mesh]\nshape = "
      "\"block\"\n\n[mesh.parameters]\nr = 2.5\n"
      "\n[[body]]\nname = \"part\"\n\n[body.inner]\nq = 1\n\n[[body]]\nname = \"mould\"\n";
  const std::string once = to_toml(parse_document(text, "f"));
  EXPECT_EQ(once, text);
  EXPECT_EQ(to_toml(parse_document(once, "f")), once);
}

}  // namespace
}  // namespace solidus
