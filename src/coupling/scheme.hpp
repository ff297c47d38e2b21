/// The interface that every coupling scheme implements: isothermal and isentropic split, double pass,
/// simultaneous and block-iterative.
#pragma once

#include <functional>
#include <optional>

#include "coupling/observer.hpp"
#include "coupling/state.hpp"

namespace solidus::coupling {

/// Judges the heat that a step has conducted before deformation is solved: true stops the step there. Called
/// on every process with the same answer.
/// @param warm   heat at the end of the step, deformation of t_n
/// @param flows  of heat in the step
using HeatJudge = std::function<bool(const State& warm, const heat::StageFlows& flows)>;

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
  /// Whether augmentations of the Lagrangian that do not converge may end early in the steps that follow
  /// (contact/forces/augmented_lagrangian.hpp): where shorter steps have not helped.
  virtual void allow_early_end(bool /*on*/) {}
  /// Advances from `old` (t_n) to `trial` (old.time + dt). Collective. Throws StepRejected on every process
  /// alike when the physics does not go through; `trial` is then meaningless and `old` untouched.
  virtual StepEffort advance(const State& old, State& trial, double time, double dt) = 0;
  /// The same. A scheme that conducts heat before it solves deformation asks `stop` between the two; where it
  /// says so nothing is returned and `trial` is meaningless. Others do not ask.
  virtual std::optional<StepEffort> advance_unless(const State& old, State& trial, double time, double dt,
                                                   const HeatJudge& stop) {
    static_cast<void>(stop);
    return advance(old, trial, time, dt);
  }
};

}  // namespace solidus::coupling
