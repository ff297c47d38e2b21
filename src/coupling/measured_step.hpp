/// Takes one step with a coupling scheme and estimates its local error.
#pragma once

#include <functional>
#include <optional>

#include "coupling/error_estimate.hpp"
#include "coupling/observer.hpp"
#include "coupling/scheme.hpp"
#include "coupling/step_limits.hpp"

namespace solidus::coupling {

/// Takes steps with a scheme and measures them; sits above CouplingScheme::advance and works with any scheme.
class MeasuredStep {
 public:
  /// Measures nothing.
  explicit MeasuredStep(CouplingScheme& scheme) : scheme_(scheme) {}
  /// @param rates  of the step before the first one, where it is known
  MeasuredStep(CouplingScheme& scheme, ErrorControl control, ErrorEstimate estimate, Rates rates)
      : scheme_(scheme), control_(control), estimate_(std::move(estimate)), rates_(std::move(rates)) {}

  /// Errors are told and change nothing, as of fixed steps: a first step, which no rate predicts, is measured
  /// by its halves where it is cheap, else not at all, and is taken as a whole.
  void only_tell(bool first_too) {
    tells_ = true;
    tells_first_ = first_too;
  }

  struct Taken {
    /// Sums both halves where the step was doubled. It is empty where the error of its heat ended the step
    /// before deformation was solved, and is all that `error` has.
    std::optional<StepEffort> effort;
    LocalError error;
  };
  /// Whether a step with this error is to be repeated with a smaller one. The same on every process.
  using TooLong = std::function<bool(const LocalError&)>;
  /// From `old` (t_n) to `trial` (t_n + dt). Collective. Throws StepRejected as CouplingScheme::advance does.
  /// Nothing that later steps see changes before commit(). Schemes that conduct heat first are asked to stop
  /// where its error says `too_long`: a step that is repeated for its heat costs no mechanics. The error of
  /// temperature is that of the heat conducted, in such schemes, and what deformation warms is no part of it.
  Taken take(const State& old, State& trial, double time, double dt, const TooLong& too_long);
  /// The last step taken is committed.
  void commit() { rates_ = std::move(next_rates_); }
  /// Drops the rates of the last committed step, because they do not predict the next one: it is measured as
  /// a first step.
  void forget() { rates_ = {}; }

  /// Rates of the last step committed, for checkpoints.
  const Rates& rates() const { return rates_; }

 private:
  Taken doubled(const State& old, State& trial, double time, double dt);
  Taken told(const State& old, State& trial, double time, double dt);

  CouplingScheme& scheme_;
  ErrorControl control_ = ErrorControl::none;
  bool tells_ = false, tells_first_ = false;
  std::optional<ErrorEstimate> estimate_;
  Rates rates_, next_rates_;
};

}  // namespace solidus::coupling
