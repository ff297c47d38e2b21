/// Kirchhoff's transform of the conductivity of one material.
///
///   u(Θ) = ∫ k dΘ [W/m],   k ∇Θ = ∇u
///
/// The table of k is piecewise linear, so u is piecewise quadratic; u and its inverse are closed forms. A
/// constant conductivity gives u = k Θ; otherwise u is zero at the first point of the table. Outside its
/// points the conductivity continues as the table does.
///
/// Carslaw and Jaeger, Conduction of Heat in Solids (1959), 1.6.
#pragma once

#include <span>
#include <vector>

#include "numbers/table.hpp"

namespace solidus::heat {

class KirchhoffPotential {
 public:
  explicit KirchhoffPotential(const Table& conductivity);

  bool constant() const { return k_.size() == 1; }
  /// The temperatures where k bends [K]; one, without meaning, where it is constant.
  std::span<const double> points() const { return t_; }
  /// A conductivity that the material has somewhere: the mean of its extremes [W/(m K)].
  double reference() const { return reference_; }
  double value(double temperature) const;         ///< u [W/m]
  double conductivity(double temperature) const;  ///< k = du/dΘ [W/(m K)]
  /// Θ(u) [K], the inverse of value() where the conductivity is positive.
  double temperature(double value) const;

 private:
  /// The linear piece of k that holds a temperature; the first and last one continue.
  std::size_t piece(double temperature) const;

  std::vector<double> t_, k_, u_;  ///< points of the table, and u there
  std::vector<double> slope_;      ///< dk/dΘ left of the first point, between the points, right of the last
  double reference_ = 0;
};

}  // namespace solidus::heat
