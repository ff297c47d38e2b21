/// Heat content, temperature and potential of a material by one look-up: as the curves say that it is made
/// of.
#include "heat/storage/storage_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "block.hpp"
#include "numbers/interval_search.hpp"

namespace solidus {
namespace {

/// Freezes over a range, at one temperature, or by Scheil's equation with a eutectic; the conductivity is
/// constant, falls, or nearly jumps.
std::vector<material::Material> materials() {
  std::vector<material::Material> all;
  const std::vector<material::PhaseFraction> fractions{material::PhaseFraction::linear(860, 900),
                                                       material::PhaseFraction::linear(900, 900),
                                                       material::PhaseFraction::scheil(933, 887, 850, 0.13)};
  const std::vector<Table> conductivities{Table(80.0), Table({300, 600, 1200}, {200, 150, 60}),
                                          Table({300, 600, 1200}, {60, 150, 200}, Extrapolation::linear),
                                          Table({300, 899.9, 900.1, 1000}, {150, 140, 14, 14})};
  for (const material::PhaseFraction& fraction : fractions)
    for (const Table& conductivity : conductivities) {
      material::Material m = test::metal(40);
      m.specific_heat = Table({350, 800, 1100}, {800, 1200, 1000});
      m.conductivity = conductivity;
      m.phase_changes[0].fraction = fraction;
      all.push_back(m);
    }
  return all;
}

TEST(StorageCurve, SaysWhatTheCurvesSayThatItIsMadeOf) {
  for (const material::Material& m : materials()) {
    const material::EnthalpyCurve h = m.enthalpy();
    const heat::KirchhoffPotential u(m.conductivity);
    const heat::StorageCurve curve(h, u);
    const auto v = [&u](double t) { return u.constant() ? t : u.value(t) / u.reference(); };
    const auto k = [&u](double t) { return u.constant() ? 1.0 : u.conductivity(t) / u.reference(); };
    const double cold = h.lower(250), hot = h.upper(1400);
    for (double share = 0; share <= 1; share += 1.0 / 4096) {
      const double heat = cold + share * (hot - cold), t = h.temperature(heat);
      const heat::StorageCurve::AtHeat at = curve.at_heat(heat);
      EXPECT_NEAR(at.temperature, t, 1e-12 * t);
      EXPECT_NEAR(at.potential, v(t), 1e-10 * std::abs(v(t)) + 1e-9);
      EXPECT_NEAR(at.slope, h.inverse_slope(heat) * k(t), 1e-8 * at.slope) << t;
    }
    for (double t = 251.3; t < 1400; t += 0.37) {
      const heat::StorageCurve::AtPotential at = curve.at_potential(v(t));
      EXPECT_NEAR(at.temperature, t, 1e-11 * t);
      EXPECT_NEAR(at.lower, h.lower(t), 1e-8 * std::abs(hot));
      EXPECT_NEAR(at.upper, h.upper(t), 1e-8 * std::abs(hot));
      EXPECT_NEAR(at.slope, h.inverse_slope(h.upper(t)) * k(t), 1e-7 * at.slope) << t;
    }
    for (const material::EnthalpyCurve::Jump& jump : h.jumps()) {
      const double within = h.lower(jump.temperature) + 0.3 * jump.height;
      const heat::StorageCurve::AtHeat at = curve.at_heat(within);
      EXPECT_DOUBLE_EQ(at.temperature, jump.temperature);
      EXPECT_EQ(at.slope, 0.0);
      const heat::StorageCurve::AtPotential ends = curve.at_potential(at.potential);
      EXPECT_DOUBLE_EQ(ends.temperature, jump.temperature);
      EXPECT_NEAR(ends.upper - ends.lower, jump.height, 1e-9 * jump.height);
      EXPECT_EQ(ends.slope, 0.0);
    }
  }
}

TEST(IntervalSearch, FindsWhatBisectionFinds) {
  std::vector<double> starts{-3, -2.999999, 0, 1e-9, 5, 5.5, 6, 100};
  for (int i = 0; i < 300; ++i) starts.push_back(100.0 + std::pow(1.03, i));
  const IntervalSearch find(starts);
  const auto expect = [&](double x) {
    const auto above = std::upper_bound(starts.begin(), starts.end(), x) - starts.begin();
    EXPECT_EQ(find(x), static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - 1, 0))) << x;
  };
  for (const double start : starts)
    for (const double x : {std::nextafter(start, -1e9), start, std::nextafter(start, 1e9)}) expect(x);
  for (double x = -10; x < 9000; x += 0.77) expect(x);
  for (const double x : {-1e300, 1e300, -HUGE_VAL, HUGE_VAL}) expect(x);
  EXPECT_EQ(IntervalSearch({4.0})(7.0), 0U);
}

}  // namespace
}  // namespace solidus
