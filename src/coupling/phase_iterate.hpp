/// The thermal state of an iterate at which solid fraction and straining of phase changes are taken, so that
/// a scheme that iterates within the step ends with those of Θ_{n+1}.
///
/// 4.81 holds the fractions of Θ_n through a step, which leaves a lag of one step between temperature and
/// shrinkage. A monolithic scheme evaluates them at the state that it has found and solves again until they
/// no longer change. The energy of a step is counted with the same fractions at both of its ends, as in the
/// splits (docs/theory/coupling.md).
///
/// Where nodes hold their heat the iteration goes from heat to heat, not from temperature to temperature: the
/// fraction of an isothermal change is a function of the heat, and half the way between a temperature below
/// the change and one above it is solid or liquid, never half of each.
#pragma once

#include <vector>

#include "coupling/phases.hpp"

namespace solidus::coupling {

class PhaseIterate {
 public:
  /// Begins at t_n. Phases and state must outlive this object. Collective.
  PhaseIterate(const Phases& phases, const heat::ThermalState& old);

  /// Sets the fractions of a pass; it refers to this object.
  void hold(mechanics::MechanicalPass& pass) const;
  /// Goes on to an iterate. Where nothing that deforms changes its phase this is nothing. Collective.
  /// @param share  of the way from the state that is held to that of the iterate
  void advance(const heat::ThermalState& now, double share = 1);
  /// The distance of an iterate from the state that is held: the largest difference of heats in kelvin (or of
  /// temperatures, where nodes hold no heat) as a part of what the step has changed. Zero where nothing
  /// changes its phase. Collective.
  double difference(const heat::ThermalState& now) const;
  /// Whether a body that deforms changes its phase.
  bool any() const { return any_; }

 private:
  double distance(const heat::ThermalState& a, const heat::ThermalState& b) const;

  bool any_ = false;
  const Phases* phases_;
  const heat::ThermalState* old_;
  heat::ThermalState held_;
  std::vector<double> plateau_share_;  ///< of held_; empty where no change is isothermal
};

}  // namespace solidus::coupling
