#include "mechanics/structural_heat.hpp"

#include <algorithm>

#include "mechanics/block_kernel.hpp"
#include "mechanics/new_bodies.hpp"
#include "mechanics/structural_points.hpp"

namespace solidus::mechanics {

StructuralHeat::StructuralHeat(const MechanicalPhase& phase, StructuralForm form, bool closed)
    : phase_(phase), form_(form), closed_(closed) {
  spread_heat_as_stored(phase, closed);
}

void StructuralHeat::add_residual(std::span<const double> temperature, std::span<double> r) {
  work_.assign(temperature.size(), 0.0);
  for (const auto& block : phase_.blocks()) block->add_structural_heat(form_, temperature, false, work_);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += work_[i];
}

void StructuralHeat::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) {
  if (!has_tangent_) return;
  work_.assign(temperature.size(), 0.0);
  for (const auto& block : phase_.blocks()) block->add_structural_heat(form_, temperature, true, work_);
  for (Index node = 0; node < phase_.mesh().n_owned_nodes; ++node) {
    const double entry = work_[static_cast<std::size_t>(node)];
    *matrix.diagonal_block(node) += closed_ ? entry : std::max(entry, 0.0);
  }
}

void StructuralHeat::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> temperature) {
  for (const auto& block : phase_.blocks()) block->begin_heat_stage(stage, temperature);
}

StructuralChange StructuralHeat::change(std::span<const double> temperature) const {
  StructuralChange total;
  for (const auto& block : phase_.blocks()) {
    const StructuralChange part = block->structural_points().change(temperature);
    total.energy += part.energy;
    total.entropy += part.entropy;
    total.transformed += part.transformed;
  }
  return {parallel::global_sum(total.energy), parallel::global_sum(total.entropy),
          parallel::global_sum(total.transformed)};
}

double StructuralHeat::energy(MechanicalPhase& phase, const MechanicalState& state,
                              std::span<const double> temperature,
                              std::span<const double> plateau_share) const {
  phase.hold_deformation(state, temperature, plateau_share);
  double total = 0;
  for (const auto& block : phase.blocks()) total += block->structural_points().energy(temperature);
  return parallel::global_sum(total);
}

StructuralChange StructuralHeat::mechanical_change() const {
  StructuralChange total;
  for (const auto& block : phase_.blocks()) {
    const StructuralChange part = block->structural_points().mechanical_change();
    total.energy += part.energy;
    total.entropy += part.entropy;
  }
  return {parallel::global_sum(total.energy), parallel::global_sum(total.entropy)};
}

}  // namespace solidus::mechanics
