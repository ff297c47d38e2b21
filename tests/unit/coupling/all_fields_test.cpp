/// The declarations of all fields: complete, each once, and consistent with each other.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "coupling/all_fields.hpp"
#include "input/units.hpp"

namespace {

using namespace solidus;
using quantities::Group;
using quantities::Quantity;

TEST(AllFields, AreDeclaredOnceWithEverythingThatPeopleRead) {
  std::set<std::string_view> names, labels;
  for (const Quantity* field : coupling::all_fields()) {
    SCOPED_TRACE(std::string(field->name));
    EXPECT_TRUE(names.insert(field->name).second);
    EXPECT_TRUE(labels.insert(field->label).second) << field->label;
    ASSERT_FALSE(field->label.empty());
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(field->label.front())));
    ASSERT_FALSE(field->doc.empty());
    EXPECT_NE(field->doc.back(), '.');
    EXPECT_EQ(coupling::find_field(field->name), field);
  }
  EXPECT_GE(names.size(), 54U);
  EXPECT_EQ(coupling::find_field("no_such_field"), nullptr);
}

TEST(AllFields, HaveUnitsThatTheProgramKnows) {
  for (const Quantity* field : coupling::all_fields()) {
    SCOPED_TRACE(std::string(field->name));
    const std::string si(field->unit);
    EXPECT_TRUE(units::compatible(si, si));
    const quantities::ShownUnit shown = field->shown();
    EXPECT_NE(shown.factor, 0.0);
    if (!field->root_unit.empty()) continue;  // UDUNITS knows no roots
    ASSERT_TRUE(units::compatible(std::string(shown.unit), si)) << shown.unit;
    EXPECT_NEAR(units::to_display(1, si, std::string(shown.unit)), shown.factor + shown.offset, 1e-9);
  }
}

TEST(AllFields, SayWhatTheyNeedAsTheirPlaceAndGroupDo) {
  for (const Quantity* field : coupling::all_fields()) {
    SCOPED_TRACE(std::string(field->name));
    EXPECT_EQ(field->of_contact(), field->group == Group::contact);
    if (field->needs.inertia || field->needs.plasticity || field->needs.friction) {
      EXPECT_TRUE(field->needs.mechanics);
    }
    if (!field->headline.empty() || !field->answer.empty()) {
      EXPECT_NE(field->worst, quantities::Extreme::none);
    }
    if (field->compared) EXPECT_NE(field->rank, quantities::Rank::tensor);
  }
}

TEST(AllFields, OfContactAreLeftOutOfWhatACaseCanChooseToWrite) {
  const std::vector<std::string> all = coupling::field_names(true), chosen = coupling::field_names(false);
  EXPECT_EQ(all.size(), coupling::all_fields().size());
  for (const std::string& name : chosen) EXPECT_FALSE(coupling::field_of(name).of_contact()) << name;
}

}  // namespace
