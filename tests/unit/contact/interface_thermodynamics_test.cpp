#include "contact/interface/interface_thermodynamics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "contact/interface/wear.hpp"
#include "friction_laws.hpp"

namespace solidus::contact {
namespace {

using enum InternalVariable;
constexpr double k_penalty = 1e11;

/// Central differences of fourth order.
double difference(const std::function<double(double)>& f, double x, double h) {
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

class Random {
 public:
  double between(double a, double b) { return a + (b - a) * uniform_(engine_); }
  double decades(double a, double b) { return std::pow(10, between(std::log10(a), std::log10(b))); }
  int below(int n) { return static_cast<int>(between(0, n)); }

  InterfaceSides sides() {
    InterfaceSides s;
    for (std::size_t i = 0; i < 2; ++i) {
      s.temperature[i] = between(280, 1200);
      s.conductance[i] = below(8) ? decades(1, 1e6) : 0;
    }
    return s;
  }
  InterfaceStep step() {
    const double capacity = below(4) ? decades(1, 1e5) : 0;
    return {decades(1e-6, 100), capacity, between(280, 1200), capacity * between(-0.5, 0.5),
            below(2) ? decades(1, 1e6) : 0};
  }

 private:
  std::mt19937_64 engine_{11};
  std::uniform_real_distribution<double> uniform_;
};

/// GA with hardening that depends on temperature and thermal softening.
FrictionParameters hot_law(InternalVariable variable = normal_work) {
  return friction_spec({Table({280, 1200}, {0.2, 0.1}), Table({280, 1200}, {0.05, -0.03})},
                       variable == InternalVariable::slip ? 0.01 : k_kilonewton_per_mm, variable);
}

TEST(InterfaceBalance, FindsTheTemperatureOfAMillionRandomInterfaces) {
  Random random;
  for (int i = 0; i < 1000000; ++i) {
    const InterfaceStep step = random.step();
    const InterfaceSides sides = random.sides();
    const auto r = interface_balance(step, sides);
    ASSERT_TRUE(r.balanced) << i;
    if (!std::isfinite(r.stiffness)) continue;
    const double entropy =
        step.structural_entropy + step.heat_capacity * std::log(r.temperature / step.temperature);
    const double stored = r.temperature * entropy, came = step.time_step * (r.flux[0] + r.flux[1]);
    const double size = std::abs(step.dissipation) + r.temperature * step.heat_capacity +
                        step.time_step * 2000 * (sides.conductance[0] + sides.conductance[1]);
    ASSERT_NEAR(stored, came + step.dissipation, 1e-13 * size) << i;
    ASSERT_GT(r.temperature, 0);
  }
}

TEST(InterfaceBalance, WithoutCapacityLiesWhereTheFluxesBalanceTheHeatOfFriction) {
  // h_1 (Θ_c − Θ_1) + h_2 (Θ_c − Θ_2) = D
  const InterfaceSides sides{{400, 300}, {2000, 6000}};
  const auto r = interface_balance({0.5, 0, 320, 0, 4000}, sides);
  EXPECT_DOUBLE_EQ(r.temperature, (2000 * 400 + 6000 * 300 + 8000) / 8000.0);
  EXPECT_NEAR(r.flux[0] + r.flux[1], -8000, 1e-9);
  EXPECT_DOUBLE_EQ(resting_temperature(sides), 325);
  // Conductances that differ carry the heat of friction in proportion.
  const auto cold = interface_balance({0.5, 0, 320, 0, 0}, sides);
  EXPECT_NEAR((cold.flux[0] - r.flux[0]) / 8000, 0.25, 1e-12);
}

TEST(InterfaceBalance, SharesHeatEvenlyWhereNothingConducts) {
  const auto r = interface_balance({0.5, 0, 320, 0, 4000}, {{400, 300}, {0, 0}});
  EXPECT_EQ(r.flux[0], -4000);
  EXPECT_EQ(r.flux[1], -4000);
  const auto nearly = interface_balance({0.5, 0, 320, 0, 4000}, {{400, 300}, {1e-6, 1e-6}});
  EXPECT_NEAR(nearly.flux[0], -4000, 1e-3) << "the limit of equal small conductances";
}

TEST(InterfaceBalance, SaysWhenAnInterfaceWithoutCapacityCannotHoldItsEntropy) {
  EXPECT_FALSE(interface_balance({1e-3, 0, 320, -10, 0}, {{400, 300}, {100, 100}}).balanced);
}

TEST(InterfaceBalance, HasTheDerivativesOfItsFluxes) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const InterfaceStep step = random.step();
    const InterfaceSides sides = random.sides();
    const auto r = interface_balance(step, sides);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto at = [&](double theta) {
        InterfaceSides s = sides;
        s.temperature[k] = theta;
        return interface_balance(step, s);
      };
      for (std::size_t j = 0; j < 2; ++j) {
        const double slope = difference([&](double t) { return at(t).flux[j]; }, sides.temperature[k], 0.5);
        const double size = sides.conductance[j] + 1e-3 * std::abs(r.flux[j]);
        ASSERT_NEAR(r.flux_slope[j][k], slope, 1e-8 * size) << i;
      }
      const double slope = difference([&](double t) { return at(t).temperature; }, sides.temperature[k], 0.5);
      ASSERT_NEAR(r.by_side[k], slope, 1e-8 * (1 + 1e-3 * r.temperature)) << i;
      if (!std::isfinite(r.stiffness) || sides.conductance[k] == 0) continue;
      const auto by_conductance = [&](double h) {
        InterfaceSides s = sides;
        s.conductance[k] = h;
        return interface_balance(step, s).temperature;
      };
      const double h = sides.conductance[k];
      ASSERT_NEAR((sides.temperature[k] - r.temperature) / r.stiffness * h,
                  h * difference(by_conductance, h, 1e-3 * h), 1e-8 * r.temperature);
    }
  }
}

/// D_c,int Δt/Θ_c + D_c,cond Δt/Θ_c: the entropy that the interface makes in a step.
double production(const InterfaceStep& step, const InterfaceSides& sides, const InterfaceResponse& r,
                  double plastic_entropy) {
  const double elastic =
      step.structural_entropy +
      (step.heat_capacity > 0 ? step.heat_capacity * std::log(r.temperature / step.temperature) : 0);
  return elastic + plastic_entropy -
         step.time_step * (r.flux[0] / sides.temperature[0] + r.flux[1] / sides.temperature[1]);
}

TEST(InterfaceThermodynamics, DissipationsAndEntropyProductionAreNeverNegative) {
  Random random;
  for (int i = 0; i < 300000; ++i) {
    const auto variable = static_cast<InternalVariable>(random.below(3));
    static const std::array<FrictionParameters, 3> specs{hot_law(normal_work), hot_law(frictional_work),
                                                         hot_law(InternalVariable::slip)};
    const double capacity = random.below(4) ? random.decades(100, 1e5) : 0;
    const FrictionLaw law(specs[static_cast<std::size_t>(variable)], k_penalty, capacity);
    const double pressure = random.decades(1e5, 1e8), theta = random.between(300, 1000);
    const double size = variable == InternalVariable::slip ? 0.01 : k_kilonewton_per_mm;
    const FrictionInput in{pressure * random.decades(0.05, 20), pressure, size * random.between(0, 1), theta};
    const auto f = i % 2 ? law.update(in) : law.isentropic(in);
    if (f.status != FrictionStatus::converged) continue;
    ASSERT_GE(f.dissipation, 0);
    InterfaceSides sides = random.sides();
    sides.conductance[0] += 1000;
    const InterfaceStep step{random.decades(1e-4, 10), capacity, theta, f.structural_entropy, f.dissipation};
    const auto r = interface_balance(step, sides);
    if (!r.balanced) continue;
    const double plastic = plastic_entropy_increment(law, f.slip, pressure, r.temperature);
    ASSERT_GE(plastic, 0);
    // Rounding of Q_i = h_i (Θ_i − Θ_c) and of the logarithm.
    const double conduction = step.time_step * 10 * (sides.conductance[0] + sides.conductance[1]);
    ASSERT_GE(production(step, sides, r, plastic), -1e-12 * (conduction + capacity)) << i;
  }
}

TEST(InterfaceThermodynamics, EnergyAndEntropyComeFromOneFreeEnergy) {
  // ∂E_c/∂Θ = Θ ∂S^e_c/∂Θ = C_c (3.67a), and ∂S^e_c/∂ζ Δζ is what the law reports.
  const FrictionLaw law(hot_law(), k_penalty, 500);
  const double theta = 640, zeta = 0.8e6;
  const auto energy = [&](double t) { return interface_energy(law, t, zeta); };
  const auto entropy = [&](double t) { return interface_entropy(law, t, zeta); };
  EXPECT_NEAR(difference(energy, theta, 1), 500, 1e-6);
  EXPECT_NEAR(theta * difference(entropy, theta, 1), 500, 1e-6);
  const auto r = law.update({2e7, 5e7, zeta, theta});
  EXPECT_NEAR(r.structural_entropy,
              interface_entropy(law, theta, r.internal_variable) - interface_entropy(law, theta, zeta),
              1e-9 * std::abs(r.structural_entropy));
}

TEST(InterfaceThermodynamics, BothMechanicalPhasesEndInTheSameBalance) {
  const FrictionLaw law(hot_law(), k_penalty, 500);
  const FrictionInput in{2e7, 5e7, 0.8e6, 640};
  const auto f = law.isentropic(in);
  const InterfaceSides sides{{500, 400}, {3000, 5000}};
  const auto r = interface_balance({0.1, 500, 640, f.structural_entropy, f.dissipation}, sides);
  // 5.33 with S^e_c,n = C_co ln(Θ̄/Θ_0) − K_Θ(ζ_{n+1})
  EXPECT_NEAR(r.temperature * 500 * std::log(r.temperature / f.temperature),
              0.1 * (r.flux[0] + r.flux[1]) + f.dissipation, 1e-8 * f.dissipation);
}

TEST(InterfaceReturnMapping, SolvesBothEquationsOfThePrintedThermalPhase) {
  Random random;
  int slid = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto variable = static_cast<InternalVariable>(random.below(3));
    const double capacity = random.below(4) ? random.decades(1000, 1e5) : 0;
    const FrictionLaw law(hot_law(variable), k_penalty, capacity);
    const double pressure = random.decades(1e5, 1e8), theta = random.between(300, 1000);
    const double size = variable == InternalVariable::slip ? 0.01 : k_kilonewton_per_mm;
    const FrictionInput in{pressure * random.decades(0.05, 10), pressure, size * random.between(0, 1), theta};
    const double dt = random.decades(1e-3, 10);
    InterfaceSides sides = random.sides();
    sides.conductance[0] += 1e4;
    sides.conductance[1] += 1e3;
    const auto r = interface_return_mapping(law, in, dt, sides);
    ASSERT_TRUE(r.heat.balanced);
    const double end = r.heat.temperature;
    const auto& f = r.friction;
    slid += !f.sticks;
    // Φ_c = 0 at Θ_{n+1}
    const double mu = law.coefficient().value(f.internal_variable, end).value;
    if (!f.sticks) {
      ASSERT_NEAR(in.trial - k_penalty * f.slip, mu * pressure, 1e-10 * in.trial);
    }
    // g_c = 0, with the entropy along the lines at Θ_n
    double entropy = capacity * std::log(end / theta);
    if (law.stores())
      entropy -= law.coefficient().point(f.internal_variable, theta).stored_theta -
                 law.coefficient().point(in.internal_variable, theta).stored_theta;
    const double mu_0 = law.coefficient().value(0, end).value;
    const double dissipation = f.slip * pressure * (law.stores() ? mu_0 : mu);
    const double scale = end * (capacity + std::abs(entropy)) + dissipation +
                         dt * 1000 * (sides.conductance[0] + sides.conductance[1]);
    ASSERT_NEAR(end * entropy, dt * (r.heat.flux[0] + r.heat.flux[1]) + dissipation, 1e-10 * scale) << i;
    if (i % 20) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto temperature = [&](double t) {
        InterfaceSides s = sides;
        s.temperature[k] = t;
        return interface_return_mapping(law, in, dt, s).heat.temperature;
      };
      if (end > 290 && end < 1190) {
        ASSERT_NEAR(r.heat.by_side[k], difference(temperature, sides.temperature[k], 0.5), 1e-7) << i;
      }
    }
  }
  EXPECT_GT(slid, 5000);
}

// What passes at the iterate's Θ_c, or at its entropy, and the balance with held slip agree on.
TEST(InterfaceReturnMapping, IsWhatPassesThatTakeTurnsAgreeOn) {
  Random random;
  int slid = 0;
  for (int i = 0; i < 600; ++i) {
    const auto variable = static_cast<InternalVariable>(i % 3);
    const double capacity = i % 2 == 0 ? random.decades(1000, 1e4) : 0;
    const FrictionLaw law(hot_law(variable), k_penalty, capacity);
    const double size = variable == InternalVariable::slip ? 0.01 : k_kilonewton_per_mm;
    const double pressure = random.decades(1e6, 1e8), theta = random.between(350, 850), dt = 1e-2;
    const FrictionInput in{pressure * random.between(0.1, 2), pressure, size * random.between(0, 1), theta};
    const InterfaceSides sides{{theta + random.between(-20, 20), theta + random.between(-20, 20)},
                               {random.decades(1e5, 1e6), random.decades(1e5, 1e6)}};
    const InterfaceReturn at_once = interface_return_mapping(law, in, dt, sides);
    if (at_once.friction.status != FrictionStatus::converged || !at_once.heat.balanced) continue;
    for (const bool isentropic : {false, true}) {
      FrictionInput pass = in;
      FrictionResponse f;
      double found = theta;
      for (int n = 0; n < 60; ++n) {
        f = isentropic ? law.isentropic(pass) : law.update(pass);
        ASSERT_EQ(f.status, FrictionStatus::converged) << i;
        found =
            interface_balance({dt, capacity, theta, f.structural_entropy, f.dissipation}, sides).temperature;
        pass.iterate = FrictionInput::Iterate{found, f.internal_variable};
      }
      ASSERT_NEAR(found, at_once.heat.temperature, 1e-9 * theta) << i << isentropic;
      ASSERT_NEAR(f.traction, at_once.friction.traction, 1e-9 * pressure) << i << isentropic;
      ASSERT_NEAR(f.dissipation, at_once.friction.dissipation, 1e-9 * pressure * std::max(f.slip, 1e-6)) << i;
      if (capacity > 0 && isentropic) {
        ASSERT_NEAR(f.temperature, found, 1e-9 * theta) << "the intermediate temperature is that of the end";
      }
    }
    slid += !at_once.friction.sticks;
  }
  EXPECT_GT(slid, 300);
}

TEST(InterfaceReturnMapping, HasTheSlopesThatDifferencesShow) {
  Random random;
  int slid = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto variable = static_cast<InternalVariable>(i % 3);
    const FrictionLaw law(hot_law(variable), k_penalty, i % 2 == 0 ? 2000 : 0);
    const double size = variable == InternalVariable::slip ? 0.01 : k_kilonewton_per_mm;
    const double pressure = random.decades(1e6, 1e8), theta = random.between(350, 850);
    const FrictionInput in{pressure * random.between(0.3, 2), pressure, size * random.between(0, 1), theta};
    const InterfaceSides sides{{theta + random.between(-20, 20), theta + random.between(-20, 20)},
                               {9e4, 9e4}};
    constexpr double k_dt = 0.5;
    const auto r = interface_return_mapping(law, in, k_dt, sides);
    // Away from the ends of the tables.
    if (r.friction.sticks || r.heat.temperature < 310 || r.heat.temperature > 890) continue;
    ++slid;
    const auto along = [&](bool of_pressure, auto value) {
      const double x = of_pressure ? in.pressure : in.trial;
      return difference(
          [&](double moved) {
            FrictionInput other = in;
            (of_pressure ? other.pressure : other.trial) = moved;
            return value(interface_return_mapping(law, other, k_dt, sides));
          },
          x, 1e-5 * x);
    };
    const auto temperature = [](const InterfaceReturn& at) { return at.heat.temperature; };
    const auto traction = [](const InterfaceReturn& at) { return at.friction.traction; };
    const auto flux = [](const InterfaceReturn& at) { return at.heat.flux[0]; };
    for (const bool of_pressure : {false, true}) {
      const double source = of_pressure ? r.source_by_pressure : r.source_by_trial;
      const double by = source / r.heat.stiffness, per = 1 / pressure;
      ASSERT_NEAR(by, along(of_pressure, temperature), 1e-6 * theta * per) << i;
      ASSERT_NEAR(-r.heat.by_side[0] * source, along(of_pressure, flux), 1e-6 * 9e4 * theta * per) << i;
      const double fixed = of_pressure ? r.friction.pressure_slope : r.friction.trial_slope;
      ASSERT_NEAR(fixed + r.traction_by_temperature * by, along(of_pressure, traction), 1e-6) << i;
    }
  }
  EXPECT_GT(slid, 200);
}

TEST(InterfaceReturnMapping, AgreesWithHeldSlipInTheLimitOfSmallSteps) {
  const FrictionLaw law(hot_law(), k_penalty, 2000);
  const InterfaceSides sides{{700, 700}, {3000, 5000}};
  const auto slide = [&](int steps, bool printed) {
    double zeta = 1e6, theta = 700, traction = 0;
    for (int i = 0; i < steps; ++i) {
      const double dt = 1.0 / steps;
      const FrictionInput in{traction + k_penalty * 5e-3 * dt, 5e7, zeta, theta};
      auto f = law.update(in);
      if (printed) {
        const auto r = interface_return_mapping(law, in, dt, sides);
        f = r.friction;
        theta = r.heat.temperature;
      } else {
        theta = interface_balance({dt, 2000, theta, f.structural_entropy, f.dissipation}, sides).temperature;
      }
      zeta = f.internal_variable;
      traction = f.traction;
    }
    return theta;
  };
  const auto gap = [&](int steps) { return std::abs(slide(steps, true) - slide(steps, false)); };
  EXPECT_GT(gap(100), 0);
  EXPECT_NEAR(gap(100) / gap(200), 2, 0.2);
}

/// L of a point that is pulled by a store of energy, next to bodies at Θ_o (3.69): what the store gives is
/// lost there, and the bodies' E − Θ_o S does not change with heat at Θ_o.
class Functional {
 public:
  Functional(const FrictionLaw& law, double reference) : law_(law), reference_(reference) {}
  double operator()(double theta, double zeta, double traction, double pulled) const {
    return interface_energy(law_, theta, zeta) - reference_ * interface_entropy(law_, theta, zeta) +
           0.5 * traction * traction / law_.tangential_penalty() - pulled;
  }

 private:
  const FrictionLaw& law_;
  double reference_;
};

TEST(InterfaceStability, IsothermalContactLosesTheEstimateThatIsentropicContactKeeps) {
  // Hardening that fades in the heat: friction alone dissipates little, but slip at a hot interface takes up
  // heat, H^fc > 0, and 5.13a lets L grow by (1 − Θ_o/Θ) H^fc − D. A cycle of steps at an interface that a
  // hot body keeps hot.
  const double reference = 300, pressure = 1e7;
  const FrictionLaw law(friction_spec({0.02, Table({300, 900}, {0.5, 0.1})}, k_kilonewton_per_mm), k_penalty,
                        2000);
  const Functional functional(law, reference);
  struct Growth {
    double mechanical = -1e300, step = -1e300;
  };
  const auto cycle = [&](bool isentropic) {
    Growth g;
    double zeta = 0.3e6, theta = 850, traction = 0, pulled = 0;
    for (int i = 0; i < 50; ++i) {
      const double way = 2e-3, before = functional(theta, zeta, traction, pulled);
      const FrictionInput in{traction + k_penalty * way, pressure, zeta, theta};
      const auto f = isentropic ? law.isentropic(in) : law.update(in);
      EXPECT_EQ(f.status, FrictionStatus::converged);
      pulled += f.traction * way;
      const double change = functional(f.temperature, f.internal_variable, f.traction, pulled) - before;
      if (i > 0) g.mechanical = std::max(g.mechanical, change);  // the first step winds the spring up
      // The thermal phase, the bodies at Θ_o.
      const auto r = interface_balance({0.1, 2000, theta, f.structural_entropy, f.dissipation},
                                       {{reference, reference}, {100, 100}});
      zeta = f.internal_variable;
      traction = f.traction;
      theta = r.temperature;
      if (i > 0) g.step = std::max(g.step, functional(theta, zeta, traction, pulled) - before);
    }
    return g;
  };
  const Growth isothermal = cycle(false), isentropic = cycle(true);
  EXPECT_GT(isothermal.mechanical, 100) << "[J/m²]: 5.13a";
  EXPECT_LT(isentropic.mechanical, 0) << "5.9a";
  EXPECT_LT(isentropic.step, 0);
}

TEST(InterfaceStability, IsentropicMechanicalPhaseDissipatesAtLeastWhatFrictionDoes) {
  // Hardening, at random: L falls by D_c,mech Δt or more (5.9a); backward Euler adds to it.
  Random random;
  for (int i = 0; i < 100000; ++i) {
    const double a = random.between(0.05, 0.5), b = random.between(0.05, 0.5);
    const FrictionLaw law(friction_spec({0.05, Table({300, 900}, {a, b})}, k_kilonewton_per_mm), k_penalty,
                          random.decades(1000, 1e5));
    const double reference = random.between(300, 900), pressure = random.decades(1e6, 1e8);
    const Functional functional(law, reference);
    const double zeta = 1e6 * random.between(0, 1), theta = random.between(310, 890);
    const double traction = law.coefficient().value(zeta, theta).value * pressure;
    const double way = random.decades(1e-6, 1e-3);
    const auto f = law.isentropic({traction + k_penalty * way, pressure, zeta, theta});
    if (f.temperature < 300 || f.temperature > 900) continue;  // beyond the table's lines
    const double change = functional(f.temperature, f.internal_variable, f.traction, f.traction * way) -
                          functional(theta, zeta, traction, 0);
    const double size = std::abs(interface_energy(law, theta, zeta)) + f.traction * way;
    ASSERT_LE(change, -f.dissipation + 1e-12 * size) << i;
  }
}

TEST(Wear, GrowsWithPressureAndSlipOverHardness) {
  const WearParameters wear{1e-4, Table({300, 700}, {2e9, 1e9}), 0, {}};
  EXPECT_DOUBLE_EQ(wear.depth_increment(4e7, 0.01, 300), 1e-4 * 4e7 * 0.01 / 2e9);
  EXPECT_DOUBLE_EQ(wear.depth_increment(4e7, 0.01, 500), 1e-4 * 4e7 * 0.01 / 1.5e9);
}

}  // namespace
}  // namespace solidus::contact
