/// One implicit step of conduction with the error as its source, by conjugate gradients with the diagonal.
#include "heat/iteration/heat_spread.hpp"

#include <cmath>

#include "numbers/index_casts.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_accuracy = 1e-2;  ///< of the residual over the right-hand side
constexpr int k_max_iterations = 200;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

}  // namespace

/// [owned node] [J/K]
std::vector<double> HeatSpread::capacities(std::span<const double> temperature) const {
  std::vector<double> capacity(as_size(storage_.n_nodes()));
  for (std::size_t i = 0; i < capacity.size(); ++i)
    capacity[i] = storage_.sum(as_index(i), [&](const material::Material& m) {
      return m.density * m.specific_heat.value(temperature[i]);
    });
  return capacity;
}

std::vector<double> HeatSpread::at_once(std::span<const double> heat,
                                        std::span<const double> temperature) const {
  const std::vector<double> capacity = capacities(temperature);
  std::vector<double> result(temperature.size());
  for (std::size_t i = 0; i < capacity.size(); ++i) result[i] = capacity[i] > 0 ? heat[i] / capacity[i] : 0.0;
  ghosts_.update(result, 1);
  return result;
}

// Conjugate gradients in the unknown c δ of the system's symmetric matrix, scaled by the diagonal: the matrix
// is diagonally strong for such a τ, and few digits are asked for.
std::vector<double> HeatSpread::operator()(std::span<const double> heat, std::span<const double> temperature,
                                           double dt) {
  const profile::Part part("error estimate");
  const std::vector<double> capacity = capacities(temperature);
  const std::size_t n = capacity.size();
  const NodalPotential& potential = system_.parts().elements.nodal();
  std::vector<double> slope(temperature.size(), 1.0);
  // c = dv/dΘ: in the potential v the matrix of conduction is symmetric.
  if (!potential.identity()) {
    for (std::size_t i = 0; i < n; ++i) slope[i] = potential.slope(as_index(i), temperature[i]);
    ghosts_.update(slope, 1);
  }
  system_.assemble_symmetric(temperature, slope);
  linear::BlockMatrix& a = system_.matrix();
  std::vector<double> inverse(n), r(n), x(n, 0.0), product(n), z(n), direction(temperature.size(), 0.0);
  // The diagonal gets the capacity over τ; nodes without an equation are kept out by a zero.
  for (std::size_t i = 0; i < n; ++i) {
    double& diagonal = *a.diagonal_block(as_index(i));
    diagonal += capacity[i] / (dt * slope[i]);
    const bool free = system_.parts().prescribed.fixed()[i] == 0 && diagonal > 0;
    inverse[i] = free ? 1.0 / diagonal : 0.0;  // zero keeps a node out
    r[i] = free ? heat[i] / dt : 0.0;
    z[i] = inverse[i] * r[i];
    direction[i] = z[i];
  }
  // Conjugate gradients until the norm in the preconditioner has fallen by k_accuracy.
  double rho = dot(r, z);
  const double enough = k_accuracy * k_accuracy * rho;
  for (int iteration = 0; iteration < k_max_iterations && rho > enough; ++iteration) {
    ghosts_.update(direction, 1);
    a.multiply(direction, product);
    const double curvature = dot(std::span<const double>(direction).first(n), product);
    if (!(curvature > 0)) break;  // a contribution bends the other way: what there is will do
    const double alpha = rho / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * direction[i];
      if (inverse[i] > 0) r[i] -= alpha * product[i];
      z[i] = inverse[i] * r[i];
    }
    const double next = dot(r, z), beta = next / rho;
    rho = next;
    for (std::size_t i = 0; i < n; ++i) direction[i] = z[i] + beta * direction[i];
  }
  // Back from c δ to δ.
  std::vector<double> result(temperature.size());
  for (std::size_t i = 0; i < n; ++i) result[i] = x[i] / slope[i];
  ghosts_.update(result, 1);
  return result;
}

}  // namespace solidus::heat
