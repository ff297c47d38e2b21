#include "heat/loads/shot_sleeve.hpp"

#include <cmath>
#include <numbers>

namespace solidus::heat {

double pool_angle(double filling) {
  // φ − sin φ rises: bisection.
  double low = 0, high = 2 * std::numbers::pi;
  constexpr int k_halvings = 60;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (middle - std::sin(middle) < 2 * std::numbers::pi * filling ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double wall_per_volume(const ShotSleeve& sleeve) {
  // The wetted arc over the section of the pool, and the face of the plunger.
  const double angle = pool_angle(sleeve.filling), d = sleeve.diameter;
  const double section = d * d / 8 * (angle - std::sin(angle));
  return d * angle / 2 / section + 1 / sleeve.length;
}

double temperature_after(const ShotSleeve& sleeve, const material::EnthalpyCurve& curve, double temperature) {
  // Runge and Kutta's method of fourth order for the enthalpy, of which the temperature is a function also
  // where metal freezes.
  constexpr int k_steps = 2000;
  const double rate = sleeve.coefficient * wall_per_volume(sleeve), dt = sleeve.time / k_steps;
  const auto slope = [&](double h) { return -rate * (curve.temperature(h) - sleeve.wall); };
  double h = curve.upper(temperature);
  for (int i = 0; i < k_steps; ++i) {
    const double a = slope(h), b = slope(h + 0.5 * dt * a), c = slope(h + 0.5 * dt * b),
                 d = slope(h + dt * c);
    h += dt / 6 * (a + 2 * b + 2 * c + d);
  }
  return curve.temperature(h);
}

}  // namespace solidus::heat
