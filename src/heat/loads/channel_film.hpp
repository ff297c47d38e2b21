/// Heat transfer in a round tube by its Nusselt number, Nu = h d/k.
///
///   laminar        Re ≤ 2300: 3.66 (wall of one temperature), 4.36 (wall of one heat flux)
///   Dittus–Boelter Re ≥ 10 000: Nu = 0.023 Re^0.8 Pr^n, n = 0.4 for a fluid that is heated, 0.3 for one that
///                  is cooled (W. H. McAdams, Heat Transmission, 1942; F. W. Dittus, L. M. K. Boelter, 1930)
///   Gnielinski     Re ≥ 4000: Nu = (ζ/8)(Re − 1000) Pr/(1 + 12.7 √(ζ/8) (Pr^(2/3) − 1)), with Petukhov's
///                  friction ζ = (0.79 ln Re − 1.64)^−2 (V. Gnielinski, Int. Chem. Eng. 16, 1976; B. S.
///                  Petukhov, Adv. Heat Transfer 6, 1970)
///
/// Between 2300 and the lower limit of a law, Nu goes on a straight line from the laminar value to the law's
/// at that limit (V. Gnielinski, Int. J. Heat Mass Transfer 63, 2013, for the limit of 4000). Fully developed
/// flow in a smooth tube: no entrance length, no bends, no boiling.
#pragma once

namespace solidus::heat {

enum class ChannelLaw { dittus_boelter, gnielinski };

/// Where laminar flow ends.
inline constexpr double k_laminar_reynolds = 2300;

/// @param laminar  Nu of laminar flow
/// @param heated   whether the wall is hotter than the fluid
double nusselt(ChannelLaw law, double laminar, double reynolds, double prandtl, bool heated);

/// Re = 4 ṁ/(π d μ) of a mass flow [kg/s].
double reynolds_number(double mass_flow, double diameter, double viscosity);

}  // namespace solidus::heat
