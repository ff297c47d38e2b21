#include "input/column_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "input/json.hpp"

namespace solidus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string failure(const std::string& text) {
  try {
    parse_column_table(text, "t");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ColumnTable, ReadsWhatProgramsSeparateInTheirWays) {
  for (const char* text :
       {"T [C],f\n1,0.5\n2,0.25\n", "T [C];f\n1;0,5\n2;0,25\n", "T [C]\tf\n1\t0.5\n2\t0.25\n",
        "\"T [C]\" f\n 1   0.5\n 2.0 +2.5e-1\n", "A title\nof two lines\n# x\nT [C],f\n1,0.5\n2,0.25\n",
        R"({"T [C]": [1, 2], "f": [0.5, 0.25], "who": "me"})",
        R"([{"T [C]": 1, "f": 0.5}, {"T [C]": 2, "f": 0.25}])"}) {
    const ColumnTable table = parse_column_table(text, "t");
    ASSERT_EQ(table.columns.size(), 2u) << text;
    EXPECT_EQ(table.columns[0].name, "T") << text;
    EXPECT_EQ(table.columns[0].unit, "C") << text;
    EXPECT_THAT(table.columns[0].values, ElementsAre(1, 2)) << text;
    EXPECT_THAT(table.columns[1].values, ElementsAre(0.5, 0.25)) << text;
  }
}

TEST(ColumnTable, TakesNamesWithBlanksApartByTwoOfThem) {
  const ColumnTable table = parse_column_table("T (C)   fraction solid (wt%)\n1 0.5\n2   0.25\n", "t");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[1].name, "fraction solid");
  EXPECT_EQ(table.columns[1].unit, "wt%");
  EXPECT_THAT(table.columns[1].values, ElementsAre(0.5, 0.25));
}

TEST(ColumnTable, KnowsTheLineOfEveryValue) {
  EXPECT_THAT(parse_column_table("x\n# c\nT,f\n\n1,2\n3,4\n", "t").columns[1].lines, ElementsAre(5, 6));
  EXPECT_THAT(parse_column_table("{\"T\": [1,\n2], \"f\": [3,\n\n4]}", "t").columns[1].lines,
              ElementsAre(2, 4));
}

TEST(ColumnTable, AnEmptyCellIsNoNumber) {
  EXPECT_TRUE(std::isnan(parse_column_table("T,f\n1,2\n2,\n", "t").columns[1].values[1]));
  EXPECT_TRUE(std::isnan(parse_column_table("T,f\n1,2\n2,n/a\n", "t").columns[1].values[1]));
}

TEST(ColumnTable, RefusesWhatIsNoTable) {
  EXPECT_THAT(failure(""), HasSubstr("empty"));
  EXPECT_THAT(failure("one\ntwo\n"), HasSubstr("t:1: there is no table"));
  EXPECT_THAT(failure("T,f\n1,2\n1,2,3\n"), HasSubstr("t:3: the line has 3 cells"));
  EXPECT_THAT(failure("{}"), HasSubstr("no columns of numbers"));
  EXPECT_THAT(failure("[{\"a\": 1}, 3]"), HasSubstr("in a list of rows"));
  EXPECT_THAT(failure("[{\"a\": 1}, {\"b\": 1}]"), HasSubstr("the row has no 'a'"));
}

TEST(Json, ReadsWhatTheStandardAllows) {
  const Value v =
      parse_json("\xEF\xBB\xBF {\"a\": [1, -2.5e3, true, null, \"x\\n\\u00e4\\\"\"],\n \"b\": {}}", "t");
  const auto& a = v.find("a")->items();
  EXPECT_EQ(a[1].number(), -2500);
  EXPECT_TRUE(a[2].boolean());
  EXPECT_TRUE(std::isnan(a[3].number()));
  EXPECT_EQ(a[4].text(), "x\n\xC3\xA4\"");
  EXPECT_EQ(v.find("b")->where.line, 2);
  EXPECT_TRUE(v.find("b")->is_table());
}

TEST(Json, RefusesEverythingElseWithItsPlace) {
  for (const char* text : {"", "{", "[1,", "[1 2]", "{\"a\" 1}", "{a: 1}", "[01x]", "[+1]", "\"a", "[1] 2",
                           "{\"a\":1,\"a\":2}", "[\"\\q\"]", "[\"\n\"]", "nul", "[--1]", "[\"\\u12\"]"})
    EXPECT_THROW(parse_json(text, "t"), InputError) << text;
  EXPECT_THROW(parse_json(std::string(1000, '['), "t"), InputError);
  try {
    parse_json("{\n  \"a\": ]\n}", "t");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, 2);
    EXPECT_EQ(error.where().column, 8);
  }
}

}  // namespace
}  // namespace solidus
