/// Integrals over the straight pieces of the freezing curve, done once; an evaluation is then a formula.
#include "criteria/hot_tearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "material/permeability.hpp"

namespace solidus::criteria {

namespace {

using Curve = std::vector<std::pair<double, double>>;

/// The straight pieces of a curve between the root and the liquidus, from low to high temperature.
Curve mush_of(const Curve& curve) {
  Curve mush;
  // The root is where the grains are bridged; above it the solid fraction counts no more.
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const auto& [temperature, fraction] = curve[i];
    if (fraction > k_bridged && i + 1 < curve.size() && curve[i + 1].second <= k_bridged) {
      const auto& [above, less] = curve[i + 1];
      if (above <= temperature) continue;  // an isothermal change ends the range
      const double share = (fraction - k_bridged) / (fraction - less);
      mush.emplace_back(std::lerp(temperature, above, share), k_bridged);
    }
    if (fraction <= k_bridged) mush.emplace_back(temperature, fraction);
  }
  return mush;
}

}  // namespace

TearingLaw::TearingLaw(const Curve& curve, double shrinkage, double viscosity, double pressure_drop,
                       double longest)
    : shrinkage_(shrinkage), viscosity_(viscosity), pressure_drop_(pressure_drop) {
  // Gauss's rule of five points in each straight piece, over which the integrands are smooth.
  constexpr std::array<std::pair<double, double>, 5> k_gauss = {{{-0.9061798459386640, 0.2369268850561891},
                                                                 {-0.5384693101056831, 0.4786286704993665},
                                                                 {0, 0.5688888888888889},
                                                                 {0.5384693101056831, 0.4786286704993665},
                                                                 {0.9061798459386640, 0.2369268850561891}}};
  const Curve mush = mush_of(curve);
  if (!mush.empty()) least_gradient_ = (mush.back().first - mush.front().first) / longest;
  double taken = 0;  // F at the low end of the piece
  // A and B of the criterion of Rappaz, Drezet and Gremaud, summed piece by piece over the mush.
  for (std::size_t i = 1; i < mush.size(); ++i) {
    const double width = mush[i].first - mush[i - 1].first, low = mush[i - 1].second, high = mush[i].second;
    for (const auto& [place, weight] : k_gauss) {
      const double s = 0.5 * (1 + place), f = std::lerp(low, high, s), part = 0.5 * weight * width;
      const double here = taken + 0.5 * (low + f) * s * width;
      a_ += part * f * f / ((1 - f) * (1 - f));
      b_ += part * f * f * here / std::pow(1 - f, 3);
    }
    taken += 0.5 * (low + high) * width;
  }
}

std::optional<TearingLaw> TearingLaw::of(const material::Material& material, double longest) {
  const material::PhaseChange* freezing = material.solidification();
  if (freezing == nullptr || !material.casting.melt_viscosity) return {};
  double volume_change = 0;  // until the last melt is frozen: graphite forms on the way
  for (const material::PhaseChange& change : material.phase_changes)
    if (change.fraction.liquidus() > freezing->fraction.solidus()) volume_change += change.volume_change;
  if (volume_change >= 0) return {};
  TearingLaw law(freezing->fraction.points(), -volume_change / (1 + volume_change),
                 *material.casting.melt_viscosity, k_tearing_drop, longest);
  if (!(law.b() > 0)) return {};
  return law;
}

double TearingLaw::resistance(const Place& place) const {
  return material::k_blake_kozeny * viscosity_ / (place.arm_spacing * place.arm_spacing * gradient(place));
}

double TearingLaw::drop_of_shrinkage(const Place& place) const {
  return resistance(place) * (place.cooling_rate / gradient(place)) * shrinkage_ * a_;
}

double TearingLaw::drop(const Place& place, double strain_rate) const {
  return drop_of_shrinkage(place) + resistance(place) * (1 + shrinkage_) * strain_rate * b_ / gradient(place);
}

double TearingLaw::critical_strain_rate(const Place& place) const {
  const double left = pressure_drop_ - drop_of_shrinkage(place);
  if (left <= 0) return 0;
  return left * gradient(place) / (resistance(place) * (1 + shrinkage_) * b_);
}

double root_of(const Curve& curve) {
  const Curve mush = mush_of(curve);
  return mush.empty() ? 1 : mush.front().second;
}

double kou_index(const Curve& curve, double from, double to) {
  // The curve of the mush goes from the root to the liquidus.
  const Curve mush = mush_of(curve);
  if (mush.size() < 2 || mush.front().second <= from) return 0;
  // The slope of temperature over the root of the fraction, between both fractions.
  to = std::min(to, mush.front().second);
  const auto temperature = [&](double fraction) {
    const auto above = std::partition_point(mush.begin() + 1, mush.end() - 1,
                                            [=](const auto& point) { return point.second > fraction; });
    const auto& [low, more] = *(above - 1);
    const auto& [high, less] = *above;
    return more > less ? std::lerp(low, high, (more - fraction) / (more - less)) : low;
  };
  return (temperature(from) - temperature(to)) / (std::sqrt(to) - std::sqrt(from));
}

}  // namespace solidus::criteria
