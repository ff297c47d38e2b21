// The layout of a history: what is written at a point is read again, and nothing else changes.
#include "mechanics/elements/history_layout.hpp"

#include <gtest/gtest.h>

#include "material/viscoplastic.hpp"
#include "plastic_material.hpp"

namespace solidus::test {
namespace {

using Layout = mechanics::HistoryLayout<material::Viscoplastic>;

struct HistoryLayoutTest : testing::Test {
  material::Material metal = plastic_material(material::KinematicHardening::linear);
  material::Viscoplastic law{metal};
  Layout layout{law, 2};

  mechanics::BlockHistory history(std::size_t points) const {
    mechanics::BlockHistory made{static_cast<int>(layout.lanes()), static_cast<int>(points), {}};
    for (std::size_t i = 0; i < points * layout.lanes(); ++i)
      made.values.push_back(Lane(100.0 + static_cast<double>(i)));
    return made;
  }
  /// A state with different numbers in all that the material can change.
  Layout::State state(double first) const {
    auto made = history(1);
    for (std::size_t i = 0; i < layout.lanes(); ++i) made.values[i] = Lane(first + static_cast<double>(i));
    return layout.state(made, 0);
  }
};

TEST_F(HistoryLayoutTest, AStateIsReadAsItWasWrittenAndItsNeighboursStay) {
  layout.add_base();
  const mechanics::BlockHistory before = history(3);
  mechanics::BlockHistory after = before;
  layout.write(state(7.0), after, 1);
  EXPECT_EQ(layout.state(after, 1).hardening[0], state(7.0).hardening[0]);
  EXPECT_EQ(layout.state(after, 1).plastic_strain[5][3], state(7.0).plastic_strain[5][3]);
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    const bool of_law = i >= layout.lanes() && i < layout.extra(1) - 3;
    EXPECT_EQ(after.values[i][0] != before.values[i][0], of_law) << i;
  }
}

TEST_F(HistoryLayoutTest, AStateReplacesThatOfTheElementsThatAreMeant) {
  mechanics::BlockHistory both = history(2);
  const double old = layout.state(both, 1).hardening[0];
  Lane chosen(0.0);
  chosen.set(2, 1.0);
  layout.replace(state(7.0), chosen > Lane(0.0), both, 1);
  EXPECT_EQ(layout.state(both, 1).hardening[2], state(7.0).hardening[2]);
  EXPECT_EQ(layout.state(both, 1).hardening[0], old);
}

TEST_F(HistoryLayoutTest, TheBaseLiesBetweenTheStateAndWhatTheElementKeeps) {
  const std::size_t without = layout.lanes(), extra = layout.extra(0);
  layout.add_base();
  layout.add_base();
  EXPECT_EQ(layout.lanes(), without + 3) << "once";
  EXPECT_EQ(layout.extra(0), extra + 3);
  layout.add_extra(4);
  EXPECT_EQ(layout.lanes(), without + 7);
  EXPECT_EQ(layout.extra(1), without + 7 + extra + 3);
  mechanics::BlockHistory all = history(2);
  const double state_before = layout.state(all, 1).hardening[0],
               extra_before = all.values[layout.extra(1)][0];
  layout.write_base({Lane(1.0), Lane(2.0), Lane(3.0)}, all, 1);
  EXPECT_EQ(layout.base(all, 1).strain_offset[0], 2.0);
  EXPECT_EQ(layout.state(all, 1).hardening[0], state_before);
  EXPECT_EQ(all.values[layout.extra(1)][0], extra_before);
}

}  // namespace
}  // namespace solidus::test
