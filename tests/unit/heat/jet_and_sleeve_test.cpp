/// Heat transfer of an impinging jet and heat lost in a shot sleeve, against formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "heat/loads/impinging_jet.hpp"
#include "heat/loads/shot_sleeve.hpp"
#include "material/enthalpy.hpp"

namespace solidus::heat {
namespace {

/// A worked number of the correlation: Re = 20 000, Pr = 1, H/D = 6, r = 5 D, where G = 0.2 (1 − 0.22) and F
/// = 2 √Re √(1 + 0.005 Re^0.55).
TEST(ImpingingJet, IsMartinsCorrelation) {
  const ChannelFluid fluid{Table(1000.0), Table(1000.0), Table(1.0), Table(1e-3)};
  const double d = 0.004, flow = 20000 * std::numbers::pi * d * 1e-3 / (4 * 1000);
  const ImpingingJet jet{d, 6 * d, 5 * d, flow, 300};
  EXPECT_NEAR(reynolds(jet, fluid), 20000, 1e-8);
  EXPECT_NEAR(area_ratio(jet), 0.01, 1e-15);
  const double nusselt = 0.2 * 0.78 * 2 * std::sqrt(20000) * std::sqrt(1 + 0.005 * std::pow(20000, 0.55));
  EXPECT_NEAR(nusselt, 64.85, 0.01);
  EXPECT_NEAR(film_coefficient(jet, fluid), nusselt * 1.0 / d, 1e-6 * nusselt / d);
}

TEST(ShotSleeve, HasThePoolOfASegment) {
  EXPECT_NEAR(pool_angle(0.5), std::numbers::pi, 1e-12);
  EXPECT_NEAR(pool_angle(1), 2 * std::numbers::pi, 1e-4);
  // Half full: the half perimeter over the half circle, and the plunger.
  EXPECT_NEAR(wall_per_volume({0.06, 0.3, 0.5, 1, 500, 1}), 4 / 0.06 + 1 / 0.3, 1e-9);
}

TEST(ShotSleeve, CoolsMetalAsALumpDoes) {
  const material::EnthalpyCurve curve(2500, Table(1100.0), {});
  const ShotSleeve sleeve{0.06, 0.3, 0.4, 4, 450, 3000};
  const double rate = 3000 * wall_per_volume(sleeve) / (2500 * 1100);
  EXPECT_NEAR(temperature_after(sleeve, curve, 960), 450 + 510 * std::exp(-4 * rate), 1e-9);
}

}  // namespace
}  // namespace solidus::heat
