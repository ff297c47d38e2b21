/// The range of all initial and boundary temperatures, compared with every step until it is left once.
#include "run/bounds_watch.hpp"

#include <algorithm>

#include "heat/iteration/worst_node.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

/// Beyond the range [K], and what deformation may cool or warm besides: metals at their yield stress change
/// by some tenths of a kelvin (2.127b).
constexpr double k_worth_a_word = 0.1, k_of_deformation = 1;

const char* remedy(const cases::CaseSpec& spec) {
  if (spec.heat.integration == heat::HeatIntegration::open)
    return "the open rule over- and undershoots at sudden chills; the closed one does not";
  if (!spec.heat.bounds) return "heat.bounds = true keeps temperatures within their range";
  if (spec.exchanges_heat())
    return "deformation that cools or warms can be all of it; shorter steps help against the rest";
  return "shorter steps help";
}

}  // namespace

void BoundsWatch::begin(const coupling::State& state) {
  range_ = {};
  for (Index i = 0; i < phase_.mesh().n_owned_nodes; ++i) {
    const double t = state.heat.temperature[as_size(i)];
    range_.lowest = std::min(range_.lowest, t);
    range_.highest = std::max(range_.highest, t);
  }
  range_ = {parallel::global_min(range_.lowest), parallel::global_max(range_.highest)};
}

void BoundsWatch::step(const coupling::StepRecord&, const coupling::State& state) {
  if (warned_) return;
  // The bounds hold what any time so far brought as an initial or boundary temperature; without sources and
  // deformation heat conduction cannot leave them.
  const heat::TemperatureRange around = heat::range_around(phase_, state.time, state.heat.temperature);
  range_.lowest = std::min(range_.lowest, around.lowest);
  range_.highest = std::max(range_.highest, around.highest);
  heat::WorstNode worst;
  const std::vector<double>& temperature = state.heat.temperature;
  for (Index i = 0; i < phase_.mesh().n_owned_nodes; ++i) {
    const auto n = as_size(i);
    worst.look(n, std::max(range_.lowest - temperature[n], temperature[n] - range_.highest));
  }
  const double beyond = parallel::global_max(worst.size);
  if (!(beyond > (spec_.exchanges_heat() ? k_of_deformation : k_worth_a_word))) return;
  warned_ = true;
  logging::warn("t = {:g} s: {}, {:.3g} K beyond all initial and boundary temperatures; {}", state.time,
                worst.text(phase_.mesh(), temperature, {}), beyond, remedy(spec_));
}

}  // namespace solidus::run
