/// What the splits of first order have in common: the mechanical phase from Θ_n, then gaps and conductances,
/// then the thermal phase at the configuration and the internal variables found. What the mechanical phase
/// holds, temperature or entropy, is its own affair (mechanics::Mapping).
#pragma once

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

class SequentialSplit : public CouplingScheme {
 public:
  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

 protected:
  /// The phases must outlive the scheme. Throws std::invalid_argument when the mechanical phase was built for
  /// another mapping.
  SequentialSplit(Phases phases, mechanics::Mapping mapping);
  const Phases& phases() const { return phases_; }

 private:
  void mechanical_phase(const State& old, State& trial, double time, double dt, StepEffort& effort);

  Phases phases_;
};

}  // namespace solidus::coupling
