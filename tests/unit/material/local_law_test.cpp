/// Tables of local properties: the standard's own examples between their points, and what cards must say.
#include "material/local_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

namespace solidus::material {
namespace {

// EN 1561:2011, annex E, gives for EN-GJL-300 the least tensile strength 346 MPa at a wall of 10 mm, 270 at
// 40, 238 at 80 and 220 at 120.
TEST(LocalLaw, ValuesBetweenPointsAreThoseOfTheStandardsCurve) {
  LocalLaw law;
  law.section = {0.010, 0.080, 0.120};
  law.tensile_strength = {346e6, 238e6, 220e6};
  EXPECT_NEAR(*law.value(law.tensile_strength, 0.040), 270e6, 1e6);
  law.section = {0.010, 0.040, 0.120};
  law.tensile_strength = {346e6, 270e6, 220e6};
  EXPECT_NEAR(*law.value(law.tensile_strength, 0.080), 238e6, 1e6);
}

TEST(LocalLaw, PointsThemselvesAreMetAndNothingIsSaidBeyondThem) {
  LocalLaw law;
  law.arm_spacing = {20e-6, 40e-6, 80e-6};
  law.elongation = {0.12, 0.06, 0.01};
  for (std::size_t i = 0; i < law.arm_spacing.size(); ++i)
    EXPECT_NEAR(*law.value(law.elongation, law.arm_spacing[i]) / law.elongation[i], 1, 1e-14);
  EXPECT_FALSE(law.value(law.elongation, 19.9e-6).has_value());
  EXPECT_FALSE(law.value(law.elongation, 80.1e-6).has_value());
  EXPECT_FALSE(law.value(law.elongation, 0).has_value());
  EXPECT_FALSE(law.value(law.hardness, 40e-6).has_value()) << "no values of it";
}

TEST(LocalLaw, GreyIronHasTheStrengthThatEn1561ExpectsOfItsWalls) {
  const std::vector<std::filesystem::path> library{std::filesystem::path(SOLIDUS_SOURCE_DIR) / "materials"};
  const std::vector<LocalLaw> laws = find_local_laws("grey_iron", library);
  ASSERT_EQ(laws.size(), 2U);
  // Walls of a range have its value at the geometric mean; from one range to the next it falls.
  const double walls[][3] = {{5, 10, 250}, {10, 20, 225}, {20, 40, 195}, {40, 80, 170}, {80, 150, 155}};
  for (const auto& [from, to, strength] : walls) {
    const double middle = 1e-3 * std::sqrt(from * to);
    const double at = std::clamp(middle, laws[0].section.front(), laws[0].section.back());
    EXPECT_NEAR(*laws[0].value(laws[0].tensile_strength, at) / 1e6, strength, 1) << from;
    // Hardness follows from it by annex C.
    EXPECT_NEAR(*laws[1].value(laws[1].hardness, at), 100 + 0.44 * strength, 1) << from;
  }
}

TEST(LocalLaw, ATableThatCannotBeUsedIsRefused) {
  const auto refused = [](auto change) {
    LocalLaw law;
    law.section = {0.01, 0.02};
    law.hardness = {200, 180};
    law.source = "a test";
    check_local_law(law);
    change(law);
    EXPECT_THROW(check_local_law(law), InputError);
  };
  refused([](LocalLaw& law) { law.section = {}; });
  refused([](LocalLaw& law) { law.arm_spacing = {1e-5, 2e-5}; });
  refused([](LocalLaw& law) { law.section = {0.02, 0.01}; });
  refused([](LocalLaw& law) { law.section = {0, 0.01}; });
  refused([](LocalLaw& law) { law.hardness = {200}; });
  refused([](LocalLaw& law) { law.hardness = {200, 0}; });
  refused([](LocalLaw& law) { law.hardness = {}; });
  refused([](LocalLaw& law) { law.source = ""; });
}

}  // namespace
}  // namespace solidus::material
