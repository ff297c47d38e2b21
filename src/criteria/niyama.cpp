#include "criteria/niyama.hpp"

#include <algorithm>
#include <cmath>

#include "material/permeability.hpp"

namespace solidus::criteria {

namespace {

// ∫ (1 − g)²/g² dg, which rises with g.
double antiderivative(double g) {
  return g - 2 * std::log(g) - 1 / g;
}

// Of a piece from `g` up to its hot end.
double resistance_of(double low, double high, double width, double g) {
  if (width == 0) return 0;
  if (high == low) return material::k_blake_kozeny * width * (1 - high) * (1 - high) / (high * high);
  return material::k_blake_kozeny * width / (high - low) * (antiderivative(high) - antiderivative(g));
}

}  // namespace

double niyama(double gradient, double cooling_rate) {
  return cooling_rate > 0 ? gradient / std::sqrt(cooling_rate) : 0.0;
}

std::optional<FeedingLaw> FeedingLaw::of(const material::Material& material) {
  const material::PhaseChange* change = material.solidification();
  const material::Casting& casting = material.casting;
  if (change == nullptr || !casting.arm_spacing || !casting.melt_viscosity) return {};
  const double range = change->fraction.liquidus() - change->fraction.solidus();
  double volume_change = 0;  // until the last melt is frozen: graphite forms on the way
  for (const material::PhaseChange& other : material.phase_changes)
    if (other.fraction.liquidus() > change->fraction.solidus()) volume_change += other.volume_change;
  if (range <= 0 || volume_change >= 0) return {};
  FeedingLaw law;
  law.shrinkage_ = -volume_change;
  const double beta = law.shrinkage_ / (1 - law.shrinkage_);
  law.factor_ = std::sqrt(casting.critical_pressure_drop / (*casting.melt_viscosity * beta * range));
  const auto& points = change->fraction.points();
  for (std::size_t i = points.size() - 1; i > 0; --i)
    law.pieces_.push_back(
        {1 - points[i - 1].second, 1 - points[i].second, (points[i].first - points[i - 1].first) / range});
  return law;
}

double FeedingLaw::resistance(double liquid_fraction) const {
  double sum = 0;
  for (const Piece& piece : pieces_) {
    sum +=
        resistance_of(piece.low, piece.high, piece.width, std::clamp(liquid_fraction, piece.low, piece.high));
    if (liquid_fraction >= piece.low) break;
  }
  return sum;
}

double FeedingLaw::pore_fraction(double number) const {
  const double target = number * number;
  double sum = 0;
  for (const Piece& piece : pieces_) {
    const bool to_the_end = piece.low == 0 && piece.width > 0;  // the resistance grows beyond all bounds
    const double whole = to_the_end ? 0 : resistance_of(piece.low, piece.high, piece.width, piece.low);
    if (!to_the_end && sum + whole < target) {
      sum += whole;
      continue;
    }
    // Bisection: the resistance falls with g. Below the smallest double share of g nothing is left to find.
    double low = piece.low, high = piece.high;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (sum + resistance_of(piece.low, piece.high, piece.width, middle) > target ? low : high) = middle;
    }
    return shrinkage_ * high;
  }
  return 0;  // what is left freezes at once: the pressure never drops so far
}

}  // namespace solidus::criteria
