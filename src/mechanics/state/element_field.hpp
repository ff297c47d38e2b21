/// Fields of elements for results.
#pragma once

namespace solidus::mechanics {

/// An average over each element; symmetric tensors have six components in the order xx, yy, zz, xy, yz, xz
/// (axisymmetric: rr, axial, hoop, r-axial). What a law does not know is zero.
enum class ElementField {
  stress,  ///< [Pa]
  strain,
  viscous_strain,             ///< ε^v of the melt
  plastic_strain,             ///< ε^vp
  back_stress,                ///< q, centre of the yield surface [Pa]
  equivalent_plastic_strain,  ///< ξ
  flow_stress,                ///< σ_0 + K_ξ, the von Mises stress (less back stress) of slow flow [Pa]
  dissipation,                ///< D_mech [W/m³]
  thermal_dissipation,        ///< D_ther = Θ Ṡ^I (2.120) [W/m³]
  inelastic_entropy,          ///< S^I (4.43b) [J/(m³ K)]
  von_mises,                  ///< of the average stress [Pa]
  pressure,                   ///< −tr σ/3 [Pa], positive in compression
  intermediate_temperature,   ///< Θ̄ of the isentropic mapping [K]
  pore_fraction               ///< θ, the volume of pores per volume of the casting (pores.hpp)
};

/// 6 or 1.
constexpr int component_count(ElementField field) {
  switch (field) {
    case ElementField::stress:
    case ElementField::strain:
    case ElementField::viscous_strain:
    case ElementField::plastic_strain:
    case ElementField::back_stress:
      return 6;
    default:
      return 1;
  }
}

}  // namespace solidus::mechanics
