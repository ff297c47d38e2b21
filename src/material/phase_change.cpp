/// A fraction is a list of linear pieces with jumps between them; checks make sure that it falls from one
/// to zero.
#include "material/phase_change.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace solidus::material {
namespace {

using Point = std::pair<double, double>;

bool colder(const Point& p, double temperature) {
  return p.first < temperature;
}

}  // namespace

PhaseFraction::PhaseFraction(std::vector<Point> points) : points_(std::move(points)) {
  // Any order of points is accepted from which the curve is clear; what contradicts itself is not.
  if (points_.size() < 2) throw std::invalid_argument("a phase fraction needs at least two points");
  for (const auto& [temperature, fraction] : points_)
    if (!std::isfinite(temperature) || !std::isfinite(fraction))
      throw std::invalid_argument("a point of the phase fraction is not a finite number");
  // From cold to hot, from 1 to 0, neither temperature nor fraction against the order.
  if (points_.front().first > points_.back().first) std::reverse(points_.begin(), points_.end());
  if (points_.front().second < points_.back().second)  // both at one temperature, or wrong
    if (points_.front().first == points_.back().first) std::reverse(points_.begin(), points_.end());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (points_[i].first < points_[i - 1].first)
      throw std::invalid_argument("the temperatures of the phase fraction are not in order");
    if (points_[i].second > points_[i - 1].second)
      throw std::invalid_argument("the phase fraction must not rise with temperature");
  }
  // The whole change lies within the points: 1 at the cold end, 0 at the hot one.
  if (points_.front().second != 1.0 || points_.back().second != 0.0)
    throw std::invalid_argument("the phase fraction must be 1 at its coldest point and 0 at its hottest");

  // One piece for each stretch between jumps, and one of solid before the first point.
  std::vector<Pieces::Piece> pieces{{solidus() - 1, 1.0, 0.0}};
  // Points at one temperature are a jump; between jumps the fraction is linear.
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

double PhaseFraction::value(double temperature, double plateau_share) const {
  double fraction = value(temperature);
  for (const auto& [at, cold] : jumps_)
    if (temperature == at) fraction = std::lerp(cold, fraction, plateau_share);  // exact at both ends
  return fraction;
}

double PhaseFraction::mean_over_temperature(double before, double after) const {
  // Temperature changes at constant fraction before a state within an isothermal change is reached and after
  // it is left, on the side on which the other state lies. Between two states within it no temperature
  // changes, and the mean is that of any step.
  const bool freezes = after > before;
  for (const auto& [at, cold] : jumps_) {
    const double hot = value(at);
    const bool begins_within = hot < before && before < cold, ends_within = hot < after && after < cold;
    if (begins_within && !ends_within) before = freezes ? cold : hot;
    if (ends_within && !begins_within) after = freezes ? hot : cold;
  }
  return 0.5 * (before + after);
}

double PhaseFraction::isothermal_share() const {
  double share = 0;
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (points_[i].first == points_[i - 1].first) share += points_[i - 1].second - points_[i].second;
  return share;
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
