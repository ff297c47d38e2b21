/// The base of the isothermal and the isentropic split, which solve the two phases one after the other, each
/// once a step. mechanics::Mapping decides whether the mechanical phase holds temperature or entropy.
///
///   mechanics_first  (4.31–4.54)  equilibrium at t_{n+1} from Θ_n; gaps and conductances; then heat at the
///                                 configuration and the internal variables found. Displacements and stresses
///                                 of t_{n+1} belong to the temperatures of t_n.
///   heat_first       heat at the configuration of t_n, Θ_n to Θ*; equilibrium at t_{n+1} from Θ*; then what
///                    the deformation has taken up or released, with nothing that flows: Θ* to Θ_{n+1}. What
///                    the step ends with is in equilibrium with its own temperatures; structural heat acts on
///                    the conduction of the next step.
///
/// With heat first the gaps of a step are known when its heat has passed. Where their change within the step
/// has misplaced more than a given share of what the interfaces passed, heat and equilibrium are solved again
/// from t_n, heat through the mean of the gaps at both ends of the step, until they agree; where that goes
/// round between two states, through gaps between the two (gap_iteration_watch.hpp). Any conductance that is
/// not negative dissipates, so that the statements of stability and of the first law stay as they are.
///
/// Both are products of the same two dissipative operators (docs/theory/coupling_stability.md, section 3).
#pragma once

#include "coupling/phase_order.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "coupling/thermal_flow.hpp"

namespace solidus::coupling {

struct SequentialOptions {
  PhaseOrder order = PhaseOrder::mechanics_first;
  ThermalFlow flow = ThermalFlow::kept;  ///< of metal in the thermal phase that follows the mechanical one
  /// The share of the heat that interfaces pass which may be misplaced by gaps that change within a step,
  /// with heat first; one: any.
  double gap_tolerance = 1;
};

class SequentialSplit : public CouplingScheme {
 public:
  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;
  std::optional<StepEffort> advance_unless(const State& old, State& trial, double time, double dt,
                                           const HeatJudge& stop) override;

 protected:
  /// The phases must outlive the scheme; the order means nothing where one of them is missing. Throws
  /// std::invalid_argument when the mechanical phase was built for another mapping.
  SequentialSplit(Phases phases, mechanics::Mapping mapping, const SequentialOptions& options);
  const Phases& phases() const { return phases_; }

 private:
  StepEffort mechanics_first(const State& old, State& trial, double time, double dt);
  std::optional<StepEffort> heat_first(const State& old, State& trial, double time, double dt,
                                       const HeatJudge& stop);
  std::optional<StepEffort> conducted_first(const State& old, State& trial, double time, double dt,
                                            const HeatJudge& stop, int most, int& iterations);
  /// Gaps that heat passes through, [contact][point].
  using Gaps = std::vector<std::vector<contact::HeatGap>>;
  Gaps gaps() const;
  static Gaps middle(const Gaps& a, const Gaps& b);
  /// The gaps in the middle of a step if bodies go on moving as in the step before; those of t_n, `start`,
  /// where that motion is not known.
  Gaps expected_gaps(const State& old, double time, double dt, const Gaps& start) const;
  /// The pairs whose gaps in the middle of the step, `right`, are much nearer to the expected ones than to
  /// those of the start (State::steady_gaps).
  std::vector<char> steady_gaps(const Gaps& start, const Gaps& expected, const Gaps& right,
                                const State& warm) const;
  /// Heat at the configuration of t_n.
  /// @param through  the gaps; empty: those of t_n
  /// @param again    Newton's iteration starts from `warm`
  /// @param lead     set: what deformation is expected to take up
  StepEffort heat_at_rest(const State& old, State& warm, double time, double dt, const Gaps& through,
                          bool again, mechanics::StructuralLead& lead);
  /// The heat that passed through the gaps `used` at the temperatures found, [contact].
  std::vector<contact::GapHeat> gap_heat(const Gaps& used, const Gaps& right, const State& warm) const;
  /// Whether that is to be mended: more than the tolerance allows, and not little compared with all heat of
  /// the step.
  /// @param all  the sum over the interfaces
  bool misplaces_much(const contact::GapHeat& all, double dt, const StepEffort& conducted) const;
  /// Newton's start of a mechanical phase.
  struct Start {
    std::vector<double> displacement, pressure;
  };
  static Start extrapolated(const State& old, double dt);
  /// Equilibrium at t_{n+1}, and the works of contact. Returns the deformation.
  mechanics::StepDeformation mechanical_phase(const State& old, const State& warm, State& trial, double time,
                                              double dt, const Start& start, StepEffort& effort,
                                              const mechanics::StructuralLead* lead = nullptr);
  /// Heat at the deformation found, from `warm`, with the flow of the mechanical phase or a new one, which
  /// replaces it.
  void thermal_phase(const State& old, const State& warm, State& trial,
                     mechanics::StepDeformation& deformation, const heat::ThermalPass& pass,
                     StepEffort& effort, const mechanics::StructuralLead* lead = nullptr);

  Phases phases_;
  SequentialOptions options_;
};

}  // namespace solidus::coupling
