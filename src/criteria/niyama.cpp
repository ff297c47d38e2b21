/// The integral of the flow resistance over the freezing range is summed piece by piece when the law is
/// made.
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

}  // namespace

double niyama(double gradient, double cooling_rate) {
  return cooling_rate > 0 ? gradient / std::sqrt(cooling_rate) : 0.0;
}

std::optional<FeedingLaw> FeedingLaw::of(const material::Material& material) {
  const material::PhaseChange* change = material.solidification();
  const material::Casting& casting = material.casting;
  // Without these data the law has nothing to say.
  if (change == nullptr || !casting.arm_spacing || !casting.melt_viscosity) return {};
  const double range = change->fraction.liquidus() - change->fraction.solidus();
  double volume_change = 0;  // until the last melt is frozen: graphite forms on the way
  for (const material::PhaseChange& other : material.phase_changes)
    if (other.fraction.liquidus() > change->fraction.solidus()) volume_change += other.volume_change;
  if (range <= 0 || volume_change >= 0) return {};
  FeedingLaw law;
  // The critical pressure drop of the flow through the mush (Darcy) gives the factor; the integral over the
  // fraction of liquid is summed a piece of the table at a time.
  law.shrinkage_ = -volume_change;
  const double beta = law.shrinkage_ / (1 - law.shrinkage_);
  law.factor_ = std::sqrt(casting.critical_pressure_drop / (*casting.melt_viscosity * beta * range));
  // Pieces from hot to cold: the integral over the liquid fraction runs from the liquidus down.
  const auto& points = change->fraction.points();
  double above = 0;
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    const Piece piece{1 - points[i - 1].second, 1 - points[i].second,
                      (points[i].first - points[i - 1].first) / range, above};
    above += piece.whole();
    law.pieces_.push_back(piece);
  }
  return law;
}

double FeedingLaw::Piece::resistance(double g) const {
  if (width == 0) return 0;
  if (high == low) return material::k_blake_kozeny * width * (1 - high) * (1 - high) / (high * high);
  return material::k_blake_kozeny * width / (high - low) * (antiderivative(high) - antiderivative(g));
}

double FeedingLaw::Piece::whole() const {
  if (low == 0 && width > 0) return HUGE_VAL;  // the resistance grows beyond all bounds
  return resistance(low);
}

/// The liquid fraction of this piece at which I has a value, which is not above its end: Newton's method,
/// within a bracket. I falls with g, ever more slowly.
double FeedingLaw::Piece::fraction_at(double resistance_sought) const {
  constexpr int k_trials = 60;
  constexpr double k_rounding = 1e-14;
  double from = low, to = high, g = 0.5 * (low + high);
  for (int trial = 0; trial < k_trials && to > from; ++trial) {
    const double defect = above + resistance(g) - resistance_sought;
    (defect > 0 ? from : to) = g;
    const double slope = -material::k_blake_kozeny * width / (high - low) * (1 - g) * (1 - g) / (g * g);
    double next = g - defect / slope;
    if (!(next > from && next < to)) next = 0.5 * (from + to);
    if (std::abs(next - g) <= k_rounding * g) return next;
    g = next;
  }
  return to;
}

double FeedingLaw::resistance(double liquid_fraction) const {
  double sum = 0;
  for (const Piece& piece : pieces_) {
    sum += piece.resistance(std::clamp(liquid_fraction, piece.low, piece.high));
    if (liquid_fraction >= piece.low) break;
  }
  return sum;
}

double FeedingLaw::pore_fraction(double number) const {
  const double target = number * number;
  if (target <= 0) return shrinkage_;  // pores open in the first mush
  const auto behind = std::partition_point(pieces_.begin(), pieces_.end(),
                                           [&](const Piece& piece) { return piece.above < target; });
  const Piece& piece = *(behind - 1);
  if (piece.above + piece.whole() < target) return 0;  // what is left freezes at once
  return shrinkage_ * piece.fraction_at(target);
}

}  // namespace solidus::criteria
