/// The volumetric enthalpy curve of a material: sensible and latent heat as one monotone graph.
///
/// h(Θ) = ∫ ρ C dΘ + Σ_k ρ L_k (1 − f_k(Θ)) [J/m³], zero at the lowest temperature of its range. C continues
/// beyond its points as a constant; with Extrapolation::linear it follows its line first, for one more width
/// of its table (never below half its end value). With piecewise-linear C and f it is piecewise quadratic
/// with upward jumps (isothermal changes), so the value and the inverse are closed forms. Heat is always
/// stored as a difference of h: exact for every step (4.149). The entropy s(Θ) = ∫ dh/Θ is a closed form too,
/// with jumps of (height)/Θ.
#pragma once

#include <span>
#include <vector>

#include "material/phase_change.hpp"
#include "numbers/table.hpp"

namespace solidus::material {

class EnthalpyCurve {
 public:
  EnthalpyCurve() = default;
  /// @param density         ρ of the reference configuration [kg/m³]
  /// @param specific_heat   C(Θ) [J/(kg K)], positive
  /// Throws std::invalid_argument when a density or capacity is not positive or a latent heat is negative.
  EnthalpyCurve(double density, const Table& specific_heat, std::span<const PhaseChange> changes);

  /// h(Θ) [J/m³]; at a jump the lower and the upper value.
  double lower(double temperature) const;
  double upper(double temperature) const;
  /// s(Θ) [J/(m³ K)] up to a constant, Θ > 0; at a jump the lower and the upper value.
  double lower_entropy(double temperature) const;
  double upper_entropy(double temperature) const;
  /// dh/dΘ [J/(m³ K)] of the piece to the right of Θ, without jumps.
  double capacity(double temperature) const;
  /// Θ(h): the continuous inverse, constant over a jump [K].
  double temperature(double enthalpy) const;
  /// dΘ/dh: zero within a jump.
  double inverse_slope(double enthalpy) const;
  /// Temperatures of the jumps, rising, with their heights.
  struct Jump {
    double temperature, height;
  };
  std::span<const Jump> jumps() const { return jumps_; }

  struct Piece {  ///< h = h0 + c0 (Θ − Θ0) + c1/2 (Θ − Θ0)² for Θ in [Θ0, Θ1]; h0 already includes the jump
                  ///< at Θ0
    double t0, t1, h0, c0, c1;
  };
  std::span<const Piece> pieces() const {
    return pieces_;
  }  ///< the first and last continue to −∞ and +∞ with constant c

 private:
  std::size_t piece_of_temperature(double temperature) const;
  std::size_t piece_of_enthalpy(double enthalpy) const;
  double value(const Piece& piece, double temperature) const;
  /// The entropy of a piece, which is a line in h'(Θ): constant beyond the first and the last.
  double entropy(std::size_t piece, double temperature) const;
  std::vector<Piece> pieces_;
  std::vector<double> start_temperature_, start_enthalpy_;  ///< t0 and h0 of the pieces, for the search
  std::vector<double> jump_;     ///< height of the jump at t0 of each piece, mostly zero
  std::vector<double> entropy_;  ///< of each piece the constant k in s = k + (c0 − c1 Θ0) ln Θ + c1 Θ
  std::vector<Jump> jumps_;
};

}  // namespace solidus::material
