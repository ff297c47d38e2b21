/// The heat of the exchange before and after an iteration is summed in the same way as in a residual, so that
/// the difference is the change of that residual to rounding.
#include "heat/iteration/heat_exchange.hpp"

#include <algorithm>
#include <vector>

namespace solidus::heat {

namespace {

bool follow_channels(HeatParts& parts, std::span<const double> temperature, double tolerance,
                     std::span<double> change) {
  std::vector<double> before(parts.supplied.size(), 0.0), after(before);
  double moved = 0;
  parts.channels.add_residual(temperature, before, moved);
  const bool settled = parts.channels.follow(temperature, parts.elements.potentials(), tolerance);
  parts.channels.add_residual(temperature, after, moved);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += before[i] - after[i];
  for (std::size_t i = 0; i < parts.supplied.size(); ++i) parts.supplied[i] += after[i] - before[i];
  return settled;
}

bool follow_radiation(HeatParts& parts, std::span<const double> temperature, double tolerance,
                      std::span<double> change) {
  // Heat of the surfaces that see each other before and after, by the same sums as in a residual, which
  // counts what leaves the nodes.
  std::vector<double> before(parts.supplied.size(), 0.0), after(before);
  const std::vector<std::size_t>& numbers = parts.enclosed.numbers();
  for (const std::size_t s : numbers)
    parts.surfaces.add_power(s, -parts.surfaces.add_residual_of(s, temperature, before));
  const bool settled = parts.enclosed.follow(parts.surfaces, temperature, tolerance);
  for (const std::size_t s : numbers)
    parts.surfaces.add_power(s, parts.surfaces.add_residual_of(s, temperature, after));
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += before[i] - after[i];
  for (std::size_t i = 0; i < parts.supplied.size(); ++i) parts.supplied[i] += after[i] - before[i];
  return settled;
}

}  // namespace

void begin_exchange(HeatParts& parts, std::span<const double> temperature) {
  if (parts.enclosed.any()) parts.enclosed.begin(parts.surfaces, temperature);
  if (parts.channels.any()) parts.channels.begin(temperature, parts.elements.potentials());
}

bool follow_exchange(HeatParts& parts, std::span<const double> temperature, double tolerance,
                     double tolerance_of_fluid, std::span<double> change) {
  std::fill(change.begin(), change.end(), 0.0);
  bool settled = true;
  if (parts.enclosed.any()) settled = follow_radiation(parts, temperature, tolerance, change);
  if (parts.channels.any())
    settled = follow_channels(parts, temperature, tolerance_of_fluid, change) && settled;
  return settled;
}

double entropy_power(const HeatParts& parts, std::span<const double> temperature) {
  double sum = 0;
  for (std::size_t i = 0; i < parts.n_owned; ++i) sum -= parts.supplied[i] / temperature[i];
  return sum;
}

std::size_t bytes(const HeatParts& parts) {
  return parts.elements.bytes() + parts.conduction.bytes() + parts.contributions.bytes() +
         parts.enclosed.bytes() + parts.channels.bytes();
}

}  // namespace solidus::heat
