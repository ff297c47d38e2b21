/// Laws of conductance and of friction as plug-ins: closed forms of the built-in ones against automatic
/// differentiation of their equations, and laws that the sources do not have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "../../laws/bedding_contact.hpp"
#include "../../laws/falling_gap.hpp"
#include "../../laws/hyperbolic_coefficient.hpp"
#include "contact/interface/friction.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "contact/laws/constant_gap.hpp"
#include "contact/laws/exponential_coefficient.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/spots_contact.hpp"

namespace solidus::contact {
namespace {

using ::testing::HasSubstr;

void expect_equal(const LawConductance& a, const LawConductance& b, double x) {
  const auto near = [](double p, double q, double size) {
    EXPECT_NEAR(p, q, 1e-12 * (std::abs(q) + 1e-6 * size));
  };
  near(a.value, b.value, b.value);
  near(a.slope, b.slope, b.value / x);
  near(a.by_temperature, b.by_temperature, b.value / 300);
  near(a.mixed, b.mixed, b.value / x / 300);
}

struct Formula349 {
  PowerContact data;
  template <class T>
  T conductance(const T& p) const {
    return T(data.conductance) * power<T>(T(p / T(*data.hardness)), T(data.exponent));
  }
};
struct Formula348 {
  double k, jump;
  template <class T>
  T conductance(const T& distance, const T& temperature) const {
    return T(k) / (distance + T(jump) * temperature);
  }
};
struct Formula350 {
  double k, open;
  template <class T>
  T conductance(const T& gap) const {
    return T(k) / (gap + T(k / open));
  }
};
struct Formula347 {
  Asperities a;
  template <class T>
  T conductance(const T& p, const T& temperature) const {
    const double size = 1.62e6 * a.roughness / a.slope;
    const double constant = std::pow(size, -a.hardness_exponent) / a.hardness_coefficient;
    const T relative = power<T>(T(p * T(constant)), T(0.95 / (1 + 0.071 * a.hardness_exponent)));
    const T conductivity = T(40.0) + (temperature - T(300.0)) * T(-15.0 / 600);
    return T(1.25 * a.slope / a.roughness) * conductivity * relative;
  }
};

TEST(ConductanceLaws, HaveInClosedFormTheDerivativesOfTheirEquations) {
  const PowerContact power{5000, 0.95, 3e8};
  GasGap smooth{.conductivity = 0.06, .open_conductance = 1200},
      rough{.conductivity = 0.03, .temperature_jump = 1.3e-9};
  ASSERT_FALSE(smooth.begin({}).has_value());
  ASSERT_FALSE(rough.begin({{}, true}).has_value());
  const SpotsContact spots{{2e-6, 0.2, Table({300, 900}, {40, 25}), 6.27e9, -0.229}, 2.5e9};
  for (const double theta : {320.0, 777.0}) {
    for (const double p : {1e4, 3e6, 8e7}) {
      expect_equal(power.at(p, theta), detail::conductance_of(Formula349{power}, p, theta), p);
      expect_equal(spots.at(p, theta), detail::conductance_of(Formula347{spots.asperities}, p, theta), p);
    }
    for (const double g : {1e-7, 4e-5, 2e-3}) {
      expect_equal(smooth.at(g, theta), detail::conductance_of(Formula350{0.06, 1200}, g, theta), g);
      expect_equal(rough.at(g, theta), detail::conductance_of(Formula348{0.03, 1.3e-9}, g, theta), g);
    }
  }
}

HeatTransferSpec added(bool smooth) {
  HeatTransferSpec s;
  s.contact_law = contact_law(test::BeddingContact{1200, 8000, 2e6});
  s.gap_law = gap_law(test::FallingGap{.far = 50, .depth = 3e-5});
  s.smooth = smooth;
  return s;
}

TEST(AddedConductanceLaws, MeetAtContactAndHaveTheDerivativesThatDifferencesShow) {
  for (const bool smooth : {false, true}) {
    const HeatTransferLaw law(added(smooth));
    EXPECT_TRUE(law.of_temperature());
    EXPECT_DOUBLE_EQ(law.at(0, 0, 500).value, 1200);
    EXPECT_NEAR(law.at(-1e-13, 0, 500).value, 1200, 1e-3);
    for (const double theta : {400.0, 900.0})
      for (const double x : {0.3, 2.7}) {
        const double p = x * 1e5, g = x * 1e-6, dp = 1e-4 * p, dg = 1e-4 * g, dt = 0.1;
        // Central differences: 1e-8 of the value.
        const Conductance closed = law.at(1e-9, p, theta), open = law.at(-g, 0, theta);
        const auto h = [&](double penetration, double pressure, double at) {
          return law.at(penetration, pressure, at).value;
        };
        const double by_pressure = (h(1e-9, p + dp, theta) - h(1e-9, p - dp, theta)) / (2 * dp),
                     by_penetration = (h(-g + dg, 0, theta) - h(-g - dg, 0, theta)) / (2 * dg),
                     by_temperature = (h(1e-9, p, theta + dt) - h(1e-9, p, theta - dt)) / (2 * dt);
        EXPECT_NEAR(closed.by_pressure, by_pressure, 1e-6 * std::abs(by_pressure));
        EXPECT_NEAR(open.by_penetration, by_penetration, 1e-6 * std::abs(by_penetration));
        EXPECT_NEAR(closed.by_temperature, by_temperature, 1e-6 * std::abs(by_temperature) + 1e-9);
        EXPECT_EQ(open.by_temperature, 0);
      }
  }
}

std::string refusal(const HeatTransferSpec& spec) {
  try {
    const HeatTransferLaw law(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AddedConductanceLaws, SayWhatDoesNotGoTogether) {
  HeatTransferSpec s = added(false);
  s.gap_law = gap_law(ConstantGap{700});
  EXPECT_THAT(refusal(s), HasSubstr("is not that of a gap of zero"));
  s = added(false);
  s.contact_law = contact_law(SpotsContact{{2e-6, 0.2, Table(30.0), 6.27e9, 0}, 2.5e9});
  EXPECT_THAT(refusal(s), HasSubstr("begins at the conductance of contact"));
  s = added(false);
  s.families = {{300, {}, Table(100.0)}};
  EXPECT_THAT(refusal(s), HasSubstr("which needs gap_law"));
}

struct Twin {
  static constexpr std::string_view name = "gas", doc = "";
};
struct Narrow {
  static constexpr std::string_view name = "narrow", doc = "";
  double open_conductance = 0;
  static void keys(Section<Narrow>& s) {
    s.quantity("open_conductance", &Narrow::open_conductance, "W/m2/K").doc("Of something else.");
  }
};

TEST(AddedLaws, OfATakenNameOrAnotherDeclarationOfAKeyAreRefused) {
  Section<Twin> twin{std::string(Twin::name), ""};
  Section<Narrow> narrow{std::string(Narrow::name), ""};
  Narrow::keys(narrow);
  const auto refused = [](const std::string& name, const SectionInfo& keys) -> std::string {
    try {
      for (const auto& kind : gap_laws().all())
        check_kind("law of the gap", name, keys, kind.name, *kind.keys);
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refused("gas", twin.info()), HasSubstr("the law of the gap 'gas': the name is taken"));
  EXPECT_THAT(refused("narrow", narrow.info()), HasSubstr("declares the key 'open_conductance' otherwise"));
  EXPECT_EQ(refused("wide", twin.info()), "");
}

/// Checks that every formula of the coefficient must pass.
template <class Law>
void expect_consistent(const Law& data, double unit) {
  const FrictionCoefficient mu({.law = coefficient_law(data), .unit = unit});
  for (const double theta : {350.0, 800.0})
    for (const double z : {0.1, 0.9, 4.0}) {
      const double zeta = z * unit, dz = 1e-4 * zeta, dt = 0.05;
      const auto at = mu.point(zeta, theta);
      const auto near = [](double a, double b, double size) {
        EXPECT_NEAR(a, b, 1e-6 * std::abs(b) + 1e-11 * size);
      };
      const auto slope = [](auto f, double x, double h) { return (f(x + h) - f(x - h)) / (2 * h); };
      near(at.value, mu.value(zeta, theta).value, 0);
      near(at.zeta, slope([&](double x) { return mu.value(x, theta).value; }, zeta, dz), 1 / dz);
      near(at.value - at.initial, slope([&](double x) { return mu.point(x, theta).stored; }, zeta, dz), 1);
      near(at.theta,
           slope([&](double t) { return mu.point(zeta, t).value - mu.point(zeta, t).initial; }, theta, dt),
           1 / dt);
      near(at.stored_theta, slope([&](double t) { return mu.point(zeta, t).stored; }, theta, dt), zeta / dt);
      near(at.zeta_theta, slope([&](double t) { return mu.value(zeta, t).zeta; }, theta, dt),
           1 / (zeta * dt));
      const auto bounds = mu.slopes(0.5 * zeta, 2 * zeta, theta);
      EXPECT_LE(bounds.low, at.zeta);
      EXPECT_GE(bounds.high, at.zeta);
    }
}

TEST(CoefficientLaws, AreConsistentWithTheirEnergy) {
  expect_consistent(ExponentialCoefficient{0.15, 0.4, 1.2}, 1e6);
  expect_consistent(test::HyperbolicCoefficient{0.4, 0.1, 0.7}, 1);
}

TEST(AddedCoefficientLaw, SlidesAsItsTableDoes) {
  // The formula against a table of it with points every 1/2000: chords are within 1e-7 of it.
  const test::HyperbolicCoefficient law{0.4, 0.1, 0.7};
  std::vector<double> z, mu;
  for (int i = 0; i <= 8000; ++i) {
    z.push_back(i / 2000.0);
    mu.push_back(law.coefficient(z.back(), 300.0));
  }
  FrictionParameters formula, table;
  formula.coefficient.law = coefficient_law(law);
  table.coefficient.curves = {{300, Table(z, mu)}};
  const FrictionInput in{.trial = 5, .pressure = 2, .internal_variable = 0.3, .temperature = 300};
  const FrictionResponse a = FrictionLaw(formula, 10).update(in), b = FrictionLaw(table, 10).update(in);
  ASSERT_EQ(a.status, FrictionStatus::converged);
  EXPECT_FALSE(a.sticks);
  EXPECT_NEAR(a.traction, b.traction, 1e-6);
  EXPECT_NEAR(a.slip, b.slip, 1e-6);
  EXPECT_NEAR(a.dissipation, b.dissipation, 1e-6);
  EXPECT_NEAR(a.pressure_slope, b.pressure_slope, 1e-3);  // chords of slopes
}

struct Rising {
  static constexpr std::string_view name = "rising", doc = "";
  template <class T>
  T coefficient(const T&, const T& temperature) const {
    return temperature * T(1e-3);
  }
  template <class T>
  T integral(const T& z, const T& temperature) const {
    return z * temperature * T(1e-3);
  }
};

TEST(AddedCoefficientLaw, ThatRisesWithTemperatureIsRefused) {
  try {
    const FrictionCoefficient mu({.law = coefficient_law(Rising{})});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("from 0.3 at 300 K to 0.6 at 600 K"));
  }
}

}  // namespace
}  // namespace solidus::contact
