/// For each node of a body that burns: whether and when it has ignited, and what share of its heat lies in
/// the window of the step.
#include "heat/loads/exothermic.hpp"

#include <cassert>
#include <cmath>

namespace solidus::heat {

namespace {

/// The rounding of a temperature, as a share of it: a body that rests at its temperature of ignition is lit,
/// by whatever processor.
constexpr double k_rounding = 1e-12;

}  // namespace

BurningState unlit(std::size_t n_nodes) {
  return {std::vector<double>(n_nodes, HUGE_VAL), std::vector<double>(n_nodes, 0.0)};
}

void renew(const std::vector<char>& marked, BurningState& state) {
  for (std::size_t i = 0; i < state.lit.size(); ++i)
    if (marked[i] != 0) state.lit[i] = HUGE_VAL, state.released[i] = 0;
}

BurningState burn(const BurningState& state, const std::vector<double>& ignition,
                  const std::vector<double>& before, const std::vector<double>& after, double begin,
                  double end) {
  assert(state.lit.size() == ignition.size() && after.size() == ignition.size());
  BurningState next = state;
  // What burns releases until the end of the step; what reaches its ignition within it is lit at that time,
  // by linear interpolation.
  for (std::size_t i = 0; i < next.lit.size(); ++i) {
    if (std::isfinite(next.lit[i])) {
      next.released[i] = end;
      continue;
    }
    if (!(after[i] >= (1 - k_rounding) * ignition[i])) continue;
    const double rise = after[i] - before[i];
    const double share = rise > 0 ? std::clamp((ignition[i] - before[i]) / rise, 0.0, 1.0) : 0.0;
    next.lit[i] = next.released[i] = begin + share * (end - begin);
  }
  return next;
}

}  // namespace solidus::heat
