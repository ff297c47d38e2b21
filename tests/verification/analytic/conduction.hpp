/// Closed forms of heat conduction without phase change.
#pragma once

#include <cmath>
#include <numbers>

namespace solidus::analytic {

/// Steady annulus, inner and outer radius at fixed temperatures:  T = T_i + (T_o − T_i)
/// ln(r/r_i)/ln(r_o/r_i).
struct Annulus {
  double inner, outer, inner_temperature, outer_temperature;
  double temperature(double r) const {
    return inner_temperature +
           (outer_temperature - inner_temperature) * std::log(r / inner) / std::log(outer / inner);
  }
  /// Heat through the whole circumference per length of axis, outwards positive [W/m].
  double heat(double conductivity) const {
    return 2 * std::numbers::pi * conductivity * (inner_temperature - outer_temperature) /
           std::log(outer / inner);
  }
};

/// Insulated slab 0 … l that starts as a cosine:  T = T_m + A cos(πx/l) e^{−λt},  λ = (π/l)² k/c.
struct CosineSlab {
  double length, mean, amplitude, diffusivity;
  double rate() const { return std::pow(std::numbers::pi / length, 2) * diffusivity; }
  double shape(double x) const { return std::cos(std::numbers::pi * x / length); }
  double temperature(double x, double time) const {
    return mean + amplitude * shape(x) * std::exp(-rate() * time);
  }
  /// The same with backward Euler in time and exact in space: the error of a mesh alone is measured against
  /// it.
  double stepped(double x, int steps, double dt) const {
    return mean + amplitude * shape(x) / std::pow(1 + rate() * dt, steps);
  }
};

/// Slab with faces at T_1, T_2 and k = k_0 (1 + b T): U = T + b T²/2 is linear in x (Kirchhoff 1894).
struct KirchhoffSlab {
  double length, cold, hot, k0, slope;
  double potential(double t) const { return t + 0.5 * slope * t * t; }
  double temperature(double x) const {
    const double u = potential(cold) + (potential(hot) - potential(cold)) * x / length;
    return slope == 0 ? u : (std::sqrt(1 + 2 * slope * u) - 1) / slope;
  }
  double flux() const {
    return k0 * (potential(hot) - potential(cold)) / length;
  }  ///< towards the cold face [W/m²]
};

/// A body of one temperature in surroundings, backward Euler steps: capacity C [J/K], area A.
/// Film: closed form. Radiation: each step's quartic by Newton's method in long double.
struct LumpedBody {
  double capacity, area, start, ambient;
  double film(double h, int steps, double dt) const {
    return ambient + (start - ambient) / std::pow(1 + h * area * dt / capacity, steps);
  }
  double radiation(double emissivity_sigma, int steps, double dt) const {
    const long double g = static_cast<long double>(emissivity_sigma) * area * dt / capacity;
    const long double a4 = std::pow(static_cast<long double>(ambient), 4);
    long double t = start;
    for (int i = 0; i < steps; ++i) {
      const long double old = t;
      for (int k = 0; k < 50; ++k) t -= (t - old + g * (t * t * t * t - a4)) / (1 + 4 * g * t * t * t);
    }
    return static_cast<double>(t);
  }
};

}  // namespace solidus::analytic
