/// The part of mechanics in the thermal phase of a split, at a fixed configuration: the deformation that it
/// holds, and the return mapping at the temperatures of the end of the step (4.45, 4.49, 4.54).
#include "mechanics/mechanical_restart.hpp"

#include <algorithm>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::mechanics {

StepDeformation held_deformation(MechanicalPhase& phase, const MechanicalState& state,
                                 std::span<const double> temperature, std::span<const double> plateau_share,
                                 bool expands) {
  const MechanicalBodies& bodies = phase.bodies();
  // The deformation of a state in which nothing moves, with what structural heat needs of it: both ends of
  // the step are the state itself.
  StepDeformation deformation;
  for (std::size_t b = 0; b < bodies.blocks.size(); ++b)
    deformation.push_back(bodies.blocks[b]->held_deformation(
        {.temperature = temperature,
         .pass_temperature = temperature,
         .initial_temperature = bodies.initial_temperature,
         .old_displacement = state.displacement,
         .held_displacement = state.displacement,
         .held_history = &state.history[b],
         .old_history = &state.history[b],
         .start_history = &state.history[b],
         .dt = 1,
         .effective = 1,
         .phases = bodies.nodal_phases.evaluate(b, {temperature, plateau_share}, {}),
         .melt = &bodies.melt[as_size(bodies.mesh.blocks[b].body)],
         .expands = expands}));
  // The kernels have been given another step, so that the last residual is none of theirs.
  phase.equations().forget_residual();
  return deformation;
}

FlowChange restart_flow(MechanicalPhase& phase, const MechanicalState& old, const MechanicalPass& pass,
                        std::span<const double> temperature, MechanicalState& trial,
                        StepDeformation& deformation) {
  const MechanicalBodies& bodies = phase.bodies();
  const profile::Part part("history");
  // The plastic flow of the step is computed again at the temperatures after the thermal phase, with the same
  // displacements: both the held and the old state are those of t_n.
  phase.equations().prepare(old, pass);
  deformation.resize(bodies.blocks.size());
  FlowChange total;
  auto failed = static_cast<double>(bodies.mesh.bodies.size());  // the first body whose law finds no state
  // Every block evaluates its points. The first body whose law finds no state is stored instead of thrown,
  // since all processes have to leave the loop together.
  for (std::size_t b = 0; b < bodies.blocks.size(); ++b) {
    const FlowChange change = bodies.blocks[b]->restart_flow(
        {.temperature = pass.temperature,
         .pass_temperature = temperature,
         .initial_temperature = bodies.initial_temperature,
         .old_displacement = old.displacement,
         .held_displacement = old.displacement,
         .held_history = &old.history[b],
         .old_history = &old.history[b],
         .start_history = &old.history[b],
         .dt = pass.dt,
         .effective = time_step(bodies.options, old, pass),
         .phases = bodies.nodal_phases.evaluate(b, fraction_place(pass), fractions_before(old, pass)),
         .melt = &bodies.melt[as_size(bodies.mesh.blocks[b].body)]},
        old.displacement, trial.displacement,
        {.history = trial.history[b],
         .elements = b < trial.elements.size() ? &trial.elements[b] : nullptr,
         .deformation = &deformation[b]});
    total.work += change.work;
    total.flows = total.flows || change.flows;
    if (!change.found) failed = std::min(failed, static_cast<double>(bodies.mesh.blocks[b].body));
  }
  if (const auto body = static_cast<std::size_t>(parallel::global_min(failed));
      body < bodies.mesh.bodies.size())
    throw StepRejected(
        "mechanics: the return mapping of the thermal phase finds no state at the temperatures of "
        "the step's end",
        "body '" + bodies.mesh.bodies[body].name + "'", Failure::law);
  // Work and dissipation are summed over the processes; the smallest and the largest dissipation are those of
  // all processes.
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
