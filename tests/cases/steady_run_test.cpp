/// Whole runs of steady states of heat and deformation, and of coupling in one direction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_folder.hpp"

namespace {

using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("steady_run");

/// Two bars between fixed ends, 50 mm and 30 mm long, the lower one heated at its foot to 300 °C: heat
/// crosses a gap that the heat itself makes narrower. Without lateral strain (ν = 0) and with faces that stay
/// plane it is a problem in one dimension.
const std::string k_gap = R"(title = "Two bars and the gap between them"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
gap = "0.2 mm"
lower = ["10 mm", "50 mm"]
lower_divisions = [2, 10]
upper = ["10 mm", "30 mm"]
upper_divisions = [2, 6]
[time]
steady = true
[[body]]
name = "upper"
material = "bar.toml"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "bar.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "above"
group = "upper_y_max"
kind = "temperature"
temperature = "20 degC"
[[thermal_condition]]
name = "below"
group = "lower_y_min"
kind = "temperature"
temperature = "300 degC"
[[mechanical_condition]]
name = "foot"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "head"
group = "upper_y_max"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "symmetry_lower"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_upper"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
search_distance = "1 mm"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
[[probe]]
name = "below"
kind = "mean"
field = "temperature"
group = "lower_top"
unit = "degC"
[[probe]]
name = "above"
kind = "mean"
field = "temperature"
group = "upper_bottom"
unit = "degC"
[[probe]]
name = "gap"
kind = "mean"
field = "gap"
group = "upper_bottom"
unit = "mm"
)";
const std::string k_bar = R"(title = "A metal"
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.0
expansion = "1.2e-5 1/K"
expansion_reference = "20 degC"
)";

/// Flux, temperatures on both sides and gap of the steady state of these bars, gap `g0` when cold.
struct Bars {
  double flux = 0, below = 0, above = 0,
         gap = 0;  ///< [W/m²], [°C], [°C], [m]; negative gap: pressed together
  explicit Bars(double g0) {
    constexpr double k = 40, k_gas = 0.05, h_o = 2000, hot = 300, cold = 20, alpha = 1.2e-5, l1 = 0.05,
                     l2 = 0.03;
    double low = 0, high = (hot - cold) * k / (l1 + l2);
    for (int i = 0; i < 200; ++i) {
      flux = 0.5 * (low + high);
      below = hot - flux * l1 / k, above = cold + flux * l2 / k;
      gap = g0 - alpha * (l1 * (0.5 * (hot + below) - cold) + l2 * (0.5 * (above + cold) - cold));
      const double h = gap > 0 ? k_gas / (gap + k_gas / h_o) : h_o;
      (h * (below - above) > flux ? low : high) = flux;
    }
  }
};

TEST(SteadyRun, FindsTheTemperaturesAndTheGapThatBelongTogether) {
  k_here.write("bar.toml", k_bar);
  const auto run = k_here.run("gap", k_gap);
  ASSERT_TRUE(run.finished) << run.reason;
  const Bars exact(0.2e-3);
  EXPECT_GT(exact.gap, 1e-5);
  EXPECT_NEAR(run.history.at("below[degC]").back(), exact.below, 1e-5);
  EXPECT_NEAR(run.history.at("above[degC]").back(), exact.above, 1e-5);
  EXPECT_NEAR(run.history.at("gap[mm]").back(), 1e3 * exact.gap, 1e-7);
  EXPECT_NEAR(run.history.at("contact_heat[W]").back(), -exact.flux * 0.01, 1e-8 * exact.flux);
  EXPECT_NEAR(run.history.at("heat_in[J]").back(), 0, 1e-6 * exact.flux);
  EXPECT_GT(run.steps.at("coupling_iterations[1]").back(), 2);
}

// A gap that closes: the bars press on each other, p (l1 + l2)/E being what the expansion lacks room for.
TEST(SteadyRun, FindsThePressureOfAGapThatHasClosed) {
  k_here.write("bar.toml", k_bar);
  const auto run = k_here.run("closed", k_gap,
                              {"mesh.two_blocks.gap=20 um", "contact.interface.normal=augmented_lagrangian"});
  ASSERT_TRUE(run.finished) << run.reason;
  const Bars exact(20e-6);
  ASSERT_LT(exact.gap, 0);
  EXPECT_NEAR(run.history.at("below[degC]").back(), exact.below, 1e-5);
  const double force = 200e9 * -exact.gap / 0.08 * 0.01;
  EXPECT_NEAR(run.history.at("contact_force[N]").back(), force, 1e-4 * force);
}

TEST(SteadyRun, OfMechanicsAloneIsOneEquilibrium) {
  k_here.write("bar.toml", k_bar);
  std::string pressed = k_gap;
  for (const std::string section : {"[[thermal_condition]]", "[contact.heat]", "[[probe]]"})
    for (std::size_t at; (at = pressed.find(section)) != std::string::npos;) {
      const std::size_t next = pressed.find("\n[", at + 2);
      pressed.erase(at, next == std::string::npos ? std::string::npos : next + 1 - at);
    }
  pressed.replace(pressed.find("thermomechanical"), 16, "mechanics");
  const auto run = k_here.run("pressed", pressed,
                              {"mesh.two_blocks.gap=0 mm", "mechanical_condition.head.uy=-0.08 mm",
                               "contact.interface.normal=augmented_lagrangian"});
  ASSERT_TRUE(run.finished) << run.reason;
  const double force = 200e9 * 1e-3 * 0.01;
  EXPECT_NEAR(run.history.at("contact_force[N]").back(), force, 1e-4 * force);
}

TEST(SteadyRun, HasNoInertia) {
  k_here.write("bar.toml", k_bar);
  try {
    k_here.run("moving", k_gap + "[dynamics]\n");
    ADD_FAILURE() << "inertia passed";
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("inertia in a steady analysis"));
  }
}

// Deformation follows the temperatures and the gap conducts, but deformation takes up no heat. A phase that
// holds entropy then holds temperature, iterations of both kinds end in the same solution, and heat alone
// closes the first law.
TEST(OneWayCoupling, GoesWithEveryScheme) {
  k_here.write("bar.toml", k_bar);
  const auto go = [](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"time.steady=false", "time.end=100 s", "time.step=5 s",
                             "coupling.structural_heating=none", "coupling.scheme=" + name});
    const auto run = k_here.run("one_way_" + name, k_gap, more);
    EXPECT_TRUE(run.finished) << name << ": " << run.reason;
    EXPECT_NEAR(run.history.at("energy_defect[J]").back(), 0,
                1e-7 * run.history.at("heat_exchanged[J]").back())
        << name;
    return run;
  };
  const auto isothermal = go("isothermal", {}), isentropic = go("isentropic", {}),
             iterated = go("block_iterative", {}), together = go("simultaneous", {}),
             double_pass = go("double_pass", {}),
             two_stages = go("simultaneous", {"coupling.integration=sdirk2", "time.step=1 s"});
  for (const char* column : {"below[degC]", "above[degC]", "gap[mm]"}) {
    SCOPED_TRACE(column);
    EXPECT_EQ(isentropic.history.at(column), isothermal.history.at(column));
    const double fine = two_stages.history.at(column).back();
    EXPECT_NEAR(iterated.history.at(column).back(), together.history.at(column).back(), 1e-6 * fine);
    // Second order next to first.
    EXPECT_LT(std::abs(double_pass.history.at(column).back() - fine),
              0.1 * std::abs(together.history.at(column).back() - fine));
    EXPECT_NEAR(together.history.at(column).back(), fine, 0.02 * fine);
  }
}

}  // namespace
