/// The tangent of both fields against differences of both residuals.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "coupling/coupled_newton.hpp"
#include "parallel/parallel.hpp"

namespace solidus::test {

/// Numbers between −1 and 1 that every process computes alike, [local node][component].
inline std::vector<double> noise(const mesh::Mesh& mesh, int components, double seed, double size = 1) {
  std::vector<double> values;
  for (const GlobalIndex node : mesh.input_node)
    for (int i = 0; i < components; ++i)
      values.push_back(size * std::sin(seed * static_cast<double>(node * components + i + 1)));
  return values;
}

inline double global_norm(std::span<const double> a) {
  double s = 0;
  for (const double x : a) s += x * x;
  return std::sqrt(parallel::global_sum(s));
}

/// A number for forces, one for heat, and one for the volumes of mixed elements where there are any.
template <class Of>
struct OfAll {
  Of force{}, heat{}, volume{};
};

/// ‖A d − differences of the residuals over ±h d‖ / ‖A d‖; zero where neither changes.
/// @param u   unknowns of the mechanical phase; the tangent is the one of there and of the temperature of
///            newton.thermal(), which stays
/// @param du  a change of them
/// @param dt  [local node] [K]
inline OfAll<double> tangent_errors(coupling::CoupledNewton& newton, linear::CoupledMatrix& a,
                                    const mechanics::MechanicalState& old,
                                    const mechanics::MechanicalPass& pass, const std::vector<double>& u,
                                    std::span<const double> du, std::vector<double> dt, double h) {
  heat::ThermalEquations& thermal = newton.thermal().equations();
  std::vector<double> force(newton.force().size()), heat(thermal.residual().size());
  const std::size_t n_forces = heat.size() * static_cast<std::size_t>(a.components());
  newton.multiply(du, dt, force, heat);
  const std::vector<char>& fixed = a.displacement().fixed();
  for (std::size_t i = 0; i < n_forces; ++i)
    if (fixed[i]) force[i] = 0;  // as in the residual
  const auto norms = [&](std::span<const double> f) {
    return OfAll<double>{global_norm(f.first(n_forces)), global_norm(heat), global_norm(f.subspan(n_forces))};
  };
  const OfAll<double> expected = norms(force);
  thermal.set_direction(dt, {});
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> x = u;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += sign * h * du[i];
    thermal.move(sign * h);
    newton.evaluate(old, pass, x);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] -= sign * newton.force()[i] / (2 * h);
    for (std::size_t i = 0; i < heat.size(); ++i) heat[i] -= sign * thermal.residual()[i] / (2 * h);
  }
  thermal.move(0);
  newton.evaluate(old, pass, u);
  const OfAll<double> error = norms(force);
  const auto relative = [](double left, double of) { return left == 0 ? 0 : left / of; };
  return {relative(error.force, expected.force), relative(error.heat, expected.heat),
          relative(error.volume, expected.volume)};
}

}  // namespace solidus::test
