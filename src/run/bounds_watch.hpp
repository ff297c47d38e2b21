/// Warns once where a temperature leaves the range of all initial and boundary temperatures.
#pragma once

#include "cases/case_spec.hpp"
#include "coupling/simulation.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::run {

/// As long as no flux, source or contribution brings heat, no temperature can leave that range. The closed
/// rule keeps to it (heat/conduction/conduction_limiter.hpp); the open rule, the simultaneous scheme and
/// heat.bounds = false need not.
class BoundsWatch final : public coupling::Observer {
 public:
  /// @param phase  of the run; must outlive this object
  BoundsWatch(const cases::CaseSpec& spec, const heat::ThermalPhase& phase) : spec_(spec), phase_(phase) {}
  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  const cases::CaseSpec& spec_;
  const heat::ThermalPhase& phase_;
  heat::TemperatureRange range_;
  bool warned_ = false;
};

}  // namespace solidus::run
