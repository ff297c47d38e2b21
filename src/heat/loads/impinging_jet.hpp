/// Heat transfer of a round jet that hits a wall perpendicularly, mean over a circle of radius r (H. Martin,
/// Adv. Heat Transfer 13 (1977) 1):
///
///   Nu/Pr^0.42 = 2 √A (1 − 2.2 √A)/(1 + 0.2 (H/D − 6) √A) · 2 √Re (1 + 0.005 Re^0.55)^(1/2)
///   A = D²/(4 r²),  Nu = h D/k,  Re = 4 V̇ ρ/(π D μ)
///
/// D nozzle, H its distance. Valid for 2000 ≤ Re ≤ 400 000, 2 ≤ H/D ≤ 12, 0.004 ≤ A ≤ 0.04, and a jet in its
/// own fluid (a bubbler); no boiling.
#pragma once

#include "heat/loads/channel_fluid.hpp"

namespace solidus::heat {

struct ImpingingJet {
  double nozzle = 0, distance = 0, radius = 0;  ///< D, H, r [m]
  double flow = 0;                              ///< V̇ [m³/s]
  double temperature = 0;                       ///< of the fluid, at which its properties are taken [K]
};

/// Ranges of the correlation.
inline constexpr double k_jet_least_reynolds = 2e3, k_jet_largest_reynolds = 4e5;
inline constexpr double k_jet_least_distance = 2, k_jet_largest_distance = 12;
inline constexpr double k_jet_least_area = 0.004, k_jet_largest_area = 0.04;

double reynolds(const ImpingingJet& jet, const ChannelFluid& fluid);
/// A of the formula.
double area_ratio(const ImpingingJet& jet);
/// The mean coefficient h [W/(m² K)].
double film_coefficient(const ImpingingJet& jet, const ChannelFluid& fluid);

}  // namespace solidus::heat
