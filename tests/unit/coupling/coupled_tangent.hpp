/// The tangent of both fields against differences of both residuals.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "algebra/parallel.hpp"
#include "coupling/coupled_newton.hpp"

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
  return std::sqrt(algebra::global_sum(s));
}

template <class Of>
struct OfBoth {
  Of force, heat;
};

/// A d on owned nodes [N], [W]; no force where the displacement is prescribed, as in the residual.
inline OfBoth<std::vector<double>> product(algebra::CoupledMatrix& a, std::span<const double> du,
                                           std::span<const double> dt, std::size_t n_owned) {
  std::vector<double> force(n_owned * static_cast<std::size_t>(a.components())), heat(n_owned),
      part(force.size());
  a.displacement().multiply(du, force);
  a.multiply_force(dt, part);
  const std::vector<char>& fixed = a.displacement().fixed();
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = fixed[i] ? 0 : force[i] + part[i];
  a.temperature().multiply(dt, heat);
  part.resize(n_owned);
  a.multiply_heat(du, part);
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] += part[i];
  return {std::move(force), std::move(heat)};
}

/// ‖A d − differences of the residuals over ±h d‖ / ‖A d‖; zero where neither changes.
/// @param a   the tangent at `u` and the temperature of newton.thermal(), which stays
/// @param du  [local node][component] [m]
/// @param dt  [local node] [K]
inline OfBoth<double> tangent_errors(coupling::CoupledNewton& newton, algebra::CoupledMatrix& a,
                                     const mechanics::MechanicalState& old,
                                     const mechanics::MechanicalPass& pass, const std::vector<double>& u,
                                     std::span<const double> du, std::vector<double> dt, double h) {
  const std::size_t n_owned = newton.force().size() / static_cast<std::size_t>(a.components());
  const OfBoth<std::vector<double>> expected = product(a, du, dt, n_owned);
  OfBoth<std::vector<double>> error = expected;
  heat::ThermalIteration& thermal = newton.thermal();
  thermal.set_direction(dt, {});
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> x = u;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += sign * h * du[i];
    thermal.move(sign * h);
    newton.evaluate(old, pass, x);
    for (std::size_t i = 0; i < error.force.size(); ++i) error.force[i] -= sign * newton.force()[i] / (2 * h);
    for (std::size_t i = 0; i < error.heat.size(); ++i)
      error.heat[i] -= sign * thermal.residual()[i] / (2 * h);
  }
  thermal.move(0);
  newton.evaluate(old, pass, u);
  const auto relative = [](double left, double of) { return left == 0 ? 0 : left / of; };
  return {relative(global_norm(error.force), global_norm(expected.force)),
          relative(global_norm(error.heat), global_norm(expected.heat))};
}

}  // namespace solidus::test
