/// Heat that metal loses in the sleeve of a cold chamber machine before it is in the die.
///
/// The metal lies as a pool of one temperature in a horizontal cylinder of diameter D and loses heat to its
/// wall (lumped capacity, e.g. F. P. Incropera et al., Fundamentals of Heat and Mass Transfer, section 5.1):
///
///   dh/dt = −α (A/V) (Θ − Θ_w),   A/V = (D φ/2)/S + 1/L,   S = D²/8 (φ − sin φ),   filling = (φ − sin
///   φ)/(2π)
///
/// h(Θ) enthalpy per volume with the latent heat, φ angle of the pool's cross-section S, L its length; the
/// plunger's face is a wall as well. With a constant heat capacity c and above the liquidus
///
///   Θ = Θ_w + (Θ_0 − Θ_w) exp(−α (A/V) t/(ρ c)).
///
/// Validity: metal that is mixed, a wall that keeps its temperature: an upper bound of the loss at the given
/// α. The free surface loses nothing.
#pragma once

#include "material/enthalpy.hpp"

namespace solidus::heat {

struct ShotSleeve {
  double diameter = 0, length = 0;  ///< D, L [m]
  double filling = 0;               ///< share of the cross-section, up to one
  double time = 0;                  ///< [s]
  double wall = 0;                  ///< Θ_w [K]
  double coefficient = 0;           ///< α [W/(m² K)]
};

/// The angle φ of a pool that fills this share of a circle, 0 to 2π.
double pool_angle(double filling);
/// A/V of the pool [1/m].
double wall_per_volume(const ShotSleeve& sleeve);
/// The temperature of metal that enters the sleeve with `temperature` when it leaves it [K].
double temperature_after(const ShotSleeve& sleeve, const material::EnthalpyCurve& curve, double temperature);

}  // namespace solidus::heat
