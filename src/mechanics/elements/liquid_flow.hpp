/// Melt that flows between the dendrites of a body of mixed elements and feeds what shrinks there.
///
/// In mush the displacement u is that of the network of dendrites. Melt moves through it by q, the volume
/// that has passed an area since the start [m], and a volume that melt has left or reached differs from that
/// of its metal by div q. With Darcy's law (material/permeability.hpp) over a step
///
///   r_p = ∫ N (div u − e_v − θ) − ∇N·q dV − S p = 0,   q = q_n + Δt K/μ (∇p + ρ g_0),
///
/// f_S in K of t_n, q constant in an element. p is the pressure of the melt between the dendrites (positive
/// in tension). Their network, and melt alone, resist compaction: the mean stress is p + σ_ζ
/// (mechanics/elements/compaction.hpp), and σ_ζ enters r_u. No
/// melt passes the surface of the body: the sum of r_p over its nodes, its volume, has no q. At rest ∇p = −ρ
/// g_0 and nothing flows. The term has the form of algebraic sub-scales with τ = Δt K/μ: symmetric, and its
/// work (∇p + ρ g_0)·Δq ≥ 0 is lost. The law of the metal and its heat stay with the element: what flows is a
/// few per cent of it.
#pragma once

#include <array>
#include <cstddef>

#include "material/material.hpp"
#include "material/permeability.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// The flow of a block with one point an element, eight elements at a time. None in a material without pores
/// (pores.hpp): pressures in it follow the viscosity that its card gives.
template <std::size_t dim>
class LiquidFlow {
 public:
  using Vector = std::array<Lane, dim>;

  LiquidFlow(const material::Material& material, Index n_batches)
      : flows_(material.chooses_viscosity() && material.casting.coherency_fraction < 1),
        permeability_(material.casting) {
    if (!flows_) return;
    mobility_.resize(as_size(n_batches), Lane(0.0));
    before_.resize(as_size(n_batches), Vector{});
  }

  /// Whether q is part of the history.
  bool flows() const { return flows_; }

  /// @param solid_fraction  at t_n
  /// @param before          q_n
  void begin_step(Index batch, const Lane& solid_fraction, double dt, const Vector& before) {
    mobility_[at(batch)] = Lane(dt) * permeability_.mobility(solid_fraction);
    before_[at(batch)] = before;
  }
  /// Δt K/μ [m²/Pa].
  Lane mobility(Index batch) const { return flows_ ? mobility_[at(batch)] : Lane(0.0); }
  /// q where the pressure is out of balance with the body force by ∇p + ρ g_0 [Pa/m].
  Vector total(Index batch, const Vector& drive) const {
    Vector q{};
    if (flows_)
      for (std::size_t i = 0; i < dim; ++i) q[i] = before_[at(batch)][i] + mobility_[at(batch)] * drive[i];
    return q;
  }

  std::size_t bytes() const {
    return mobility_.capacity() * sizeof(Lane) + before_.capacity() * sizeof(Vector);
  }

 private:
  static std::size_t at(Index batch) { return as_size(batch); }

  bool flows_;
  material::Permeability permeability_;
  PackVector<Lane> mobility_;  ///< Δt K/μ
  PackVector<Vector> before_;  ///< q_n
};

}  // namespace solidus::mechanics
