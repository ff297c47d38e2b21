/// Derivatives of the heat through contact with respect to the displacement.
#pragma once

#include <functional>
#include <span>

#include "contact/heat/heat_points.hpp"
#include "contact/heat/heat_term.hpp"
#include "contact/points/slot_cache.hpp"
#include "linear/coupled_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::contact {

/// Derivatives of the motion of a point with respect to the displacements of its nodes.
struct HeatRates {
  std::span<const Point> penetration;  ///< ∂g_N/∂x_b
  std::span<const Point> trial;        ///< ∂‖T^trial‖/∂x_b [Pa/m]; empty: zero
  std::span<const Point> share;        ///< ∂B_a/∂x_b, [a][b]
  std::span<const Point> weight;       ///< ∂w/∂x_b [m]; empty: zero
};

class HeatCoupling {
 public:
  /// Keeps references to the points and to their term.
  HeatCoupling(const mesh::Mesh& mesh, const HeatPoints& points, const HeatTerm& term)
      : n_owned_(mesh.n_owned_nodes), points_(points), term_(term) {}
  /// Adds ∂r/∂u: through the conductance, through the heat of friction where slip answers Θ_c (joint), and
  /// with the partner that moves on.
  /// @param rates  of a point that has a partner; valid until the next call
  void add(const std::function<HeatRates(Index point)>& rates, std::span<const double> temperature,
           linear::CoupledMatrix& matrix);

 private:
  void bind(const linear::BlockMatrix& displacement);

  Index n_owned_;
  const HeatPoints& points_;
  const HeatTerm& term_;
  SlotCache slots_;
  const linear::BlockMatrix* displacement_ = nullptr;  ///< that slots_ know
  int bindings_ = 0;  ///< of the term, whose pattern changes with that of the displacement
};

}  // namespace solidus::contact
