// What the criteria of hot tearing make of 6061 and 7075 and of a wire of Al-5Mg, whose thresholds of
// cracking in welds were measured (docs/validation/weld_cracking.md): which pairs they rank as measured, and
// which they do not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "criteria/hot_tearing.hpp"
#include "material/cards/library.hpp"
#include "material/liquidus_system.hpp"

namespace solidus::criteria {
namespace {

const std::array<std::filesystem::path, 1> k_library{std::filesystem::path(SOLIDUS_SOURCE_DIR) / "materials"};

struct Weld {
  double clyne_davies, kou, shrinkage, strain;  ///< ratio, [K], A [K], B [K²]
};

/// The temperature at which a solid fraction is reached on the way down.
double temperature_of(const std::vector<std::pair<double, double>>& curve, double fraction) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto& [cold, more] = curve[i - 1];
    const auto& [hot, less] = curve[i];
    if (fraction <= more && fraction >= less)
      return more > less ? std::lerp(cold, hot, (more - fraction) / (more - less)) : hot;
  }
  return curve.back().first;
}

/// Of a curve from low to high temperature. Clyne's and Davies' times are taken as temperatures: even
/// cooling.
Weld weld(const std::vector<std::pair<double, double>>& curve) {
  const auto between = [&](double a, double b) {
    return temperature_of(curve, a) - temperature_of(curve, b);
  };
  const TearingLaw law(curve, 0.06 / 0.94, 1.3e-3, 101e3);
  return {between(k_vulnerable_from, k_vulnerable_to) / between(k_healed_from, k_vulnerable_from),
          kou_index(curve), law.a(), law.b()};
}

Weld of_card(const std::string& name) {
  return weld(material::find_material(name, k_library).solidification()->fraction.points());
}

Weld of_alloy(const std::string& alloy) {
  const material::Composition c = material::parse_composition(alloy);
  return weld(material::PhaseFraction::table(
                  material::solidification_path(material::find_liquidus_system(c.solvent, k_library), c,
                                                material::SolidificationRule::scheil, 1e-4)
                      .points)
                  .points());
}

class WeldCracking : public ::testing::Test {
 protected:
  // Three tenths of the bead are wire, Al-5Mg.
  const Weld k_6061 = of_card("aluminium_6061"), k_7075 = of_card("aluminium_7075"),
             k_6061_wire = of_alloy("Al-2.2Mg-0.42Si-0.196Cu"),
             k_7075_wire = of_alloy("Al-3.92Zn-3.25Mg-1.12Cu");
};

TEST_F(WeldCracking, Tells6061From7075ByEveryCriterion) {
  EXPECT_GT(k_6061.clyne_davies, 4 * k_7075.clyne_davies);
  EXPECT_GT(k_6061.kou, 1.03 * k_7075.kou);
  EXPECT_GT(k_6061.shrinkage, 5 * k_7075.shrinkage);
  EXPECT_GT(k_6061.strain, 10 * k_7075.strain);
}

TEST_F(WeldCracking, WireHelps6061ByTheTimesAndByThePressure) {
  EXPECT_LT(k_6061_wire.clyne_davies, 0.85 * k_6061.clyne_davies);
  EXPECT_LT(k_6061_wire.shrinkage, 0.85 * k_6061.shrinkage);
  EXPECT_LT(k_6061_wire.strain, 0.9 * k_6061.strain);
  EXPECT_GT(k_6061_wire.kou, k_6061.kou);  // not as measured
}

TEST_F(WeldCracking, WireHelps7075ByKouAlone) {
  EXPECT_LT(k_7075_wire.kou, k_7075.kou);
  // Not as measured.
  EXPECT_GT(k_7075_wire.clyne_davies, k_7075.clyne_davies);
  EXPECT_GT(k_7075_wire.strain, k_7075.strain);
}

/// Number of pairs of welds, one of which cracks earlier, that a criterion (high where metal cracks) ranks as
/// measured.
int ranked(const std::array<double, 4>& from_early_to_late) {
  int right = 0;
  for (std::size_t i = 0; i < from_early_to_late.size(); ++i)
    for (std::size_t j = i + 1; j < from_early_to_late.size(); ++j)
      right += from_early_to_late[i] > from_early_to_late[j] ? 1 : 0;
  return right;
}

TEST_F(WeldCracking, EachCriterionRanksFiveOfSixPairs) {
  const std::array<Weld, 4> measured{k_6061, k_6061_wire, k_7075, k_7075_wire};
  for (double Weld::*criterion : {&Weld::clyne_davies, &Weld::kou, &Weld::shrinkage, &Weld::strain}) {
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = measured[i].*criterion;
    EXPECT_EQ(ranked(values), 5);
  }
}

}  // namespace
}  // namespace solidus::criteria
