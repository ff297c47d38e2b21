/// Criteria of shrinkage porosity from gradient and cooling rate at the end of freezing.
///
///   Ny  = G/√Ṫ                                                      [K^½ s^½/m]
///   Ny* = λ₂ √ΔP_cr / √(μ β ΔT_f) · G/√Ṫ                            [1]
///   Ny*² = I(g_cr) = 180 ∫_{g_cr}^{1} (1 − g)²/g² dθ/dg dg,          g_p = β′ g_cr
///
/// G [K/m] gradient and Ṫ [K/s] cooling rate near the solidus, λ₂ [m] secondary arm spacing, ΔP_cr [Pa] the
/// drop of the melt's pressure at which pores form, μ [Pa s] its shear viscosity, ΔT_f [K] the freezing
/// range, β = (ρ_s − ρ_l)/ρ_l and β′ = (ρ_s − ρ_l)/ρ_s the shrinkage, g the liquid fraction, θ(g) = (T −
/// T_S)/ΔT_f its curve, g_p the fraction of pores. Ny* is the pressure drop of Darcy's flow of feeding melt
/// through a one-dimensional mushy zone of permeability λ₂² g³/(180 (1 − g)²) that moves with the speed Ṫ/G.
///
/// Sources: E. Niyama, T. Uchida, M. Morikawa, S. Saito, A method of shrinkage prediction and its application
/// to steel casting practice, AFS Int. Cast Metals J. 7 (1982) 52–63. K. D. Carlson, C. Beckermann,
/// Prediction of shrinkage pore volume fraction using a dimensionless Niyama criterion, Metall. Mater. Trans.
/// A 40 (2009) 163–175. Validity: columnar feeding through a mushy zone; not for irons whose graphite
/// expands.
#pragma once

#include <optional>
#include <vector>

#include "material/material.hpp"

namespace solidus::criteria {

/// Zero where there is no cooling rate.
double niyama(double gradient, double cooling_rate);

/// Properties of a material that the dimensionless Niyama criterion Ny* depends on.
class FeedingLaw {
 public:
  /// Nothing where the material does not freeze over a range, does not shrink, or arm spacing or viscosity
  /// are not known.
  static std::optional<FeedingLaw> of(const material::Material& material);

  /// Ny* [1].
  double number(double niyama, double arm_spacing) const { return factor_ * arm_spacing * niyama; }
  /// I of Carlson and Beckermann at a critical liquid fraction in (0, 1].
  double resistance(double liquid_fraction) const;
  /// g_p [1]: no more than β′.
  double pore_fraction(double number) const;

 private:
  /// A straight piece of g(θ): g from `low` to `high` over `width` in θ.
  struct Piece {
    double low, high, width;
    double above;  ///< I at `high`: what the pieces before this one resist

    double resistance(double g) const;  ///< the part of I between g and `high`
    double whole() const;               ///< the same of the whole piece
    double fraction_at(double resistance_sought) const;
  };
  double factor_ = 0;          ///< √ΔP_cr / √(μ β ΔT_f) [1/(m Ny)]
  double shrinkage_ = 0;       ///< β′
  std::vector<Piece> pieces_;  ///< from the liquidus down
};

}  // namespace solidus::criteria
