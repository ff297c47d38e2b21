/// Gas in whole runs: a sample at the pressures of a vacuum test, of the atmosphere and of an autoclave
/// against a closed balance by Sieverts, restart, and the coupled run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_folder.hpp"

namespace solidus {
namespace {

using testing::CaseFolder;
using testing::CaseRun;

const CaseFolder k_here("gas");

/// A small sample of AlSi7Mg that loses heat evenly.
std::string sample(double bar, const std::string& feeding, const std::string& physics = "heat") {
  std::string text = fmt::format(R"case(title = "A sample of the melt"
[analysis]
kind = "plane_strain"
physics = "{}"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["2 mm", "2 mm"]
divisions = [2, 2]
[time]
until = "solid"
end = "200 s"
step = "0.2 s"
[[body]]
name = "block"
role = "casting"
material = "aluminium_alsi7mg"
initial_temperature = "640 degC"
[gas]
content = "0.3 cm3/(100 g)"
ambient_pressure = "{} bar"
[feeding]
follow = {}
)case",
                                 physics, bar, feeding);
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"})
    text += fmt::format(
        "[[thermal_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"flux\"\nflux = \"-20000 W/m2\"\n",
        side);
  for (const char* field : {"gas_pores", "secondary_arm_spacing"})
    text += fmt::format(
        "[[probe]]\nname = \"{0}\"\nfield = \"{0}\"\nkind = \"mean\"\ngroup = \"block\"\nunit = \"{1}\"\n",
        field, std::string(field) == "gas_pores" ? "1" : "m");
  if (physics != "heat")
    text +=
        "[[mechanical_condition]]\nname = \"foot\"\ngroup = \"x_min\"\nkind = \"displacement\"\nux = \"0 "
        "mm\"\n"
        "[[mechanical_condition]]\nname = \"side\"\ngroup = \"y_min\"\nkind = \"displacement\"\nuy = \"0 "
        "mm\"\n";
  return text;
}

/// Pores of a sample by what the solid keeps in solution at the eutectic.
double sieverts(double bar, double arm_spacing) {
  constexpr double k_solidus = 850.15, k_density = 2.685;  // [K], [g/cm³]
  const double p = 1e5 * bar + 4 * 0.87 / arm_spacing;
  const double dissolved = std::pow(10, 0.788 - 2080 / k_solidus) * std::sqrt(p / 101325);
  const double gas = (0.3 - dissolved) * (101325 / p) * (k_solidus / 273.15) * k_density / 100;
  return gas / (1 + gas);
}

TEST(GasOfASample, IsThatOfAClosedBalanceAtEveryPressure) {
  for (const double bar : {0.08, 1.0, 10.0}) {
    const CaseRun run = k_here.run(fmt::format("sample_{:g}", bar), sample(bar, "false"));
    ASSERT_TRUE(run.finished) << run.reason;
    const double expected = sieverts(bar, run.history.at("secondary_arm_spacing[m]").back());
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(run.history.at("gas_pores[1]").back(), expected, 0.01 * expected) << bar;
  }
}

// Mush that shrinks and that no melt reaches draws its gas larger.
TEST(GasOfASample, TakesPartInFeeding) {
  const CaseRun run = k_here.run("sample_fed", sample(1, "true"));
  ASSERT_TRUE(run.finished) << run.reason;
  const testing::Columns feeding = testing::read_csv(k_here.root() / "sample_fed" / "feeding.csv");
  for (const double defect : feeding.at("balance_defect[1]")) EXPECT_LT(std::abs(defect), 1e-8);
  EXPECT_GT(run.history.at("gas_pores[1]").back(),
            sieverts(1, run.history.at("secondary_arm_spacing[m]").back()));
  const std::string summary = testing::read_text(k_here.root() / "sample_fed" / "summary.json");
  EXPECT_NE(summary.find("gas_pores_volume"), std::string::npos);
}

TEST(GasOfASample, IsTheSameInTheCoupledRun) {
  const CaseRun run = k_here.run("sample_coupled", sample(1, "true", "thermomechanical"));
  ASSERT_TRUE(run.finished) << run.reason;
  const double expected = sieverts(1, run.history.at("secondary_arm_spacing[m]").back());
  EXPECT_NEAR(run.history.at("gas_pores[1]").back(), expected, 0.01 * expected);
}

TEST(GasOfASample, GoesOnAfterARestart) {
  k_here.expect_exact_restart("restart_fed", sample(1, "true"), 60);
  k_here.expect_exact_restart("restart", sample(1, "false"), 60);
}

}  // namespace
}  // namespace solidus
