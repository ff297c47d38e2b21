// Families of findings: each has a name, a place of its own and rows for the reference page.
#include "check/finding_family.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace {

using namespace solidus::check;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(FindingFamilies, ComeInTheOrderOfTheirPlacesAndHaveRows) {
  std::set<std::string_view> names;
  int last = 0;
  for (const FindingFamily& family : finding_families()) {
    EXPECT_GT(family.place, last) << family.name;
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_FALSE(family.rows.empty()) << family.name;
    last = family.place;
  }
  EXPECT_GT(names.size(), 30U);
}

TEST(FindingFamilies, HaveRowsThatSayWhatAndHowAndStandOnceOnThePage) {
  std::set<std::string> found;
  for (const FindingFamily& family : finding_families())
    for (const FindingRow& row : family.rows) {
      EXPECT_THAT(row.finding, Not(IsEmpty())) << family.name;
      EXPECT_THAT(row.as, ::testing::AnyOf(HasSubstr("warning"), HasSubstr("error"))) << row.finding;
      EXPECT_THAT(row.finding + row.when, Not(HasSubstr("|"))) << "the columns of the page";
      EXPECT_TRUE(found.insert(row.finding).second) << row.finding;
    }
}

TEST(FindingFamilies, AreRefusedWhereTheirNameOrPlaceIsTaken) {
  const FindingFamily& first = finding_families().front();
  const int place = first.place;
  EXPECT_THROW(add_findings({.name = "another", .place = place, .rows = {}}), std::logic_error);
  EXPECT_THROW(add_findings({.name = first.name, .place = 10000, .rows = {}}), std::logic_error);
}

TEST(FindingFamilies, WriteNumbersAsPeopleDo) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(0.05), "0.05");
  EXPECT_EQ(number(-8), "-8");
  EXPECT_EQ(number(1000), "1 000");
  EXPECT_EQ(number(25000), "25 000");
  EXPECT_EQ(number(1e6), "1e6");
  EXPECT_EQ(number(2e12), "2e12");
  EXPECT_EQ(number(1.2e-4), "1.2e-4");
  EXPECT_EQ(number(1e-10), "1e-10");
  EXPECT_EQ(percent(0.35), "35 %");
}

}  // namespace
