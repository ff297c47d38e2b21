/// The temperatures that an iteration with displacements may lead to: those at the start of the step and
/// around the bodies, with some room for what deformation heats and cools.
#pragma once

#include <memory>

#include "heat/thermal_parts.hpp"

namespace solidus::heat {

class ExtrapolationGuard;

class TemperatureWatch {
 public:
  /// The parts must outlive this object.
  explicit TemperatureWatch(ThermalParts& parts);
  ~TemperatureWatch();
  /// A step begins: no second stage is watched.
  void begin_step();
  /// A stage begins at the state `stage` of a step from `old`. Collective.
  /// @param range  within which conduction is to stay; open where something heats or cools
  void begin_stage(const ThermalState& old, const ThermalState& stage, const TemperatureRange& range);
  /// Whether a second stage is worth a try from the extrapolation of the heats between `old` at t_n and
  /// `stage`, the end of the first stage (extrapolation_guard.hpp). Always with the open rule, whose
  /// temperatures have no bounds. Both states must live until overshoots(). Collective.
  /// @param loads  of the second stage
  bool may_extrapolate(const ThermalState& old, const ThermalState& stage, const LoadWindow& loads);
  /// Whether the second stage, which started from there and ended in `next`, went too far: by more than
  /// deformation alone heats and cools. Collective.
  bool overshoots(const ThermalState& next) const;
  /// Limits conduction again where the Θ of now have left the range of those at t_n and around the bodies
  /// (conduction_limiter.hpp). True where that has changed F: the unknowns then solve it no more. Collective.
  bool revise_limits(const ThermalState& now);

 private:
  ThermalParts& parts_;
  std::unique_ptr<ExtrapolationGuard> guard_;  ///< of the step's two stages; null: none
  TemperatureRange allowed_;                   ///< to which the second one may lead
  TemperatureRange range_;                     ///< of begin_stage()
  TemperatureRange at_start_;                  ///< of the temperatures at t_n and of the first stage
};

}  // namespace solidus::heat
