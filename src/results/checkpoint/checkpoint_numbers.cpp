#include "results/checkpoint/checkpoint_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace solidus::results {

namespace {

// Everything that is neither field nor text, in a fixed order: written and read by the same list.
template <class C, class Visit>
void each_number(C& c, const Visit& visit) {
  auto& k = c.continuation;
  auto& o = k.options;
  auto& e = c.energy;
  auto& l = c.stability;
  const auto all = [&visit](auto&... n) { (visit(n), ...); };
  all(c.state.time, k.steps, c.rejected, c.shortened, c.state.mechanics.dt_before, k.stage.number,
      k.stage.time);
  all(k.control.size, k.control.refused, k.control.refused_ratio, k.control.before_refusal,
      k.control.failures, k.rates.changed);
  all(o.step, o.adaptive, o.min_step, o.max_step, o.growth, o.cut, o.easy_iterations);
  all(o.limits.control, o.limits.temperature, o.limits.displacement, o.limits.stress, o.limits.solid_fraction,
      o.limits.inertia, o.limits.skin, o.limits.opening, o.limits.last_melt);
  all(e.stored_heat, e.structural, e.contact, e.kinetic, e.friction, e.frictional_heat, e.numerical, e.work,
      e.heat_in, e.entropy_in, e.heat_exchanged, e.viscous_dissipation, e.plastic_dissipation, e.plastic_work,
      e.inelastic_entropy, e.internal_at_start, e.to_channels);
  all(l.mechanical, l.thermal, l.entropy, l.frictional_entropy);
  auto& s = k.shots;
  all(c.state.shot, c.state.poured, s.shots, s.change, s.lowest, s.highest);
  all(s.at_pour.mean, s.at_pour.lowest, s.at_pour.highest);
  for (auto* heat : {&s.heat, &k.pending, &e.bodies})
    all(heat->poured, heat->ejected, heat->corrected, heat->energy);
}

template <class C>
std::vector<double> all_numbers(const C& c) {
  std::vector<double> numbers;
  each_number(c, [&](const auto& n) { numbers.push_back(static_cast<double>(n)); });
  return numbers;
}

}  // namespace

std::vector<double> numbers_of(const CheckpointView& c) {
  return all_numbers(c);
}

void set_numbers(TableReader& in, Checkpoint& c) {
  const std::vector<double> numbers = in.numbers("numbers", all_numbers(c).size());
  const coupling::DieTemperature& die = c.continuation.shots.at_pour;
  std::size_t i = 0;
  each_number(c, [&](auto& n) {
    using Number = std::decay_t<decltype(n)>;
    const double value = numbers[i];
    const void* place = &n;
    bool fits =
        std::isfinite(value) || (!std::isnan(value) && (place == &die.lowest || place == &die.highest));
    if constexpr (!std::is_same_v<Number, double>) {
      const double most = std::is_same_v<Number, bool> ? 1 : std::numeric_limits<int>::max();
      fits = value >= 0 && value <= most && value == std::floor(value);
    }
    if (!fits) in.refuse(fmt::format("its 'numbers' have {} in row {}", value, i));
    n = static_cast<Number>(value);
    ++i;
  });
  if (c.state.time < 0) in.refuse(fmt::format("its time is {} s", c.state.time));
}

}  // namespace solidus::results
