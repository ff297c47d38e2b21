/// The part of mechanics in the thermal phase of a split, at a fixed configuration: the deformation that it
/// holds, and the return mapping at the temperatures of the end of the step (4.45, 4.49, 4.54).

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::mechanics {

StepDeformation MechanicalPhase::held_deformation(const MechanicalState& state,
                                                  std::span<const double> temperature,
                                                  std::span<const double> plateau_share, bool expands) {
  // The deformation of a state in which nothing moves, with what structural heat needs of it: both ends of
  // the step are the state itself.
  StepDeformation deformation;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    deformation.push_back(
        blocks_[b]->held_deformation({.temperature = temperature,
                                      .pass_temperature = temperature,
                                      .initial_temperature = initial_temperature_,
                                      .old_displacement = state.displacement,
                                      .held_displacement = state.displacement,
                                      .held_history = &state.history[b],
                                      .old_history = &state.history[b],
                                      .start_history = &state.history[b],
                                      .dt = 1,
                                      .effective = 1,
                                      .phases = nodal_phases_.evaluate(b, {temperature, plateau_share}, {}),
                                      .melt = &melt_[static_cast<std::size_t>(mesh_.blocks[b].body)],
                                      .expands = expands}));
  // The kernels have been given another step, so that the last residual is none of theirs.
  residual_is_known_ = false;
  return deformation;
}

FlowChange MechanicalPhase::restart_flow(const MechanicalState& old, const MechanicalPass& pass,
                                         std::span<const double> temperature, MechanicalState& trial,
                                         StepDeformation& deformation) {
  const profile::Part part("history");
  // The flow of the step is found again at the temperatures that heat has reached, at the same displacements:
  // both the held and the old state are those of t_n.
  prepare(old, pass);
  deformation.resize(blocks_.size());
  FlowChange total;
  auto failed = static_cast<double>(mesh_.bodies.size());  // the first body whose law finds no state
  // Every block does its points. The first body whose law finds no state is remembered instead of thrown,
  // since all processes have to leave the loop together.
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const FlowChange change = blocks_[b]->restart_flow(
        {.temperature = pass.temperature,
         .pass_temperature = temperature,
         .initial_temperature = initial_temperature_,
         .old_displacement = old.displacement,
         .held_displacement = old.displacement,
         .held_history = &old.history[b],
         .old_history = &old.history[b],
         .start_history = &old.history[b],
         .dt = pass.dt,
         .effective = time_step(old, pass),
         .phases = nodal_phases_.evaluate(b, fraction_place(pass), fractions_before(old, pass)),
         .melt = &melt_[static_cast<std::size_t>(mesh_.blocks[b].body)]},
        old.displacement, trial.displacement,
        {.history = trial.history[b],
         .elements = b < trial.elements.size() ? &trial.elements[b] : nullptr,
         .deformation = &deformation[b]});
    total.work += change.work;
    total.flows = total.flows || change.flows;
    if (!change.found) failed = std::min(failed, static_cast<double>(mesh_.blocks[b].body));
  }
  if (const auto body = static_cast<std::size_t>(parallel::global_min(failed)); body < mesh_.bodies.size())
    throw StepRejected(
        "mechanics: the return mapping of the thermal phase finds no state at the temperatures of "
        "the step's end",
        "body '" + mesh_.bodies[body].name + "'", Failure::law);
  // Work and dissipation are summed over the processes; of the smallest and largest dissipation the extremes
  // count.
  total.flows = parallel::any_process(total.flows);
  BlockWork& work = total.work;
  double sums[] = {work.dissipation, work.plastic_dissipation, work.plastic_work, work.inelastic_entropy};
  processes::sum(sums);
  work.dissipation = sums[0];
  work.plastic_dissipation = sums[1];
  work.plastic_work = sums[2];
  work.inelastic_entropy = sums[3];
  work.least_dissipation = parallel::global_min(work.least_dissipation);
  work.largest_dissipation = parallel::global_max(work.largest_dissipation);
  return total;
}

}  // namespace solidus::mechanics
