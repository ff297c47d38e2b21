/// How many processes a run is given by what it has to do.
#include "run/process_count.hpp"

#include <gtest/gtest.h>

#include "cases/case_keys.hpp"
#include "setup/mesh_input.hpp"

namespace solidus::setup {
namespace {

TEST(ProcessCount, SmallCasesStayOnOneProcessAndLargeOnesTakeMore) {
  const run::RunWork small{500, 500, 500, false, 100}, large{227000, 227000, 0, true, 50};
  EXPECT_EQ(run::processes_that_pay(small, 64), 1);
  EXPECT_EQ(run::processes_that_pay(large, 1), 1);
  EXPECT_EQ(run::processes_that_pay(large, 2), 2);
  const int of_many = run::processes_that_pay(large, 256);
  EXPECT_GT(of_many, 8);
  EXPECT_LT(of_many, 256) << "messages cost more than the last of them save";
  EXPECT_LT(run::expected_seconds(large, of_many), run::expected_seconds(large, of_many / 2));
}

TEST(ProcessCount, FewNodesOrFewStepsPayForNoFurtherProcess) {
  EXPECT_EQ(run::processes_that_pay({20000, 0, 0, true, 40}, 2), 1) << "a step of heat is short";
  EXPECT_EQ(run::processes_that_pay({20000, 20000, 0, true, 40}, 2), 2);
  EXPECT_EQ(run::processes_that_pay({20000, 20000, 0, true, 1}, 2), 1) << "as long as starting them";
  EXPECT_EQ(run::processes_that_pay({10000, 10000, 10000, false, 400}, 2), 1)
      << "factors in a plane are small";
  EXPECT_EQ(run::processes_that_pay({22000, 4200, 4200, true, 80}, 2), 2)
      << "metal that melts and yields costs more";
}

TEST(ProcessCount, BodiesThatOnlyConductCountForHeatAlone) {
  const cases::CaseSpec spec = cases::case_keys().read(parse_document(R"(title = "Two blocks"
[analysis]
kind = "plane_strain"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["1 m", "1 m"]
upper = ["1 m", "1 m"]
lower_divisions = [2, 2]
upper_divisions = [4, 4]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "lower"
material = "a"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "b"
physics = "heat"
initial_temperature = "20 degC"
)",
                                                                      "case.toml"));
  const run::RunWork work = run::run_work(spec, {}, raw_mesh(spec));
  EXPECT_EQ(work.heat_nodes, 9 + 25);
  EXPECT_EQ(work.mechanics_nodes, 9);
  EXPECT_EQ(work.poured_nodes, 0);
  EXPECT_FALSE(work.solid);
  EXPECT_EQ(work.steps, 10);
}

}  // namespace
}  // namespace solidus::setup
