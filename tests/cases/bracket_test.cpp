/// The case cases/bracket on a coarse mesh: a casting of tetrahedra in sand with nothing set but its data.
/// Every point of the contact is closed until a twentieth of the metal is solid, a step takes six iterations
/// in the mean, and the first law is closed to 1e-8.
#include <gtest/gtest.h>

#include <numeric>

#include "case_run.hpp"

namespace {

using solidus::testing::Columns;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Bracket, FreezesWithFewIterationsAStepAndLeavesItsWallOnlyWithAShell) {
  const auto run = solidus::testing::run(
      "cases/bracket", "bracket",
      {"time.end=\"200 s\"", "mesh.constant=[{name=\"size\", value=12}, {name=\"sand_size\", value=30}]"});
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_LE(mean(run.steps.at("mechanics_iterations[1]")), 6);
  const std::vector<double>&solid = run.steps.at("solid_fraction[1]"),
        &closed = run.steps.at("closed_points[1]"), &points = run.steps.at("contact_points[1]");
  EXPECT_GT(solid.back(), 0.999);
  for (std::size_t i = 0; i < solid.size(); ++i) {
    if (solid[i] < 0.05) {
      EXPECT_EQ(closed[i], points[i]) << "step " << i;
    }
  }
  // First law: what is stored is what went in, to 1e-8 of the heat that moved.
  const std::vector<double>& defect = run.steps.at("energy_defect[J]");
  const std::vector<double>& exchanged = run.steps.at("heat_exchanged[J]");
  double left_over = 0, moved = 0;
  for (std::size_t i = 0; i < defect.size(); ++i) {
    left_over += std::abs(defect[i]);
    moved += std::abs(exchanged[i]);
  }
  EXPECT_LT(left_over, 1e-8 * moved);
}

}  // namespace
