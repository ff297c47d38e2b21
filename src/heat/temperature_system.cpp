#include "heat/temperature_system.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/parallel.hpp"

namespace solidus::heat {

TemperatureSystem::TemperatureSystem(const mesh::Mesh& mesh, HeatSystem& system,
                                     std::span<const std::unique_ptr<PointStorage>> points,
                                     bool exact_conductivity)
    : mesh_(mesh), system_(system), points_(points), exact_(exact_conductivity), local_(mesh.x.size()) {}

double TemperatureSystem::residual(std::span<const double> x, std::span<double> r) {
  x_.assign(x.begin(), x.end());
  double moved = system_.residual(x, r);
  if (storing_) {
    std::fill(local_.begin(), local_.end(), 0.0);
    for (const auto& block : points_) block->add_residual(x, local_);
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] += local_[i];
      moved += std::abs(local_[i]);
    }
  }
  for (std::size_t i = 0; i < r.size(); ++i)
    if (system_.fixed()[i]) moved += std::abs(r[i]);
  moved_ = 0.5 * algebra::global_sum(moved);
  return moved_ / std::sqrt(static_cast<double>(mesh_.n_global_nodes));
}

algebra::BlockMatrix& TemperatureSystem::tangent(bool exact_conductivity) {
  system_.assemble(x_, exact_conductivity);
  if (storing_)
    for (const auto& block : points_) block->add_tangent(x_, system_.matrix());
  return system_.matrix();
}

double TemperatureSystem::round_off() const {
  double sum = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double part = *system_.matrix().diagonal_block(i) * x_[static_cast<std::size_t>(i)];
    sum += part * part;
  }
  constexpr double rounding = 2e-15;
  return rounding * std::sqrt(algebra::global_sum(sum));
}

}  // namespace solidus::heat
