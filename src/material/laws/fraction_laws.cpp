/// The curves of the phase fraction that every program has, and how a formula becomes points.
#include "material/laws/binary_alloy.hpp"
#include "material/laws/linear_fraction.hpp"
#include "material/laws/table_fraction.hpp"

namespace solidus::material {
namespace {

using Point = std::pair<double, double>;

constexpr double k_sampling_tolerance = 1e-6;  ///< of the fraction, between the exact curve and its chords

/// Appends points of f on (a, b], b included, so that the chords stay within the tolerance of f.
void sample(const std::function<double(double)>& f, double a, double b, int depth,
            std::vector<Point>& points) {
  // The chord from a to b is compared with the curve at three places; where it fits only b is
  // appended.
  const double fa = f(a), fb = f(b);
  bool fits = true;
  for (const double t : {0.25, 0.5, 0.75})
    fits = fits && std::abs(f(a + t * (b - a)) - (fa + t * (fb - fa))) <= 0.9 * k_sampling_tolerance;
  if (fits || depth == 0) {
    points.emplace_back(b, fb);
    return;
  }
  // Otherwise both halves are sampled, from left to right, so that points stay in order.
  const double middle = 0.5 * (a + b);
  sample(f, a, middle, depth - 1, points);
  sample(f, middle, b, depth - 1, points);
}

}  // namespace

PhaseFraction sampled_fraction(const std::function<double(double)>& f, FractionRange range) {
  std::vector<Point> points{{range.low, 1.0}};
  if (f(range.low) < 1.0) points.emplace_back(range.low, f(range.low));
  sample(f, range.low, range.high, 20, points);
  points.back().second = 0.0;  // f(high) up to rounding
  return PhaseFraction::table(std::move(points));
}

PhaseFraction PhaseFraction::lever_rule(double melting_point, double liquidus, double eutectic,
                                        double partition) {
  return fraction_curve(LeverRule{{melting_point, liquidus, eutectic, partition}});
}

PhaseFraction PhaseFraction::scheil(double melting_point, double liquidus, double eutectic,
                                    double partition) {
  return fraction_curve(Scheil{{melting_point, liquidus, eutectic, partition}});
}

Kinds<FractionLaw>& fraction_laws() {
  static Kinds<FractionLaw> laws = [] {
    Kinds<FractionLaw> all("curve of the phase fraction");
    all.add(kind_of<FractionLaw, FractionLawOf<LinearFraction>>());
    all.add(kind_of<FractionLaw, FractionLawOf<TableFraction>>());
    all.add(kind_of<FractionLaw, FractionLawOf<LeverRule>>());
    all.add(kind_of<FractionLaw, FractionLawOf<Scheil>>());
    return all;
  }();
  return laws;
}

}  // namespace solidus::material
