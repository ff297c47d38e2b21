/// The stress with which melt and mush resist compaction, in a block with one point an element, eight
/// elements at a time.
///
/// Melt and the network of dendrites have a bulk viscosity ζ, taken to be the shear viscosity η of the step
/// (material/melt.hpp). Once the network is coherent its dendrites contract with the temperature as solid
/// metal does, whether melt can follow or not, and what is resisted is the rest:
///
///   σ_ζ = ζ/Δt [ Δ(div u) − ψ Δe^s ],   ψ = ⟨(f̄_Θ − f_c)/(1 − f_c)⟩,   Δe^s = Δe^θ − (ΔV/V) Δf_S
///
/// with f̄_Θ the mean fraction over the temperatures of the step (phase_fields.hpp), f_c the coherency
/// fraction and e^θ the volumetric thermal strain, whose part of freezing is that of melt which becomes solid
/// in place: it moves no dendrite. Metal that completes its freezing at one temperature within the step does
/// all of its contraction as a solid, f̄_Θ = 1 although it is mush in the step (f̄_S < 1): in place of ζ/Δt it
/// has its bulk modulus. The share ψ of the contraction of the solid that the network takes part in, and that
/// it rises from coherency to one, is the model of Stangeland, Mo, Nielsen, Eskin and M'Hamdi (Metall. Mater.
/// Trans. A 35 (2004) 2903); the straight line is ours. All of σ_ζ Δ(div u) becomes heat.
#pragma once

#include <cstddef>

#include "material/material.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// The network of dendrites of an element in a step.
struct Network {
  Lane contracting;         ///< f̄_Θ
  Lane stiffness;           ///< ζ/Δt [Pa]; zero in solid metal
  Lane divergence;          ///< div u at t_n
  Lane old_thermal_strain;  ///< e^θ that the step before has ended with
  Lane thermal_strain;      ///< that of this step
  Lane freezing;            ///< (ΔV/V) Δf_S
};

class Compaction {
 public:
  /// @param acts  whether melt flows between dendrites (liquid_flow.hpp); if not there is no such stress
  Compaction(const material::Material& material, bool acts, Index n_batches)
      : coherency_(material.casting.coherency_fraction) {
    if (!acts) return;
    for (PackVector<Lane>* values : {&stiffness_, &share_, &rest_, &thermal_strain_})
      values->resize(as_size(n_batches), Lane(0.0));
  }

  void begin_step(Index batch, const Network& network) {
    const std::size_t i = at(batch);
    const Lane above = (network.contracting - Lane(coherency_)) / Lane(1 - coherency_);
    const Lane contraction = network.thermal_strain - network.old_thermal_strain - network.freezing;
    stiffness_[i] = network.stiffness;
    share_[i] = max(Lane(0.0), min(Lane(1.0), above));
    rest_[i] = network.divergence + share_[i] * contraction;
    thermal_strain_[i] = network.thermal_strain;
  }
  /// ζ/Δt [Pa].
  Lane stiffness(Index batch) const { return stiffness_.empty() ? Lane(0.0) : stiffness_[at(batch)]; }
  /// ψ ζ/Δt: how σ_ζ falls with e^θ [Pa].
  Lane by_expansion(Index batch) const {
    return stiffness_.empty() ? Lane(0.0) : stiffness_[at(batch)] * share_[at(batch)];
  }
  /// σ_ζ [Pa].
  Lane stress(Index batch, const Lane& divergence) const {
    return stiffness_.empty() ? Lane(0.0) : stiffness_[at(batch)] * (divergence - rest_[at(batch)]);
  }
  /// e^θ of the step, which the next one sets out from.
  Lane thermal_strain(Index batch) const { return thermal_strain_[at(batch)]; }

  std::size_t bytes() const { return 4 * stiffness_.capacity() * sizeof(Lane); }

 private:
  static std::size_t at(Index batch) { return as_size(batch); }

  double coherency_;            ///< f_c
  PackVector<Lane> stiffness_;  ///< ζ/Δt, [batch]; empty where no melt flows, as those below
  PackVector<Lane> share_;      ///< ψ
  PackVector<Lane> rest_;       ///< div u of no stress
  PackVector<Lane> thermal_strain_;
};

}  // namespace solidus::mechanics
