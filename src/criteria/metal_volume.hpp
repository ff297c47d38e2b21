/// How much room a metal takes at a temperature: what feeding balances.
///
///   v = 1 + θ + φ,   θ = 3 α(Θ) (Θ − Θ_ref),   φ = Σ_k ΔV_k f_k(Θ)
///
/// v [-] volume over that of the melt at Θ_ref; α [1/K] the mean linear coefficient of thermal expansion from
/// Θ_ref [K] on; ΔV_k [-] the change of volume of the change of phase k on cooling, f_k [-] its fraction. The
/// volumetric strain of the mechanical phase, free of stress (monograph 2.51, 2.75). A step from v_1 to v_2
/// at constant room takes up v_1/v_2 − 1 of it: (ρ_s − ρ_l)/ρ_l where metal freezes.
#pragma once

#include "material/material.hpp"

namespace solidus::criteria {

struct VolumeParts {
  double thermal = 0, phase = 0;  ///< θ, φ
  double total() const { return 1 + thermal + phase; }
};

class MetalVolume {
 public:
  /// @param material  with a solidification; must outlive this
  explicit MetalVolume(const material::Material& material);

  /// Whether the volume changes at all between melt and solid or with temperature.
  bool changes() const;
  /// @param plateau_share  heat::ThermalPhase::plateau_share; 1 where there is none
  VolumeParts at(double temperature, double plateau_share) const;
  /// Where the last melt has just frozen.
  VolumeParts solid() const { return solid_; }
  /// The share of the metal around a node that moves with the melt, by its solid fraction: one below
  /// coherency and zero from there on. Where a change at one temperature passes coherency (pure metals,
  /// eutectics), conduction makes a front of it: metal is either before it or solid, and the share falls in
  /// proportion from the one to the other.
  double mobile_share(double solid_fraction) const {
    if (solid_fraction <= mobile_to_) return 1;
    if (solid_fraction >= held_from_) return 0;
    return (held_from_ - solid_fraction) / (held_from_ - mobile_to_);
  }

 private:
  const material::Material* material_;
  double mobile_to_, held_from_;  ///< solid fractions
  VolumeParts solid_{};
};

}  // namespace solidus::criteria
