/// One step of the thermal phase piece by piece, for a Newton iteration that has further unknowns: the
/// displacements of the simultaneous scheme (monograph 4.1). The equations of a stage and what watches over
/// its temperatures are parts of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "heat/temperature_watch.hpp"
#include "heat/thermal_equations.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::heat {

class ThermalIteration {
 public:
  /// The phase must outlive this object and must not solve between begin() and conclude().
  explicit ThermalIteration(ThermalPhase& phase);
  ThermalIteration(const ThermalIteration&) = delete;
  ThermalIteration& operator=(const ThermalIteration&) = delete;

  /// To loads.time = t_n + dt, with these loads, from `old` at t_n, which is H* and must live until
  /// conclude().
  void begin(const ThermalState& old, double dt, const LoadWindow& loads);
  /// The second stage of a two-stage method, from the first one: H* = H_n + factor (H_stage − H_n). Both
  /// states must live until conclude().
  void begin_stage(const ThermalState& old, const ThermalState& stage, double factor, double dt,
                   const LoadWindow& loads);
  /// The state of now, ghosts up to date.
  const ThermalState& state() const { return now_; }
  /// Goes back to a state that state() was in since the step or stage began, for a further attempt.
  void restart(const ThermalState& state);
  /// F at the state of now, its tangent and the way to further states.
  ThermalEquations& equations() { return equations_; }
  const ThermalEquations& equations() const { return equations_; }
  /// The bounds of the temperatures.
  TemperatureWatch& watch() { return watch_; }

  /// The state reached and its heat balance, against H*; latent heat is that between the temperatures at t_n
  /// and now.
  HeatBalance conclude(ThermalState& trial);
  [[noreturn]] void reject(const std::string& reason) const;

 private:
  ThermalPhase& phase_;
  const ThermalState* old_ = nullptr;
  ThermalState now_;
  std::vector<double> stored_from_;  ///< H*, [local node]; where the enthalpy of the nodes is the unknown
  double dt_ = 0;
  ThermalEquations equations_;
  TemperatureWatch watch_;
};

}  // namespace solidus::heat
