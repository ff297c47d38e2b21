/// Laws of conductance, friction and phase fraction and a coupling scheme that no file of the sources names,
/// in cases as a user writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../laws/bedding_contact.hpp"
#include "../laws/falling_gap.hpp"
#include "../laws/halved_split.hpp"
#include "../laws/hyperbolic_coefficient.hpp"
#include "../laws/power_fraction.hpp"
#include "case_folder.hpp"
#include "cases/case_keys.hpp"
#include "input/key_docs.hpp"

namespace solidus::testing {
namespace {

using ::testing::HasSubstr;

const CaseFolder k_here("added_plugins");

const std::string k_alloy = R"(title = "An alloy"
like = "aluminium_99_7"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "390 kJ/kg"
volume_change = -0.03
[phase_change.fraction]
kind = "power"
solidus = "600 degC"
liquidus = "660 degC"
fraction_exponent = 1.5
)";

const std::string k_case = R"(title = "Two blocks, the upper one is mushy and coherent, freezes and slides"
[analysis]
kind = "plane_strain"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "20 mm"]
lower_divisions = [3, 2]
upper = ["60 mm", "30 mm"]
upper_divisions = [3, 2]
[time]
end = "40 s"
step = "4 s"
[output]
every = "4 s"
[[body]]
name = "upper"
material = "alloy.toml"
initial_temperature = "615 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "100 degC"
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "left below"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "left above"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "weight"
group = "upper_y_max"
kind = "pressure"
pressure = "50 kPa"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
contact_law = "bedding"
loose = "1500 W/m2/K"
bedded = "9000 W/m2/K"
bedding_pressure = "20 kPa"
gap_law = "falling"
far_conductance = "100 W/m2/K"
gap_depth = "0.05 mm"
[contact.friction]
law = "hyperbolic"
first = 0.4
last = 0.2
half = 10.0
[coupling]
scheme = "halved"
)";

CaseRun run(const std::string& name, const std::vector<std::string>& overrides = {}) {
  k_here.write("alloy.toml", k_alloy);
  return k_here.run(name, k_case, overrides);
}

TEST(AddedPlugins, RunTogetherAndCloseTheFirstLaw) {
  const CaseRun r = run("all");
  ASSERT_TRUE(r.finished) << r.reason;
  // Half of a step of this scheme is one of the split that it is made of.
  const CaseRun split = run("split", {"coupling.scheme=isentropic", "coupling.order=heat_first",
                                      "coupling.gap_tolerance=1", "time.step=2 s"});
  ASSERT_TRUE(split.finished) << split.reason;
  const double heat = r.history.at("heat_exchanged[J]").back();
  for (const auto& [name, values] : split.history) {
    if (name.starts_with("lyapunov_")) continue;  // increments of the last step
    const double sums = name.find("[J") == std::string::npos ? 0 : 1e-12 * heat;  // added up in pairs
    EXPECT_NEAR(r.history.at(name).back(), values.back(), sums) << name;
  }
  EXPECT_LT(std::abs(r.history.at("energy_defect[J]").back()), 1e-9 * heat);
  EXPECT_GT(std::abs(r.history.at("interface_friction_force[N]").back()), 0.1);
  // Contact under the atmosphere conducts more than a gap of zero, where the estimate of freezing ends
  // without one.
  EXPECT_THAT(logging::warnings(), ::testing::Not(::testing::Contains(HasSubstr("does not freeze"))));
}

TEST(AddedPlugins, StandInTheReferenceAndInMessages) {
  const auto& keys = cases::case_keys().info();
  const SectionInfo& contact = *keys.find("contact")->section;
  const SectionInfo& heat = *contact.find("heat")->section;
  EXPECT_THAT(heat.find("gap_law")->allowed, ::testing::Contains("falling"));
  EXPECT_EQ(heat.find("gap_depth")->when_values, std::vector<std::string>{"falling"});
  EXPECT_EQ(heat.find("gap_depth")->unit, "m");
  EXPECT_THAT(contact.find("friction")->section->find("law")->allowed, ::testing::Contains("hyperbolic"));
  EXPECT_THAT(keys.find("coupling")->section->find("scheme")->allowed, ::testing::Contains("halved"));
  const auto error = [](const std::string& override) -> std::string {
    try {
      run("wrong", {override});
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_THAT(error("contact.interface.heat.gap_law=fallin"),
              HasSubstr("did you mean 'falling'? one of: constant, table, gas, falling"));
}

}  // namespace
}  // namespace solidus::testing
