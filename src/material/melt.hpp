/// The stiffness of a melt whose viscosity is not given: the numerical choice of η in s = η ε̇ (2.83, 2.104).
///
/// The viscosity of molten metal, some 1e-3 Pa s, has no effect on stress, so η is a number of the method and
/// not of the metal. What counts is the modulus that the melt has in a step, 2Ĝ = η/Δt, times the strain
/// increment of the step, Δε ≈ 1e-3 to 1e-2 where a skin follows its wall. It has to be small against the
/// pressure that carries the melt and against the strength of the later solid, and not so small that rounding
/// prevails:
///
///   2Ĝ = max(min(k_heads p, k_of_strength σ_s), k_least_melt_share k),    η = 2Ĝ Δt
///
/// p    [Pa] the metallostatic head ρ g H of the body, H its extent along gravity; without gravity the
///      atmosphere, which holds a melt on its wall (contact/normal.hpp)
/// σ_s  [Pa] what the shell stands: its yield stress at the solidus, or without plasticity G times
/// k_shell_strain k    [Pa] the bulk modulus at the liquidus
///
/// η follows the step, so a melt is as stiff in a short step as in a long one, and its stress goes to zero
/// with the strain increments. Measured in docs/decisions/0011-melt.md.
#pragma once

#include <string>

#include "material/material.hpp"

namespace solidus::material {

/// 2Ĝ in heads: a strain increment of 1e-2 then costs a tenth of the head.
inline constexpr double k_melt_heads = 10;
/// 2Ĝ in yield stresses of the shell: a strain increment of 1e-2 then costs a hundredth of it.
inline constexpr double k_melt_strengths = 1;
/// Strength of an elastic shell, as a share of its shear modulus.
inline constexpr double k_shell_strain = 1e-3;
/// 2Ĝ as a share of the bulk modulus: less gains nothing.
inline constexpr double k_least_melt_share = 1e-7;
/// The pressure of the atmosphere at sea level [Pa].
inline constexpr double k_atmosphere = 101325;

/// Modulus of a melt, with the quantity that it was chosen in proportion to.
struct MeltModulus {
  enum class Bound { head, atmosphere, strength, arithmetic };
  double modulus = 0;    ///< 2Ĝ of a step [Pa]; zero: the material gives its viscosity, or has no melt
  double reference = 0;  ///< the head, the atmosphere, σ_s or k, whichever decides [Pa]
  Bound bound = Bound::head;
  double extent = 0;  ///< H [m]; zero without gravity
};

/// Zero unless the material chooses_viscosity().
/// @param gravity  its magnitude [m/s²]
/// @param extent   of the body along gravity [m]
MeltModulus melt_modulus(const Material& material, double gravity, double extent);
/// "10 times the metallostatic head of 2.4e+03 Pa (rho g H, H = 0.1 m)".
std::string measured_against(const MeltModulus& melt);

}  // namespace solidus::material
