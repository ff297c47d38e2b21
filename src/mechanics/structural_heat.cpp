/// The form of the exchange is the same for all blocks; each block adds its points' heat at the points or
/// at the nodes, as its body stores heat.
#include "mechanics/structural_heat.hpp"

#include <algorithm>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/structural_points.hpp"
#include "mechanics/mechanical_restart.hpp"
#include "mechanics/new_bodies.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

struct StructuralHeat::Stages {
  std::vector<StructuralPoints::Stage> of_block;
};

StructuralHeat::StructuralHeat(const MechanicalPhase& phase, StructuralForm form, bool closed)
    : phase_(phase), form_(form), stages_(std::make_unique<Stages>()) {
  // A body that changes phase at one temperature stores heat at its nodes whatever the rule is.
  for (const mesh::ElementBlock& block : phase.mesh().blocks)
    at_nodes_.push_back(closed || phase.bodies().material(block.body).changes_isothermally());
  spread_heat_as_stored(phase, closed);
}

StructuralHeat::~StructuralHeat() = default;

/// A new deformation starts with the stage of a one-stage step over its whole length.
void StructuralHeat::set_deformation(StepDeformation deformation) {
  deformation_ = std::move(deformation);
  stages_->of_block.clear();
  for (const auto& points : deformation_) stages_->of_block.push_back({{points ? points->dt() : 0.0, 0}, {}});
}

/// Blocks add to an array with room for ghosts, of which the owned part is the residual.
void StructuralHeat::add_residual(std::span<const double> temperature, std::span<double> r) {
  work_.assign(temperature.size(), 0.0);
  for (std::size_t b = 0; b < deformation_.size(); ++b)
    if (deformation_[b]) deformation_[b]->add_heat(form_, stages_->of_block[b], temperature, false, work_);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += work_[i];
}

void StructuralHeat::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) {
  if (!has_tangent_) return;
  work_.assign(temperature.size(), 0.0);
  slots_.resize(deformation_.size());
  // Heat that goes to the nodes has slopes on the diagonal; heat at points has those of its elements.
  for (std::size_t b = 0; b < deformation_.size(); ++b) {
    if (!deformation_[b]) continue;
    if (at_nodes_[b]) {
      deformation_[b]->add_heat(form_, stages_->of_block[b], temperature, true, work_);
      continue;
    }
    if (!slots_[b]) slots_[b] = deformation_[b]->slots(matrix);
    deformation_[b]->add_heat_tangent(form_, stages_->of_block[b], temperature, *slots_[b], matrix);
  }
  // The diagonal of the nodes' own heat, at once for all blocks.
  for (Index node = 0; node < phase_.mesh().n_owned_nodes; ++node)
    *matrix.diagonal_block(node) += work_[as_size(node)];
}

void StructuralHeat::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> temperature) {
  for (std::size_t b = 0; b < deformation_.size(); ++b)
    if (deformation_[b]) stages_->of_block[b] = deformation_[b]->stage(stage, temperature);
}

/// Changes of the structural energy and entropy in a step, summed over blocks and processes.
StructuralChange structural_change(const StepDeformation& deformation, std::span<const double> temperature) {
  StructuralChange total;
  for (const auto& points : deformation) {
    if (!points) continue;
    const StructuralChange part = points->change(temperature);
    total.energy += part.energy;
    total.entropy += part.entropy;
    total.transformed += part.transformed;
    total.spread += part.spread;
  }
  return {parallel::global_sum(total.energy), parallel::global_sum(total.entropy),
          parallel::global_sum(total.transformed), parallel::global_sum(total.spread)};
}

StructuralChange mechanical_change(const StepDeformation& deformation) {
  StructuralChange total;
  for (const auto& points : deformation) {
    if (!points) continue;
    const StructuralChange part = points->mechanical_change();
    total.energy += part.energy;
    total.entropy += part.entropy;
  }
  return {parallel::global_sum(total.energy), parallel::global_sum(total.entropy)};
}

/// Heat of the free expansion to a temperature, for the thermal phase that precedes the mechanical one.
StructuralLead expected_expansion(const StepDeformation& held, std::span<const double> temperature) {
  StructuralLead lead;
  for (const auto& points : held)
    lead.push_back(points ? points->expected(temperature) : PackVector<StructuralDensities>{});
  return lead;
}

double excess_work(const StepDeformation& deformation) {
  double total = 0;
  for (const auto& points : deformation)
    if (points) total += points->excess_work();
  return parallel::global_sum(total);
}

double structural_energy(MechanicalPhase& phase, const MechanicalState& state,
                         std::span<const double> temperature, std::span<const double> plateau_share) {
  double total = 0;
  for (const auto& points : held_deformation(phase, state, temperature, plateau_share))
    if (points) total += points->energy(temperature);
  return parallel::global_sum(total);
}

}  // namespace solidus::mechanics
