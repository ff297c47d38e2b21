/// A material in which everything varies with temperature, and exact derivatives, for the tests of
/// thermodynamics.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flow_cases.hpp"

namespace solidus::material::test {

/// flow_material with every table varying: nothing cancels by accident. A solid change at 700–760 K.
inline Material varying_material(const FlowCase& c) {
  Material m = flow_material(c);
  m.specific_heat = Table({300, 800, 1100}, {500, 700, 650});
  m.young_modulus = Table({300, 600, 950}, {200e9, 160e9, 80e9});
  m.poisson_ratio = Table({300, 950}, {0.28, 0.4});
  m.expansion = Table({300, 950}, {1.1e-5, 1.6e-5});
  m.liquid_viscosity = Table({800, 1000}, {2 * c.liquid_viscosity, c.liquid_viscosity});
  m.phase_changes.push_back({"transformation", PhaseFraction::linear(700, 760), 2e4, 0.01, false});
  Flow& f = *m.flow;
  const auto falls = [](double cold, double hot) { return Table({300, 1000}, {cold, hot}); };
  set_hardening(f, {{"hardening_modulus", falls(2e9, 0.5e9)},
                    {"saturation_stress", Table({300, 900}, {220e6, 100e6})},
                    {"saturation_rate", falls(40, 70)},
                    {"reference_strain", falls(1e-3, 2e-3)},
                    {"hardening_exponent", falls(0.25, 0.15)}});
  if (c.kinematic != KinematicHardening::none) f.kinematic_modulus = falls(6e9, 2e9);
  if (c.kinematic == KinematicHardening::armstrong_frederick) f.recall[0] = falls(80, 150);
  f.rate[Perzyna::viscosity] = falls(c.viscosity, 0.3 * c.viscosity);
  if (c.exponent != 1) f.rate[Perzyna::exponent] = falls(c.exponent, 0.7 * c.exponent + 0.3);
  f.rate[Perzyna::drag_stress] = falls(60e6, 20e6);
  f.flow_stress = falls(120e6, 50e6);
  if (c.heat_share) f.heat_share = falls(*c.heat_share, 0.5 * *c.heat_share);
  return m;
}

/// Solid, within the solid change, mushy, liquid.
inline constexpr double k_phases[] = {420, 650, 730, 885, 905, 928, 945};
inline constexpr double k_start_temperature = 943.15;  ///< Θ_0

/// A number with its gradient and Hessian in n variables.
template <std::size_t n>
struct Second {
  double v = 0;
  std::array<double, n> g{};
  std::array<std::array<double, n>, n> h{};

  Second() = default;
  Second(double value) : v(value) {}  // NOLINT: a constant
  static Second variable(double value, std::size_t i) {
    Second r(value);
    r.g[i] = 1;
    return r;
  }
  double value() const { return v; }

  /// f(a, b) from its partial derivatives.
  static Second compose(const Second& a, const Second& b, double f, double fa, double fb, double faa,
                        double fab, double fbb) {
    Second r(f);
    for (std::size_t i = 0; i < n; ++i) {
      r.g[i] = fa * a.g[i] + fb * b.g[i];
      for (std::size_t j = 0; j < n; ++j)
        r.h[i][j] = fa * a.h[i][j] + fb * b.h[i][j] + faa * a.g[i] * a.g[j] + fbb * b.g[i] * b.g[j] +
                    fab * (a.g[i] * b.g[j] + a.g[j] * b.g[i]);
    }
    return r;
  }
  static Second chain(const Second& a, double f, double f1, double f2) {
    return compose(a, a, f, f1, 0, f2, 0, 0);
  }
  Second& operator+=(const Second& b) { return *this = *this + b; }
  Second& operator-=(const Second& b) { return *this = *this - b; }
  Second& operator*=(const Second& b) { return *this = *this * b; }
  friend Second operator+(const Second& a, const Second& b) {
    return compose(a, b, a.v + b.v, 1, 1, 0, 0, 0);
  }
  friend Second operator-(const Second& a, const Second& b) {
    return compose(a, b, a.v - b.v, 1, -1, 0, 0, 0);
  }
  friend Second operator-(const Second& a) { return chain(a, -a.v, -1, 0); }
  friend Second operator*(const Second& a, const Second& b) {
    return compose(a, b, a.v * b.v, b.v, a.v, 0, 1, 0);
  }
  friend Second operator/(const Second& a, const Second& b) {
    const double i = 1 / b.v;
    return compose(a, b, a.v * i, i, -a.v * i * i, 0, -i * i, 2 * a.v * i * i * i);
  }
  friend bool operator<(const Second& a, const Second& b) { return a.v < b.v; }
  friend bool operator>(const Second& a, const Second& b) { return a.v > b.v; }
  friend Second exp(const Second& a) { return chain(a, std::exp(a.v), std::exp(a.v), std::exp(a.v)); }
  friend Second log(const Second& a) { return chain(a, std::log(a.v), 1 / a.v, -1 / (a.v * a.v)); }
};

}  // namespace solidus::material::test
