#include "mechanics/mechanical_bodies.hpp"

#include <algorithm>
#include <utility>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/loads/inertial_forces.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "numbers/index_casts.hpp"
#include "system/common_failure.hpp"
#include "system/profile.hpp"

namespace solidus::mechanics {

std::vector<double> densities(const std::vector<material::Material>& materials) {
  std::vector<double> density;
  for (const material::Material& material : materials) density.push_back(material.density);
  return density;
}

MechanicalBodies::MechanicalBodies(const mesh::Mesh& of, AnalysisKind analysis,
                                   const std::vector<material::Material>& of_bodies,
                                   std::span<const double> at_start, MechanicalConditions conditions,
                                   MechanicsOptions chosen, std::vector<linear::Contribution*> terms)
    : mesh(of),
      kind(analysis),
      materials(of_bodies),
      components(displacement_components(analysis)),
      options(std::move(chosen)),
      contributions(std::move(terms)),
      active(of, conditions.absent_bodies),
      loads(std::make_unique<Loads>(of, analysis, std::move(conditions), active, std::span<const double>{},
                                    densities(of_bodies))),
      ghosts(of),
      balance(of, active, components),
      initial_temperature(at_start.begin(), at_start.end()),
      nodal_phases(of, of_bodies, at_start) {
  // Sub-scales are algebraic in quasi-statics and orthogonal with inertia, unless the case says otherwise.
  if (options.stabilisation == Stabilisation::automatic)
    options.stabilisation = options.dynamics ? Stabilisation::orthogonal : Stabilisation::algebraic;
  // Inertia counts active bodies alone: an absent body has no mass.
  if (!options.dynamics) return;
  std::vector<double> density;
  for (std::size_t b = 0; b < materials.size(); ++b)
    density.push_back(active.body(static_cast<int>(b)) ? materials[b].density : 0.0);
  inertia = std::make_unique<InertialForces>(mesh, kind, components, density, *options.dynamics);
}

MechanicalBodies::~MechanicalBodies() = default;

void MechanicalBodies::set_body_force(double time) {
  run_collectively([&] {
    // Mixed elements stabilise with the residual of equilibrium, in which body forces are a term.
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      auto* const kernel = dynamic_cast<MixedKernel*>(blocks[b].get());
      if (kernel == nullptr) continue;
      const mesh::ElementBlock& block = mesh.blocks[b];
      const double density = material(block.body).density;
      std::vector<double> force(3 * as_size(block.size()));
      for (std::size_t i = 0; i < force.size(); ++i) force[i] = density * loads->conditions().gravity[i % 3];
      loads->add_body_forces(block, time, force);
      kernel->set_body_force(force);
    }
  });
}

std::size_t MechanicalBodies::n_unknowns() const {
  return n_displacements() + (pressure ? pressure->absent().size() : 0);
}

std::size_t MechanicalBodies::n_residuals() const {
  return n_forces() + (pressure ? as_size(mesh.n_owned_nodes * pressure->fields().n_fields) : std::size_t{0});
}

/// The first guess of Newton's iteration: an iterate of the phases, an extrapolation, or the old state, with
/// the prescribed displacements of the new time.
std::vector<double> MechanicalBodies::start(const MechanicalState& old, const MechanicalPass& pass) const {
  const MechanicalState& from = pass.iterate != nullptr ? *pass.iterate : old;
  std::vector<double> x(n_unknowns());
  const std::span<const double> u =
      pass.start.empty() ? std::span<const double>(from.displacement) : pass.start;
  std::copy(u.begin(), u.end(), x.begin());
  loads->prescribe(pass.time, std::span(x).first(u.size()));
  if (pressure) to_unknowns(*pressure, from.pressure, std::span(x).subspan(u.size()));
  return x;
}

BlockWork MechanicalBodies::finish(const MechanicalState& old, std::span<const double> x,
                                   std::vector<BlockHistory>& history, std::vector<BlockHistory>* stress,
                                   std::vector<StressAtWork>* at_work,
                                   std::vector<SharedElementValues>* elements,
                                   StepDeformation* deformation) const {
  const profile::Part part("history");
  // What the last iterate has found becomes history, block by block. Storage that is there already is
  // overwritten.
  const std::span<const double> u = x.first(n_displacements());
  BlockWork total;
  history.resize(blocks.size());
  if (at_work != nullptr) at_work->resize(blocks.size());
  if (elements != nullptr) elements->resize(blocks.size());
  if (deformation != nullptr) deformation->resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    history[b].n_components = old.history[b].n_components;
    history[b].n_points = old.history[b].n_points;
    // Blocks of absent bodies keep the layout that a checkpoint expects, with zeros.
    if (active.body(mesh.blocks[b].body)) {
      history[b].values.resize(old.history[b].values.size());
    } else {  // of the layout that a checkpoint knows
      history[b].values.assign(old.history[b].values.size(), Lane(0.0));
      if (elements != nullptr) (*elements)[b].reset();
    }
    total += blocks[b]->finish(old.displacement, u,
                               {.history = history[b],
                                .stress = stress != nullptr ? &(*stress)[b] : nullptr,
                                .at_work = at_work != nullptr ? &(*at_work)[b] : nullptr,
                                .elements = elements != nullptr ? &(*elements)[b] : nullptr,
                                .deformation = deformation != nullptr ? &(*deformation)[b] : nullptr});
  }
  return total;
}

}  // namespace solidus::mechanics
