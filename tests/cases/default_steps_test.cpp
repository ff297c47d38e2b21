/// Adaptive steps without numerical settings.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;

/// A block that freezes on a mould; the steps follow the effort of the iterations most of the time.
const std::string k_adaptive = R"(
title = "A block that freezes on a mould, in adaptive steps"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "tri3"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
lower_divisions = [8, 4]
upper = ["40 mm", "20 mm"]
upper_divisions = [16, 8]
[time]
end = "120 s"
step = "0.2 s"
adaptive = true
easy_iterations = 2
temperature_error = "10 K"
solid_fraction_change = 0.5
max_step = "20 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "640 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "100 degC"
[[thermal_condition]]
name = "air"
group = "lower_y_min"
kind = "film"
coefficient = "500 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
)";

// Newton's iterations beyond the default tolerances say nothing of how hard a step is: who asks for more
// digits gets them at the same times.
TEST(DefaultSteps, ASmallerToleranceLeadsToTheSameAdaptiveSteps) {
  const CaseFolder folder("adaptive_steps");
  const CaseRun usual = folder.run("usual", k_adaptive);
  const CaseRun tight = folder.run("tight", k_adaptive, {"heat.tolerance=1e-11"});
  ASSERT_TRUE(usual.finished && tight.finished) << usual.reason << tight.reason;
  const std::vector<double>&times = usual.history.at("time[s]"), &same = tight.history.at("time[s]");
  ASSERT_EQ(times.size(), same.size());
  for (std::size_t i = 1; i < times.size(); ++i)
    EXPECT_NEAR(same[i], times[i], 0.01 * (times[i] - times[i - 1])) << "step " << i;
}

}  // namespace
