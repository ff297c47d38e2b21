/// The case cases/riser_and_pipe: graphite pushes back as far as the mould holds, and a riser that is too
/// small leaves a hole in the casting.
#include <gtest/gtest.h>

#include "case_folder.hpp"

namespace {

using solidus::testing::Columns;

Columns feeding(const std::string& variant) {
  const std::string name = "riser_and_pipe/" + variant;
  const auto run = solidus::testing::run("cases/riser_and_pipe/" + variant + ".toml", name);
  EXPECT_TRUE(run.finished) << run.reason;
  Columns table = solidus::testing::read_csv(std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" / name /
                                             "feeding.csv");
  for (const double defect : table.at("balance_defect[1]")) EXPECT_LT(std::abs(defect), 1e-8);
  return table;
}

TEST(RiserAndPipe, IronPipesLessTheMoreRigidItsMouldIs) {
  const Columns grey = feeding("case"), rigid = feeding("rigid"), nodular = feeding("nodular"),
                steel = feeding("steel");
  const auto end = [](const Columns& table, const char* column) { return table.at(column).back(); };
  EXPECT_LT(end(rigid, "pipe[m3]"), end(grey, "pipe[m3]"));
  EXPECT_LT(end(grey, "pipe[m3]"), end(nodular, "pipe[m3]"));
  EXPECT_LT(end(nodular, "pipe[m3]"), end(steel, "pipe[m3]"));
  EXPECT_EQ(end(rigid, "wall[m3]"), 0);
  EXPECT_GT(end(grey, "wall[m3]"), 0);
  EXPECT_LT(end(grey, "wall[m3]"), end(nodular, "wall[m3]"));
  EXPECT_EQ(end(steel, "wall[m3]"), 0);
  EXPECT_GT(end(steel, "gas[m3]"), 0);
}

TEST(RiserAndPipe, ARiserThatIsTooSmallLeavesAHoleInTheCasting) {
  const Columns small = feeding("small_riser"), enough = feeding("steel");
  const auto inside = [](const Columns& table) {
    return table.at("cavity[m3]").back() + table.at("sink[m3]").back();
  };
  EXPECT_GT(inside(small), 3 * inside(enough));
}

}  // namespace
