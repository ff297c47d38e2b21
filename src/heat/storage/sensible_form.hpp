/// Sensible heat as the monograph prints it, in place of a difference of enthalpies.
///
///   enthalpy     h_1 − h_n = ∫ C_v dΘ
///   entropy      Θ_1 (s_1 − s_n) = Θ_1 ∫ C_v/Θ dΘ             (4.43a, 4.48a)
///   temperature  C_v(Θ_1) (Θ_1 − Θ_n)                          (4.53a)
///
/// The printed forms are no differences of a function of state: what they are more than the first,
/// C_v ΔΘ²/2Θ and C_v,Θ ΔΘ²/2 to leading order, is heat that disappears.
#pragma once

#include "material/material.hpp"

namespace solidus::heat {

enum class SensibleForm { enthalpy, entropy, temperature };

/// Excess of a printed form over the difference of enthalpies, and its derivative with respect to the
/// temperature at the end.
struct PrintedExcess {
  double heat = 0;   ///< [J/m³]
  double slope = 0;  ///< [J/(m³ K)]
};

/// @param from, to  Θ_n, Θ_1 [K]; not a number below zero in the entropy form
PrintedExcess printed_excess(const material::Material& material, SensibleForm form, double from, double to);

}  // namespace solidus::heat
