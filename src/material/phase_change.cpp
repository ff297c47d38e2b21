#include "material/phase_change.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace solidus::material {
namespace {

using Point = std::pair<double, double>;

constexpr double k_sampling_tolerance = 1e-6;  ///< of the fraction, between the exact curve and its chords

/// Appends points of f on (a, b], b included, so that the chords stay within the tolerance of f.
template <class Fraction>
void sample(const Fraction& f, double a, double b, int depth, std::vector<Point>& points) {
  const double fa = f(a), fb = f(b);
  bool fits = true;
  for (const double t : {0.25, 0.5, 0.75})
    fits = fits && std::abs(f(a + t * (b - a)) - (fa + t * (fb - fa))) <= 0.9 * k_sampling_tolerance;
  if (fits || depth == 0) {
    points.emplace_back(b, fb);
    return;
  }
  const double middle = 0.5 * (a + b);
  sample(f, a, middle, depth - 1, points);
  sample(f, middle, b, depth - 1, points);
}

/// The curve f between `low` and `high`, with an isothermal rest at `low`.
template <class Fraction>
std::vector<Point> sampled(const Fraction& f, double low, double high) {
  std::vector<Point> points{{low, 1.0}};
  if (f(low) < 1.0) points.emplace_back(low, f(low));
  sample(f, low, high, 20, points);
  points.back().second = 0.0;  // f(high) up to rounding
  return points;
}

void check_alloy(double melting_point, double liquidus, double eutectic, double partition) {
  if (!(melting_point > liquidus && liquidus > eutectic))
    throw std::invalid_argument(
        "the melting point of the solvent must lie above the liquidus, and that above the eutectic");
  if (!(partition > 0 && partition < 1))
    throw std::invalid_argument("the partition coefficient must lie between 0 and 1");
}

bool colder(const Point& p, double temperature) {
  return p.first < temperature;
}

}  // namespace

PhaseFraction::PhaseFraction(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw std::invalid_argument("a phase fraction needs at least two points");
  for (const auto& [temperature, fraction] : points_)
    if (!std::isfinite(temperature) || !std::isfinite(fraction))
      throw std::invalid_argument("a point of the phase fraction is not a finite number");
  if (points_.front().first > points_.back().first) std::reverse(points_.begin(), points_.end());
  if (points_.front().second < points_.back().second)  // both at one temperature, or wrong
    if (points_.front().first == points_.back().first) std::reverse(points_.begin(), points_.end());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (points_[i].first < points_[i - 1].first)
      throw std::invalid_argument("the temperatures of the phase fraction are not in order");
    if (points_[i].second > points_[i - 1].second)
      throw std::invalid_argument("the phase fraction must not rise with temperature");
  }
  if (points_.front().second != 1.0 || points_.back().second != 0.0)
    throw std::invalid_argument("the phase fraction must be 1 at its coldest point and 0 at its hottest");

  std::vector<Pieces::Piece> pieces{{solidus() - 1, 1.0, 0.0}};
  for (std::size_t i = 0; i < points_.size();) {
    const auto [t, from] = points_[i];
    while (i + 1 < points_.size() && points_[i + 1].first == t) ++i;
    const double to = points_[i++].second;
    if (to < from) jumps_.emplace_back(t, from);
    const bool last = i == points_.size();
    pieces.push_back({t, to, last ? 0.0 : (points_[i].second - to) / (points_[i].first - t)});
  }
  pieces_ = Pieces(std::move(pieces));
}

PhaseFraction PhaseFraction::linear(double solidus, double liquidus) {
  if (solidus > liquidus) throw std::invalid_argument("the solidus lies above the liquidus");
  return PhaseFraction({{solidus, 1.0}, {liquidus, 0.0}});
}

PhaseFraction PhaseFraction::table(std::vector<Point> points) {
  return PhaseFraction(std::move(points));
}

PhaseFraction PhaseFraction::lever_rule(double melting_point, double liquidus, double eutectic,
                                        double partition) {
  check_alloy(melting_point, liquidus, eutectic, partition);
  const double solidus = (liquidus - (1 - partition) * melting_point) / partition;
  const auto f = [&](double t) {
    return t <= solidus ? 1.0 : (liquidus - t) / ((1 - partition) * (melting_point - t));
  };
  return PhaseFraction(sampled(f, std::max(eutectic, solidus), liquidus));
}

PhaseFraction PhaseFraction::scheil(double melting_point, double liquidus, double eutectic,
                                    double partition) {
  check_alloy(melting_point, liquidus, eutectic, partition);
  const auto f = [&](double t) {
    return 1 - std::pow((melting_point - t) / (melting_point - liquidus), 1 / (partition - 1));
  };
  return PhaseFraction(sampled(f, eutectic, liquidus));
}

double PhaseFraction::value(double temperature, double plateau_share) const {
  double fraction = value(temperature);
  for (const auto& [at, cold] : jumps_)
    if (temperature == at) fraction = std::lerp(cold, fraction, plateau_share);  // exact at both ends
  return fraction;
}

double PhaseFraction::below(double temperature) const {
  if (temperature <= solidus()) return 1.0;
  if (temperature > liquidus()) return 0.0;
  const auto hot = std::lower_bound(points_.begin(), points_.end(), temperature, colder);  // first not colder
  if (hot->first == temperature) return hot->second;
  const auto cold = hot - 1;
  return cold->second +
         (hot->second - cold->second) * ((temperature - cold->first) / (hot->first - cold->first));
}

double PhaseFraction::above(double temperature) const {
  if (temperature < solidus()) return 1.0;
  if (temperature >= liquidus()) return 0.0;
  const auto hot = std::upper_bound(points_.begin(), points_.end(), temperature,
                                    [](double t, const Point& p) { return t < p.first; });  // first hotter
  const auto cold = hot - 1;
  return cold->second +
         (hot->second - cold->second) * ((temperature - cold->first) / (hot->first - cold->first));
}

}  // namespace solidus::material
