/// Measured flow curves σ(ξ, Θ): bilinear between the points of a grid of strain and temperature.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace solidus::material {

/// One measured curve: stress over plastic strain at one temperature.
struct FlowCurve {
  double temperature;            ///< [K]
  std::vector<double> strains;   ///< equivalent plastic strains, rising from 0
  std::vector<double> stresses;  ///< [Pa], as many
};

/// Beyond the last strain a curve stays level (perfectly plastic); beyond the first and the last temperature
/// the curve there holds. Immutable; `at` costs the same for few points and many.
class FlowCurves {
 public:
  FlowCurves() = default;
  /// @param strains       equivalent plastic strains, rising strictly from 0
  /// @param temperatures  [K], rising strictly
  /// @param stresses      [Pa], one row of strains.size() values per temperature
  /// Throws std::invalid_argument when the sizes do not fit, an argument does not rise, a stress is negative
  /// or not finite, or a curve falls with strain.
  FlowCurves(std::vector<double> strains, std::vector<double> temperatures, std::vector<double> stresses);

  /// Curves with strains of their own, in any order of temperature, on the union of their strains. That is
  /// exact: σ is the linear interpolation in Θ between the two neighbouring curves, each as it was given.
  /// Throws std::invalid_argument as above, and for two curves of one temperature.
  static FlowCurves merged(std::vector<FlowCurve> curves);

  /// At ξ >= 0 and Θ: σ − σ(0, Θ), its integral over ξ, and their derivatives. Second derivatives in Θ and,
  /// between the points, in ξ are zero. Derivatives at a point are those of the piece on its right; those in
  /// Θ at the last temperature are of the piece on its left, as in Table.
  struct Value {
    double stress = 0;        ///< K_ξ = σ(ξ, Θ) − σ(0, Θ) [Pa]
    double slope = 0;         ///< K_ξξ [Pa]
    double energy = 0;        ///< K = ∫_0^ξ K_ξ dξ [J/m³]
    double stress_theta = 0;  ///< K_ξΘ [Pa/K]
    double slope_theta = 0;   ///< K_ξξΘ [Pa/K]
    double energy_theta = 0;  ///< K_Θ [J/(m³ K)]
  };
  Value at(double strain, double temperature) const;

  std::span<const double> strains() const { return strain_.points; }
  std::span<const double> temperatures() const { return temperature_.points; }
  std::span<const double> stresses() const { return stresses_; }  ///< [temperature][strain]
  bool empty() const { return stresses_.empty(); }

 private:
  /// Rising points with equal buckets over their range, so that an interval is found without a search.
  struct Axis {
    std::vector<double> points;
    std::vector<std::size_t> bucket;  ///< the interval at the start of each bucket
    double scale = 0;                 ///< buckets per unit

    Axis() = default;
    explicit Axis(std::vector<double> rising);
    /// i with points[i] <= x < points[i + 1], clamped to the first and the last point.
    std::size_t interval(double x) const;
  };
  /// K_ξ and K on the interval of one curve that starts at a point.
  struct Piece {
    double stress, slope, energy;
  };
  Piece on_curve(std::size_t row, std::size_t interval, double beyond) const;

  Axis strain_, temperature_;
  std::vector<double> stresses_;
  std::vector<Piece> pieces_;  ///< [temperature][strain], each from its point to the next one
};

}  // namespace solidus::material
