/// The interface that every coupling scheme implements: isothermal and isentropic split, double pass,
/// simultaneous and block-iterative.
#pragma once

#include "coupling/observer.hpp"
#include "coupling/state.hpp"

namespace solidus::coupling {

class CouplingScheme {
 public:
  virtual ~CouplingScheme() = default;
  /// Brings whatever follows from a state (contact gaps, conductances) in line with it: before the first
  /// step, after a rejected one and after a restart.
  virtual void synchronise(const State& state) = 0;
  /// Drops what solvers carried over from earlier steps (lagged preconditioners), so that the next step
  /// depends on the state alone. Called at every checkpoint: a run continued there goes the same way.
  virtual void forget() = 0;
  /// The phases got other conditions, and with them perhaps other matrices; synchronise() follows.
  virtual void conditions_changed() {}
  /// Advances from `old` (t_n) to `trial` (old.time + dt). Collective. Throws StepRejected on every process
  /// alike when the physics does not go through; `trial` is then meaningless and `old` untouched.
  virtual StepEffort advance(const State& old, State& trial, double time, double dt) = 0;
};

}  // namespace solidus::coupling
