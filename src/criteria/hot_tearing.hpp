/// Criteria of hot tearing that follow from how an alloy freezes.
///
/// *Rappaz, Drezet, Gremaud.* Melt flows through the mush towards its root, where grains bridge, against a
/// drop of pressure. It replaces what shrinkage and straining across the front take away:
///
///   Δp  = 180 μ/(λ₂² G) [ v β A + (1 + β) ε̇ B/G ]
///   A   = ∫ f²/(1 − f)² dT,   B = ∫ f² F/(1 − f)³ dT,   F(T) = ∫ f dT from the root to T
///   ε̇_c = G [ Δp_c λ₂² G/(180 μ) − v β A ] / [ (1 + β) B ]
///
/// f solid fraction over the temperature T [K] from the root to the liquidus, G [K/m] gradient, v = Ṫ/G [m/s]
/// speed of the isotherms, λ₂ [m] arm spacing, μ [Pa s] viscosity of the melt, β = (ρ_s − ρ_l)/ρ_l shrinkage.
/// Above the strain rate ε̇_c [1/s] the pressure at the root falls by more than Δp_c and a pore opens between
/// the grains, of which a tear grows. The root is where f = 0.98, or the end of the range before an
/// isothermal change. Validity: columnar freezing, strain across the direction of growth.
///
/// Where the gradient vanishes (thermal centres, walls that freeze through at once) the mush (T_L − T_r)/G
/// would be longer than the casting, and Δp, which goes with 1/G², has no limit as elements get smaller. Melt
/// comes from no further than the casting reaches: G is at least (T_L − T_r)/L, L [m] its longest side, T_r
/// the temperature of the root. From Δp_c on a pore opens and the pressure falls no further, so that Δp/Δp_c
/// is cut at 100.
///
/// *Clyne and Davies.* t_V/t_R, the time between f = 0.9 and 0.99, when melt no longer heals a strain, over
/// that between 0.4 and 0.9, when it still does; fractions as public implementations take them.
///
/// *Kou.* |dT/d√f| near the end of freezing, here from f = 0.87 to the root: the steeper, the longer grains
/// stay apart while they contract. Zero where an isothermal change bridges them before. The path of a node is
/// the curve of its card, if it froze along it from 0.4 on.
///
/// Sources: M. Rappaz, J.-M. Drezet, M. Gremaud, A new hot-tearing criterion, Metall. Mater. Trans. A 30
/// (1999) 449–455. T. W. Clyne, G. J. Davies, The influence of composition on solidification cracking
/// susceptibility in binary alloy systems, Br. Foundrym. 74 (1981) 65–73. S. Kou, A criterion for cracking
/// during solidification, Acta Mater. 88 (2015) 366–374.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "criteria/quantities.hpp"
#include "material/material.hpp"

namespace solidus::criteria {

/// Solid fractions at which grains bridge, and between which the ratio of Clyne and Davies takes its times.
inline constexpr double k_bridged = 0.98;
/// Δp_c, at which a pore opens between grains [Pa]: the authors' value, decision 0111.
inline constexpr double k_tearing_drop = 2000;
/// The largest Δp/Δp_c that is told: the law says no more of what is a hundred times beyond its threshold.
inline constexpr double k_most_tendency = 100;
inline constexpr double k_healed_from = 0.4, k_vulnerable_from = 0.9, k_vulnerable_to = 0.99;

/// The strain rate that the melt of an alloy can feed, from its freezing curve, viscosity and shrinkage.
class TearingLaw {
 public:
  /// @param curve      (T [K], f) from low to high temperature
  /// @param shrinkage  β > 0
  /// @param viscosity  μ [Pa s]
  /// @param pressure_drop  Δp_c [Pa]
  /// @param longest  L, the longest side of the casting [m]
  TearingLaw(const std::vector<std::pair<double, double>>& curve, double shrinkage, double viscosity,
             double pressure_drop, double longest = HUGE_VAL);
  /// Nothing where the material does not freeze over a range, does not shrink while it does, or says no
  /// viscosity of its melt.
  static std::optional<TearingLaw> of(const material::Material& material, double longest = HUGE_VAL);

  double a() const { return a_; }  ///< A [K]
  double b() const { return b_; }  ///< B [K²]
  /// The place in the mush: G [K/m], Ṫ [K/s], λ₂ [m], all above zero.
  struct Place {
    double gradient, cooling_rate, arm_spacing;
  };
  /// Δp at a strain rate [1/s], and the part of it that shrinkage takes [Pa].
  double drop(const Place& place, double strain_rate) const;
  double drop_of_shrinkage(const Place& place) const;
  /// Δp over Δp_c, at most k_most_tendency: from one on a pore opens.
  double tendency(const Place& place, double strain_rate) const {
    return std::min(drop(place, strain_rate) / pressure_drop_, k_most_tendency);
  }
  /// ε̇_c [1/s]; zero where shrinkage alone takes Δp_c.
  double critical_strain_rate(const Place& place) const;

  /// G, at least that with which the mush is as long as the casting [K/m].
  double gradient(const Place& place) const { return std::max(place.gradient, least_gradient_); }

 private:
  /// 180 μ/(λ₂² G) [Pa s/(m K)].
  double resistance(const Place& place) const;

  double a_ = 0, b_ = 0, shrinkage_, viscosity_, pressure_drop_;
  double least_gradient_ = 0;  ///< [K/m]
};

/// Name of the share of the castings in which shrinkage alone takes Δp_c among the findings:
/// "critical_strain_rate_zero".
inline std::string fed_nowhere() {
  return std::string(fields::k_critical_strain_rate.name) + "_zero";
}

/// The solid fraction of the root: 0.98, or where the range ends before an isothermal change.
double root_of(const std::vector<std::pair<double, double>>& curve);

/// |dT/d√f| between two solid fractions, no further than the root [K]; zero where f jumps over the first.
double kou_index(const std::vector<std::pair<double, double>>& curve, double from = 0.87, double to = 1);

}  // namespace solidus::criteria
