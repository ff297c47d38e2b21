/// Shrinkage pores of the metal in mixed elements: volume that the casting has and its metal has not.
///
/// Metal that freezes where nothing feeds it is drawn into tension. In a pool a pore opens at a tension p_c
/// that is next to none, in mush where the pressure of the melt between the dendrites has dropped by ΔP_cr.
/// In mixed elements, where p is that pressure (positive in tension) and div u − e_v the volume that the
/// metal does not fill, the pore fraction is
///
///   θ(p) = (1 − θ_n) ⟨p − p_c⟩/M              below coherency,
///   θ(p) = θ_n + (1 − θ_n) ⟨p − ΔP_cr⟩/M_m     in mush,  M_m = k_pore_drops ΔP_cr,
///   θ = θ_n                                   in solid metal,
///
/// p_c being pore_tension of the material and k_least_pore_share M at least, ΔP_cr its
/// critical_pressure_drop, with f_S of t_n, and r_p = ∫ N (div u − e_v − θ) dV − S p. The law of the metal
/// sees e_v alone. Below coherency pores that are pressed or fed close; in mush a pore grows or stays. The
/// metal that is left, 1 − θ_n, is what a pore can still open in: an element that is nearly empty is stiff,
/// and its neighbours take over. The work of pores is counted with that of the sub-scales.
///
/// No element has more pores than k_most_pores: θ(p) ends there. Newton's method is not sent over this second
/// bend of the curve, from whose flat end it would leap across the first one and back. It solves with θ(p) as
/// above; elements that then have more than there is are full, θ = k_most_pores whatever the pressure, and it
/// goes on from there until no further one fills (fill_pores() of nodal_pressure.hpp). What a full element
/// cannot take raises the tension in it and around it, so that none of those that have filled leaves the
/// bound again: the result is that of the curve with both bends.
///
/// M = k_pore_share 2Ĝ of the melt, two heads of metal: a pool opens its pores in its upper part first, where
/// its pressure is least.
#pragma once

#include <algorithm>
#include <vector>

#include "material/material.hpp"
#include "material/melt.hpp"
#include "numbers/common_packs.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// M_m in pressure drops: pores of 1e-2 in a step cost another one.
inline constexpr double k_pore_drops = 100;
/// The most pores of an element.
inline constexpr double k_most_pores = 0.98;
/// M as a share of the modulus of the melt: two heads of metal.
inline constexpr double k_pore_share = 0.2;
/// p_c is at least this share of M, which a strain increment of as much costs in a melt: without it the
/// viscosity of the numerical melt alone would open pores.
inline constexpr double k_least_pore_share = 0.02;

/// The pores of a block with one point an element, eight elements at a time. None in a material that does not
/// melt, nor in one whose card gives the viscosity of its melt: pores would be of that viscosity.
class Pores {
 public:
  Pores(const material::Material& material, Index n_batches);

  /// @param solid_fraction  at t_n
  /// @param melt_modulus    StepStart::melt_modulus(), M [Pa]
  /// @param before          θ_n
  void begin_step(Index batch, const Lane& solid_fraction, double melt_modulus, const Lane& before) {
    if (held_.empty()) return;
    const LaneMask melt = solid_fraction < Lane(coherency_);
    const LaneMask solid = solid_fraction >= Lane(1.0);
    const Lane metal = Lane(1.0) - min(before, Lane(k_most_pores));
    const Lane modulus =
        select(melt, Lane(k_pore_share * melt_modulus), Lane(k_pore_drops * critical_pressure_drop_));
    const double in_pool = std::max(tension_, k_least_pore_share * melt_modulus);
    softness_[at(batch)] = select(solid, Lane(0.0), metal / modulus);
    threshold_[at(batch)] = select(melt, Lane(in_pool), Lane(std::max(in_pool, critical_pressure_drop_)));
    held_[at(batch)] = select(melt, Lane(0.0), before);
  }
  /// θ at a mean stress [Pa].
  Lane fraction(Index batch, const Lane& pressure) const {
    if (held_.empty()) return Lane(0.0);
    const Lane open =
        held_[at(batch)] + softness_[at(batch)] * max(pressure - threshold_[at(batch)], Lane(0.0));
    return select(full_[at(batch)] > Lane(0.0), Lane(k_most_pores), open);
  }
  /// dθ/dp [1/Pa].
  Lane compliance(Index batch, const Lane& pressure) const {
    if (held_.empty()) return Lane(0.0);
    const Lane open = select(pressure > threshold_[at(batch)], softness_[at(batch)], Lane(0.0));
    return select(full_[at(batch)] > Lane(0.0), Lane(0.0), open);
  }
  /// Begins with no full element: once a step, whose passes go on with those that have filled.
  void release() { std::fill(full_.begin(), full_.end(), Lane(0.0)); }
  /// Marks the elements that have more than k_most_pores at a mean stress as full; returns whether one is
  /// new.
  bool fill(Index batch, const Lane& pressure) {
    if (held_.empty()) return false;
    const LaneMask filled = fraction(batch, pressure) > Lane(k_most_pores);
    full_[at(batch)] = select(filled, Lane(1.0), full_[at(batch)]);
    return any(filled);
  }
  /// Whether the metal of the block can have pores.
  bool may_open() const { return !held_.empty(); }

  std::size_t bytes() const;

 private:
  static std::size_t at(Index batch) { return as_size(batch); }

  double tension_, critical_pressure_drop_, coherency_;  ///< p_c, ΔP_cr, f_c
  PackVector<Lane> softness_, threshold_,
      held_;               ///< dθ/dp, its threshold, and θ_n of what was coherent
  PackVector<Lane> full_;  ///< 1 in elements that are full, else 0
};

}  // namespace solidus::mechanics
