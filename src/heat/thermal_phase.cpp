/// Queries of a phase. Its steps are in thermal_step.cpp, its parts are made in thermal_parts.cpp, and
/// reports are in thermal_report.cpp.
#include "heat/thermal_phase.hpp"

#include <algorithm>
#include <cmath>

#include "heat/iteration/heat_exchange.hpp"
#include "heat/thermal_parts.hpp"

namespace solidus::heat {

ThermalPhase::ThermalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                           const std::vector<material::Material>& materials,
                           const ThermalConditions& conditions, HeatOptions options,
                           std::vector<linear::Contribution*> contributions)
    : parts_(std::make_unique<ThermalParts>(mesh, kind, materials, options, std::move(contributions))),
      states_(*parts_) {
  parts_->build(conditions);
}

ThermalPhase::~ThermalPhase() = default;

const mesh::Mesh& ThermalPhase::mesh() const {
  return parts_->mesh;
}

const NodalEnthalpy& ThermalPhase::storage() const {
  return *parts_->storage;
}

ThermalStepping stepping(const ThermalPhase& phase) {
  return phase.parts().options.stepping.value_or(ThermalStepping::backward_euler);
}

const linear::ActiveSet& active(const ThermalPhase& phase) {
  return phase.parts().system->parts().elements.active();
}

void forget(ThermalPhase& phase) {
  phase.parts().solver->forget();
}

std::size_t bytes(const ThermalPhase& phase) {
  const ThermalParts& parts = phase.parts();
  std::size_t total =
      parts.storage->bytes() + parts.system->matrix().bytes() + heat::bytes(parts.system->parts());
  for (const auto& block : parts.points) total += block->bytes();
  if (parts.at_nodes) total += parts.at_nodes->bytes();
  if (parts.consistent) total += parts.consistent->bytes();
  return total;
}

double lasting_loads(const ThermalPhase& phase, double from, double to) {
  const HeatParts& parts = phase.parts().system->parts();
  return std::min(lasting(parts.surfaces, from, to), parts.sources.lasting(from, to));
}

TemperatureRange ambient_range(const ThermalPhase& phase, double time, bool with_contributions) {
  phase.parts().system->set_window(LoadWindow::at(time));
  return phase.parts().system->limits().ambient(with_contributions);
}

TemperatureRange range_around(const ThermalPhase& phase, double time, std::span<const double> temperature) {
  const TemperatureRange range = ambient_range(phase, time);
  const bool open = range.lowest == -HUGE_VAL || range.highest == HUGE_VAL;
  return open ? phase.parts().system->limits().closed(range, {}, temperature) : range;
}

void begin_burning(ThermalPhase& phase, const BurningState& state, double begin, double end) {
  phase.parts().system->parts().sources.set_burning(state, begin, end);
}

BurningState burnt(const ThermalPhase& phase, const BurningState& state, const ThermalState& before,
                   const ThermalState& after, double begin, double end) {
  if (state.lit.empty() || phase.parts().system->parts().sources.ignition().empty()) return state;
  return burn(state, phase.parts().system->parts().sources.ignition(), before.temperature, after.temperature,
              begin, end);
}

}  // namespace solidus::heat
