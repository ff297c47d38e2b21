/// Guard around any scheme: it checks that the temperatures that the scheme returns are a continuation of the
/// state at t_n, and rejects the step otherwise.
///
/// The equations of a step need not have one solution alone. Conductances follow gaps, gaps follow
/// temperatures, tables bend: a Newton iteration that sets out far away may end at a root that no sequence of
/// small steps leads to, with every balance closed. Conduction, contact and surroundings can only bring
/// temperatures together (the maximum principle); beyond the range of those at t_n and around the bodies goes
/// only what deformation heats or cools:
///
///   Θ_min − a − d_i  <=  Θ_i  <=  Θ_max + a + d_i,     d_i = min(2 |Q_i|/C_i, Θ_max/4)
///
/// Q_i is the structural heat and dissipation that the node took in the step, C_i its capacity. Of what only
/// explains itself (a wrong strain at a wrong temperature) no more than a quarter of the absolute temperature
/// is believed: steel that flows by 100 % at 300 MPa warms by less. a is what integration in space may over-
/// and undershoot: as much as the range, and 10 K (the open rule at a sudden chill: up to 65 %). A step
/// beyond is rejected and repeated with a smaller one, from the same state: the root that is left is the one
/// that t_n leads to.
///
/// Where fluxes, sources or friction heat or cool, the temperature has no bound on that side.
#pragma once

#include <memory>

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

/// Throws StepRejected on all processes where the temperatures of `trial` cannot follow from `old`.
/// Collective.
/// @param phases    which have taken this step: contributions as it has left them
/// @param time, dt  end and length of the step [s]
void require_continued(const Phases& phases, const State& old, const State& trial, double time, double dt);

class GuardedScheme final : public CouplingScheme {
 public:
  /// The phases, which are the scheme's, must outlive this object.
  GuardedScheme(std::unique_ptr<CouplingScheme> scheme, Phases phases);

  void synchronise(const State& state) override { scheme_->synchronise(state); }
  void forget() override { scheme_->forget(); }
  void conditions_changed() override { scheme_->conditions_changed(); }
  void allow_early_end(bool on) override {
    for (contact::ContactPair* pair : phases_.contacts) pair->parts().augmentations.allow_early_end(on);
  }
  StepEffort advance(const State& old, State& trial, double time, double dt) override;
  std::optional<StepEffort> advance_unless(const State& old, State& trial, double time, double dt,
                                           const HeatJudge& stop) override;

 private:
  std::unique_ptr<CouplingScheme> scheme_;
  Phases phases_;
};

}  // namespace solidus::coupling
