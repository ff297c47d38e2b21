#include "material/liquidus_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "material/cards/library.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::array<fs::path, 1> k_library{fs::path(SOLIDUS_SOURCE_DIR) / "materials"};
constexpr double k_tolerance = 1e-4;

/// Solid fraction at a temperature on the chords of the path; `hot` on the hot side of an isothermal part.
double fraction(const SolidificationPath& path, double t) {
  return PhaseFraction::table(path.points).value(t);
}

SolidificationPath freeze(const std::string& alloy, SolidificationRule rule) {
  const Composition c = parse_composition(alloy);
  return solidification_path(find_liquidus_system(c.solvent, k_library), c, rule, k_tolerance);
}

TEST(SolidificationPath, OfABinaryIsScheilsEquationAndTheEutectic) {
  const double k = 0.13, melting = 273.15 + 660.3, m = -6.6, eutectic = 273.15 + 577, c0 = 7;
  const SolidificationPath path = freeze("Al-7Si", SolidificationRule::scheil);
  EXPECT_NEAR(path.liquidus, melting + m * c0, 1e-9);
  const auto exact = [&](double t) {
    return 1 - std::pow((melting - t) / (melting - path.liquidus), 1 / (k - 1));
  };
  for (double t = eutectic + 0.01; t < path.liquidus; t += 0.5)
    EXPECT_NEAR(fraction(path, t), exact(t), k_tolerance) << t;
  EXPECT_NEAR(path.primary_fraction, exact(eutectic), 1e-9);
  EXPECT_NEAR(path.end, eutectic, 1e-9);
  EXPECT_NEAR(path.last_fraction, 1 - exact(eutectic), 1e-9);
  EXPECT_TRUE(path.remarks.empty());
}

TEST(SolidificationPath, OfABinaryIsTheLeverRule) {
  const double k = 0.13, melting = 273.15 + 660.3, eutectic = 273.15 + 577;
  const SolidificationPath path = freeze("Al-7Si", SolidificationRule::lever_rule);
  const auto exact = [&](double t) { return (path.liquidus - t) / ((1 - k) * (melting - t)); };
  for (double t = eutectic + 0.01; t < path.liquidus; t += 0.5)
    EXPECT_NEAR(fraction(path, t), exact(t), k_tolerance) << t;
  EXPECT_NEAR(path.last_fraction, 1 - exact(eutectic), 1e-9);
}

// With little solute the lever rule ends above the eutectic, where the solid has the alloy's concentration.
TEST(SolidificationPath, OfTheLeverRuleEndsAtTheSolidus) {
  const double k = 0.13, m = -6.6;
  const SolidificationPath path = freeze("Al-1Si", SolidificationRule::lever_rule);
  EXPECT_NEAR(path.end, 273.15 + 660.3 + m / k, 1e-6);
  EXPECT_EQ(path.last_fraction, 0);
}

// The closed form in the liquid fraction: T = T_m + sum m c f^(k - 1), then T_e + sum n c' (f/f1)^(k w - 1).
TEST(SolidificationPath, OfATernaryFollowsTheClosedFormsInTheLiquidFraction) {
  const SolidificationPath path = freeze("Al-6Si-3.5Cu", SolidificationRule::scheil);
  const auto primary = [](double f) {
    return 273.15 + 660.3 - 6.6 * 6 * std::pow(f, 0.13 - 1) - 3.4 * 3.5 * std::pow(f, 0.17 - 1);
  };
  const double f1 = 1 - path.primary_fraction;
  const auto valley = [&](double f) {
    return 273.15 + 577 - 1.93 * 3.5 * std::pow(f1, 0.17 - 1) * std::pow(f / f1, 0.17 * 0.889 - 1);
  };
  EXPECT_NEAR(primary(f1), valley(f1), 1e-6);
  for (double f = 0.98; f > f1; f -= 0.02) EXPECT_NEAR(fraction(path, primary(f)), 1 - f, k_tolerance);
  const double f2 = path.last_fraction;
  for (double f = f1 - 0.01; f > f2; f -= 0.02) EXPECT_NEAR(fraction(path, valley(f)), 1 - f, k_tolerance);
  EXPECT_NEAR(valley(f2), 273.15 + 525, 1e-6);
  EXPECT_NEAR(path.end, 273.15 + 525, 1e-6);
}

// The lever rule loses no solute: what melt, primary solid and second phase hold is what there was.
TEST(SolidificationPath, OfTheLeverRuleKeepsTheSoluteInTheValley) {
  const SolidificationPath path = freeze("Al-6Si-3.5Cu", SolidificationRule::lever_rule);
  const double f1 = 1 - path.primary_fraction, w = 0.889, k = 0.17;
  int compared = 0;
  for (const auto& [t, solid] : path.points) {
    const double f = 1 - solid;
    if (f >= f1 || f <= 1e-9 || (t == path.end && solid == 1)) continue;
    const double copper = (273.15 + 577 - t) / 1.93;  // in the melt
    EXPECT_NEAR(copper * (f + k * (1 - f1 + w * (f1 - f))), 3.5, 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

// Measured liquidus temperatures (table 3 of Adv. Mater. Sci. Eng. 2013, 170527) and handbooks' eutectic
// shares.
TEST(SolidificationPath, MeetsMeasuredLiquidusTemperatures) {
  EXPECT_NEAR(freeze("Mg-9.71Al-0.35Zn", SolidificationRule::scheil).liquidus - 273.15, 596, 3);
  EXPECT_NEAR(freeze("Mg-6.5Al-0.2Zn", SolidificationRule::scheil).liquidus - 273.15, 615, 3);
  EXPECT_NEAR(freeze("Mg-6.61Al-1.32Zn", SolidificationRule::scheil).liquidus - 273.15, 608, 3);
  EXPECT_NEAR(freeze("Al-7Si-0.35Mg", SolidificationRule::scheil).liquidus - 273.15, 614, 3);
  EXPECT_NEAR(freeze("Zn-4Al", SolidificationRule::scheil).liquidus - 273.15, 387, 2);
}

// Magnesium goes into aluminium along with silicon as in the ternary eutectic: calculations with databases
// leave 2 to 4 %.
TEST(SolidificationPath, LeavesMagnesiumToTheTernaryEutectic) {
  const SolidificationPath path = freeze("Al-7Si-0.35Mg", SolidificationRule::scheil);
  EXPECT_NEAR(path.end - 273.15, 555, 0.1);
  EXPECT_GT(path.last_fraction, 0.02);
  EXPECT_LT(path.last_fraction, 0.04);
}

// The cards whose source names a command hold its curve.
TEST(SolidificationPath, IsWhatTheCardsOfTheLibraryHold) {
  const std::array<std::pair<const char*, const char*>, 10> cards{
      {{"aluminium_alsi9cu3", "Al-8.5Si-3.2Cu-0.8Fe"},
       {"aluminium_alsi10mg", "Al-9.5Si-0.35Mg"},
       {"aluminium_alsi6cu4", "Al-6Si-3.5Cu"},
       {"aluminium_alcu4mgti", "Al-4.6Cu-0.25Mg-0.35Mn"},
       {"aluminium_almg5", "Al-5Mg"},
       {"aluminium_6061", "Al-1Mg-0.6Si-0.28Cu"},
       {"aluminium_7075", "Al-5.6Zn-2.5Mg-1.6Cu"},
       {"magnesium_az91", "Mg-9Al-0.7Zn"},
       {"tin_bronze", "Cu-10Sn-2Zn"},
       {"zinc_zamak5", "Zn-4Al-1Cu"}}};
  for (const auto& [name, alloy] : cards) {
    const Material m = find_material(name, k_library);
    const SolidificationPath path = freeze(alloy, SolidificationRule::scheil);
    EXPECT_NEAR(m.solidification()->fraction.liquidus(), path.liquidus, 0.06) << name;
    EXPECT_NEAR(m.solidification()->fraction.solidus(), path.end, 0.06) << name;
    for (double t = path.end + 0.3; t < path.liquidus; t += 1.0)
      EXPECT_NEAR(m.solid_fraction(t), fraction(path, t), 0.02) << name << " at " << t - 273.15;
    EXPECT_THAT(m.notes[3].source, HasSubstr("solidus materials scheil " + std::string(alloy) + "`")) << name;
  }
}

std::string message(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// The straight lines of the library compared with a calculation with the Gibbs energies of COST 507
// (tests/verification/reference/scheil_cost507.py): Al-Si-Mg castings from the liquidus to the ternary
// eutectic.
TEST(SolidificationPath, IsNearThatOfAThermodynamicAssessment) {
  std::ifstream table(SOLIDUS_SOURCE_DIR "/tests/verification/reference/scheil_cost507.csv");
  ASSERT_TRUE(table);
  std::string line, alloy, event, temperature, liquid;
  std::getline(table, line);
  int n_alloys = 0;
  while (std::getline(table, line)) {
    std::istringstream row(line);
    for (std::string* cell : {&alloy, &event, &temperature, &liquid}) std::getline(row, *cell, ',');
    const double t = 273.15 + std::stod(temperature), f = std::stod(liquid);
    const SolidificationPath path = freeze(alloy, SolidificationRule::scheil);
    if (event == "liquidus") {
      EXPECT_NEAR(path.liquidus, t, 4.5) << alloy;
    } else if (event == "ternary_eutectic") {
      ++n_alloys;
      EXPECT_NEAR(path.end, t, 2.5) << alloy;
      EXPECT_GT(path.last_fraction, 0.6 * f) << alloy;
      EXPECT_LT(path.last_fraction, f) << alloy;
    } else {
      EXPECT_NEAR(1 - fraction(path, t), f, event == "primary" ? 0.09 : 0.065) << line;
    }
  }
  EXPECT_EQ(n_alloys, 6);
}

TEST(SolidificationPath, RefusesWhatItCannotTell) {
  const auto scheil = [](const char* alloy) {
    return message([&] { freeze(alloy, SolidificationRule::scheil); });
  };
  EXPECT_THAT(scheil("Al-17Si"), HasSubstr("beyond the eutectic of Al and Si"));
  EXPECT_THAT(scheil("Al-7Sy"), AllOf(HasSubstr("'Sy' is no solute of Al"), HasSubstr("did you mean 'Si'")));
  EXPECT_THAT(scheil("Xx-7Si"), HasSubstr("no liquidus of alloys of 'Xx'"));
  EXPECT_THAT(scheil("Al-Si"), HasSubstr("'Si' in 'Al-Si' is no solute"));
  EXPECT_THAT(scheil("Al-7Si-2Si"), HasSubstr("twice"));
  EXPECT_THAT(scheil("Al-7Al"), HasSubstr("its solvent as a solute"));
  EXPECT_THAT(scheil("Al-30Si-30Cu"), HasSubstr("no corner of Al"));
  EXPECT_THAT(scheil("Al-0Si"), HasSubstr("no solute"));
  EXPECT_THAT(scheil("Al--7Si"), HasSubstr("no solute"));
}

TEST(SolidificationPath, SaysWhichSolutesLieBeyondTheirLines) {
  const SolidificationPath path = freeze("Al-7Si-2.5Fe", SolidificationRule::scheil);
  ASSERT_EQ(path.remarks.size(), 2u);
  EXPECT_THAT(path.remarks[0], HasSubstr("2.5 % Fe lie beyond the line of Fe"));
  EXPECT_THAT(path.remarks[1], HasSubstr("Fe is left out once Si freezes"));
}

}  // namespace
}  // namespace solidus::material
