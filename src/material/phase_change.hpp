/// Phase changes: phase fraction, latent heat and straining as functions of temperature
/// (monograph 2.64–2.66, 2.75).
///
/// f(Θ) is the fraction of the phase that is stable below the transformation (the solid fraction for
/// solidification): one when cold, zero when hot. The latent heat function is L(Θ) = ρ L (1 − f(Θ)) (errata
/// to 2.64), so cooling releases heat.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "numbers/pieces.hpp"

namespace solidus::material {

/// A phase fraction f(Θ), non-increasing from one to zero, kept as an exact piecewise-linear curve: two
/// points with the same temperature are an isothermal part (a jump). Lever rule and Scheil are sampled
/// adaptively to 1e-6 of the fraction.
class PhaseFraction {
 public:
  /// Linear between solidus and liquidus [K]; equal temperatures are an isothermal change.
  static PhaseFraction linear(double solidus, double liquidus);
  /// Points (temperature [K], fraction), rising or falling temperature; throws std::invalid_argument unless f
  /// falls monotonously from 1 (coldest point) to 0 (hottest). Two points at one temperature are an
  /// isothermal part.
  static PhaseFraction table(std::vector<std::pair<double, double>> points);
  /// Lever rule: f = (Θ_L − Θ)/((1 − k)(Θ_m − Θ)) between liquidus and eutectic, the rest isothermally at the
  /// eutectic; when f reaches one above the eutectic, that is the solidus.
  /// @param melting_point Θ_m of the pure solvent [K]; Θ_m > liquidus > eutectic
  /// @param partition     k of the solute, 0 < k < 1
  static PhaseFraction lever_rule(double melting_point, double liquidus, double eutectic, double partition);
  /// Scheil: f = 1 − ((Θ_m − Θ)/(Θ_m − Θ_L))^(1/(k − 1)), the rest isothermally at the eutectic.
  static PhaseFraction scheil(double melting_point, double liquidus, double eutectic, double partition);

  /// f and df/dΘ <= 0 [1/K] of the piece on the right, zero outside. At the temperature of an isothermal
  /// change, which alone does not say how much has frozen, f is that of the hot side: what is known by its
  /// temperature only is molten there. The jump is not in the slope: what integrates over a step takes
  /// differences of value(). Both together cost half of one after the other.
  Pieces::Line<double> line(double temperature) const { return line_of(temperature); }
  Pieces::Line<Lane> line(const Lane& temperature) const { return line_of(temperature); }
  double value(double temperature) const { return line(temperature).value; }
  Lane value(const Lane& temperature) const { return line(temperature).value; }
  /// f where a heat content tells how much has frozen: at the temperature of an isothermal change
  /// f(Θ−) − share [f(Θ−) − f(Θ+)], elsewhere f(Θ).
  /// @param plateau_share  how far that change has come, from 0 (cold) to 1 (hot)
  double value(double temperature, double plateau_share) const;
  /// The mean of f over the temperatures between two states of metal, which their fractions tell. What
  /// changes at one temperature is not part of it: metal that completes an isothermal change and then cools
  /// has the fraction of the cold side of that change at all temperatures that it passes. Over a range it is
  /// the mean of both fractions.
  double mean_over_temperature(double before, double after) const;
  double derivative(double temperature) const { return line(temperature).slope; }
  Lane derivative(const Lane& temperature) const { return line(temperature).slope; }
  double above(double temperature) const;  ///< the limit from the right; differs from below() at a jump only
  double below(double temperature) const;  ///< the limit from the left
  /// The share of the change that happens at single temperatures, from 0 to 1.
  double isothermal_share() const;
  double solidus() const { return points_.front().first; }
  double liquidus() const { return points_.back().first; }
  const std::vector<std::pair<double, double>>& points() const { return points_; }  ///< temperature rising

 private:
  explicit PhaseFraction(std::vector<std::pair<double, double>> points);
  template <class T>
  Pieces::Line<T> line_of(const T& temperature) const;

  std::vector<std::pair<double, double>> points_;
  Pieces pieces_;  ///< the limits from the right, with one piece below the solidus
  std::vector<std::pair<double, double>> jumps_;  ///< temperature [K], f on the cold side
};

template <class T>
Pieces::Line<T> PhaseFraction::line_of(const T& temperature) const {
  Pieces::Line<T> line = pieces_.line(temperature);
  line.value = select(line.value < T(0.0), T(0.0), line.value);  // rounding just below the liquidus
  return line;
}

struct PhaseChange {
  std::string name;
  PhaseFraction fraction;
  double latent_heat = 0;  ///< L [J/kg], released on cooling
  double volume_change =
      0;  ///< ΔV/V of the transformation on cooling: negative shrinks (aluminium), positive expands
  bool solidification = false;  ///< its fraction is the solid fraction f_S of 2.65; at most one per material
  bool graphite = false;        ///< it is the precipitation of graphite
};

}  // namespace solidus::material
