/// Values of the criteria of freezing at a node, from what its history keeps.
#include "criteria/freezing.hpp"
#include "criteria/freezing_history.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

using namespace freezing_history;

namespace {

/// The ratio of Clyne and Davies of a node; k_never where it started colder or passed both fractions in one
/// step, of which the step and not the metal decides the time between them.
double vulnerable_share(const double* h) {
  if (h[k_healed_at] < 0 || h[k_vulnerable_at] <= h[k_healed_at] || h[k_safe_at] < 0) return k_never;
  return (h[k_safe_at] - h[k_vulnerable_at]) / (h[k_vulnerable_at] - h[k_healed_at]);
}

}  // namespace

/// The fields' marks for no value.
std::array<double, Freezing::k_fields> Freezing::nothing_known() {
  std::array<double, k_fields> marks{};
  for (std::size_t f = 0; f < k_fields; ++f) marks[f] = fields::k_of_freezing[f]->no_value.value_or(0);
  return marks;
}

std::array<double, Freezing::k_fields> Freezing::values_of(const FreezingNode& who,
                                                           std::span<const double> history,
                                                           double speed) const {
  // A node that has not solidified has no values at all.
  const double* const h = history.data() + as_size(who.node) * k_width;
  if (h[k_solidified_at] < 0) return nothing_known();
  // Gradient and rate are those of the moment of evaluation. Where the speed of the front is known, the rate
  // is gradient times speed, which is smoother than the rate at the node alone.
  const double time = h[k_solidified_at] - h[k_liquidus_at];
  const bool evaluated = h[k_evaluated_at] >= 0;  // else metal that was colder than T_e from the start
  const double gradient = evaluated ? h[k_gradient] : 0.0;
  const double magnitude = evaluated ? h[k_magnitude] : 0.0, own_rate = evaluated ? h[k_rate] : 0.0;
  const double rate = speed > 0 ? magnitude * speed : own_rate;
  // From these follow the arm spacing, Niyama's number, and the porosity that the feeding law expects of it.
  const auto body = as_size(who.body);
  const double spacing = storage_.material(who.body).casting.secondary_arm_spacing(time).value_or(0);
  const double ny = niyama(gradient, rate);
  const std::optional<FeedingLaw>& feeding = feeding_[body];
  const double number = feeding ? feeding->number(ny, spacing) : 0.0;
  const double pores = number > 0 ? feeding->pore_fraction(number) : 0.0;
  // Hot tearing needs a gradient, a rate and a spacing; the tendency is that of ends that are held.
  const std::optional<TearingLaw>& tearing = tearing_[body];
  double critical = k_never, tendency = k_never;
  if (tearing && magnitude > 0 && rate > 0 && spacing > 0) {
    const TearingLaw::Place place{magnitude, rate, spacing};
    critical = tearing->critical_strain_rate(place);
    if (held_[body] > 0) tendency = tearing->tendency(place, held_[body] * tearing->gradient(place) * rate);
  }
  return {h[k_solidified_at],
          time,
          rate,
          gradient,
          speed,
          spacing,
          ny,
          number,
          pores,
          critical,
          tendency,
          vulnerable_share(h),
          h[k_healed_at] >= 0 ? kou_[body] : k_never,
          plates_.empty() ? 0.0 : plates_[body].thickness_of(h[k_solidified_at])};
}

}  // namespace solidus::criteria
