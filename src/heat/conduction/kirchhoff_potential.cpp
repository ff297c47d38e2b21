/// The table's integral is stored at its points, so that value and inverse are one look-up and a quadratic
/// formula.
#include "heat/conduction/kirchhoff_potential.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

KirchhoffPotential::KirchhoffPotential(const Table& conductivity)
    : t_(conductivity.x().begin(), conductivity.x().end()),
      k_(conductivity.y().begin(), conductivity.y().end()),
      reference_(0.5 * (conductivity.min_value() + conductivity.max_value())) {
  if (constant()) return;
  const std::size_t last = t_.size() - 1;
  // Beyond the table the conductivity is constant, or goes on along the last piece where the user
  // says so.
  const bool linear = conductivity.extrapolation() == Extrapolation::linear;
  u_.push_back(0);
  slope_.push_back(0);
  // The integral of the conductivity, exact for a table that is linear between its points.
  for (std::size_t i = 0; i < last; ++i) {
    const double width = t_[i + 1] - t_[i];
    slope_.push_back((k_[i + 1] - k_[i]) / width);
    u_.push_back(u_[i] + 0.5 * width * (k_[i] + k_[i + 1]));
  }
  slope_.push_back(linear ? slope_[last] : 0);
  if (linear) slope_.front() = slope_[1];
}

/// Counts the points that are not above the temperature: slope_[piece] is the slope there.
std::size_t KirchhoffPotential::piece(double temperature) const {
  return as_size(std::upper_bound(t_.begin(), t_.end(), temperature) - t_.begin());
}

double KirchhoffPotential::conductivity(double temperature) const {
  if (constant()) return k_[0];
  const std::size_t i = piece(temperature), from = i > 0 ? i - 1 : 0;
  return k_[from] + slope_[i] * (temperature - t_[from]);
}

double KirchhoffPotential::value(double temperature) const {
  if (constant()) return k_[0] * temperature;
  const std::size_t i = piece(temperature), from = i > 0 ? i - 1 : 0;
  const double x = temperature - t_[from];
  return u_[from] + x * (k_[from] + 0.5 * slope_[i] * x);
}

double KirchhoffPotential::temperature(double value) const {
  if (constant()) return value / k_[0];
  const auto i = as_size(std::upper_bound(u_.begin(), u_.end(), value) - u_.begin());
  const std::size_t from = i > 0 ? i - 1 : 0;
  const double u = value - u_[from];
  // k x + k'/2 x² = u, in the form that does not cancel for small k'
  return t_[from] +
         2.0 * u / (k_[from] + std::sqrt(std::max(0.0, k_[from] * k_[from] + 2.0 * slope_[i] * u)));
}

}  // namespace solidus::heat
