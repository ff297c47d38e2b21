/// The stages of a thermal step as single calls, for a caller that solves displacements along with it.
#include "heat/thermal_iteration.hpp"

#include "heat/thermal_parts.hpp"
#include "system/errors.hpp"

namespace solidus::heat {

ThermalIteration::ThermalIteration(ThermalPhase& phase)
    : phase_(phase), equations_(phase.parts(), now_), watch_(phase.parts()) {}

void ThermalIteration::begin(const ThermalState& old, double dt, const LoadWindow& loads) {
  watch_.begin_step();
  begin_stage(old, old, 0.0, dt, loads);
}

void ThermalIteration::begin_stage(const ThermalState& old, const ThermalState& stage, double factor,
                                   double dt, const LoadWindow& loads) {
  // An iteration within the coupled Newton method begins a stage: contributions learn the stage, and the
  // limits of conduction are found for it.
  ThermalParts& parts = phase_.parts();
  old_ = &old;
  dt_ = dt;
  parts.system->parts().exchanges = true;
  if (parts.printed) parts.printed->begin_stage({dt, factor}, old.temperature);
  if (parts.consistent) {
    parts.consistent->begin_stage({dt}, old.temperature);
    if (factor != 0) parts.consistent->begin_stage({dt, factor}, stage.temperature);
  }
  now_ = phase_.start(stage, loads);
  watch_.begin_stage(old, stage, phase_.limit_conduction(stage, old).range);
  // With heat at the nodes the heat that the stage starts from is extrapolated through the stage before.
  if (parts.nodal()) {
    stored_from_ = old.enthalpy;
    for (std::size_t i = 0; i < stored_from_.size(); ++i)
      stored_from_[i] += factor * (stage.enthalpy[i] - old.enthalpy[i]);
    // Otherwise points store their heat, which they extrapolate themselves.
  } else {
    for (const auto& block : parts.points) {
      block->start(old.temperature, dt);
      if (factor != 0) block->extrapolate(stage.temperature, factor);
    }
    parts.temperature_system->use_storage(true);
  }
  equations_.begin(stored_from_, dt);
}

void ThermalIteration::restart(const ThermalState& state) {
  now_ = state;
  equations_.restart();
}

HeatBalance ThermalIteration::conclude(ThermalState& trial) {
  phase_.require_positive(now_.temperature);
  if (phase_.parts().nodal()) phase_.book(equations_.residual(), dt_, now_.enthalpy);
  const ThermalState from{old_->temperature, stored_from_};
  HeatBalance balance = phase_.balance(from, now_, equations_.residual(), equations_.imbalance().moved, dt_);
  phase_.set_latent(balance, from, now_);
  trial = now_;
  return balance;
}

void ThermalIteration::reject(const std::string& reason) const {
  linear::NewtonReport report;
  report.reason = reason;
  phase_.require(report, equations_.residual(), now_.temperature);
  throw StepRejected("heat: " + reason, {}, Failure::heat);  // require() has thrown
}

}  // namespace solidus::heat
