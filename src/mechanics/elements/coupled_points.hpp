/// Common part of the kernels of the simultaneous scheme, added to those of any element formulation: the law
/// at the temperature of the iterate, the derivatives of stress and heat at a point, and the entropy and
/// energy that the second stage of a two-stage method starts from.
///
///   energy form   h Δt = E − E_n − σ : Δε,      h_ε Δt = E_ε − (Cᵀ : Δε + σ),  h_Θ Δt = E_Θ − σ_Θ : Δε
///   entropy form  h Δt = Θ (S − S_n) − D Δt,    h_ε Δt = Θ S_ε − D_ε Δt,
///                                               h_Θ Δt = S − S_n + Θ S_Θ − D_Θ Δt
///
/// All derivatives are those along the update, flow and hardening eliminated (thermal_derivatives.hpp).
#pragma once

#include "mechanics/elements/coupled_kernel.hpp"
#include "mechanics/elements/coupled_rates.hpp"
#include "mechanics/elements/point_block.hpp"

namespace solidus::mechanics {

/// @tparam Kernel  a kernel of material::Viscoplastic that derives from PointBlock
template <class Kernel>
class CoupledPoints : public Kernel, public CoupledKernel {
 public:
  using Kernel::Kernel;

  void bind_heat(const linear::BlockMatrix& matrix) override {
    heat_slots_ = {matrix, this->geometry_.nodes, this->geometry_.n_nodes, this->geometry_.n_elements};
  }

  double prepare(const StepStart& start) override {
    initial_temperature_ = start.initial_temperature;
    this->points_->keep();
    // Every iterate is a new start here, and the other parts of the tangent are the consistent ones.
    this->follows_directions_ = false;
    return Kernel::prepare(start);
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) override {
    BlockEnd kept = end;
    kept.deformation = nullptr;
    const BlockWork work = Kernel::finish(old_u, u, kept);
    count_from(carried_);
    this->hand_out_deformation(end);
    return work;
  }

  void carry(double factor, const StructuralPoints* first, std::span<const double> temperature) override {
    PackVector<StructuralDensities> next(this->properties_.size());
    before_.resize(next.size());
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch)
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        const auto& point = first->at(batch, q);
        const StructuralDensities now =
            first->densities(batch, q, temperature_at(this->geometry_, batch, q, temperature));
        const std::size_t i = this->index(batch, q);
        before_[i] = {point.old_entropy, point.old_energy};
        next[i] = {point.old_entropy + Lane(factor) * (now.entropy - point.old_entropy),
                   point.old_energy + Lane(factor) * (now.energy - point.old_energy)};
      }
    carried_ = std::move(next);
  }
  std::shared_ptr<const StructuralPoints> drop_carried() override {
    this->own_points();
    count_from(before_);
    before_.clear();
    carried_.clear();
    return this->points_;
  }

  std::size_t bytes() const override {
    return Kernel::bytes() + heat_slots_.bytes() +
           (carried_.capacity() + before_.capacity()) * sizeof(StructuralDensities);
  }

 protected:
  using Rates = CoupledRates;

  /// @param strain, increment  that the law sees, and since the start of the step
  Rates rates(std::optional<StructuralForm> form, Index batch, int q, Lane theta, const Sym<Lane>& strain,
              const Sym<Lane>& increment) const {
    const auto start = this->start_state(batch, q);
    const auto p = jets(batch, q, theta);
    const auto r = this->update(batch, q, strain);
    const Sym<Lane> at_work = this->stress_of_work_.mean_at(this->index(batch, q), r.stress);
    return coupled_rates({this->law_, p, start, r, strain, increment, at_work, this->points_->at(batch, q),
                          theta, this->dt_, this->effective_, this->stress_of_work_.share()},
                         form);
  }

  /// The jets at the temperature of the iterate, phases held as in prepare().
  material::Viscoplastic::Properties<Jet<Lane>> jets(Index batch, int q, Lane theta) const {
    return coupled_properties(this->law_, theta,
                              temperature_at(this->geometry_, batch, q, initial_temperature_),
                              this->properties_[this->index(batch, q)].elastic);
  }

  const linear::BlockMatrix::Slot* heat_slots_of(Index batch) const { return heat_slots_.of(batch); }

 private:
  /// Sets S and E from which the step counts, unless there are none.
  void count_from(const PackVector<StructuralDensities>& densities) {
    if (densities.empty()) return;
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch)
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        auto& point = this->points_->at(batch, q);
        point.old_entropy = densities[this->index(batch, q)].entropy;
        point.old_energy = densities[this->index(batch, q)].energy;
      }
  }

  std::span<const double> initial_temperature_;  ///< of the phase, which outlives the block
  linear::LaneSlots heat_slots_;
  // Data of the second stage, [batch][point]; else empty.
  PackVector<StructuralDensities> carried_;  ///< S*, E*
  PackVector<StructuralDensities> before_;   ///< S_n, E_n
};

/// The share of a node in the heat of a point: its basis function and what StructuralPoints::spread adds, so
/// that heat is spread as the thermal phase stores it.
inline Lane heat_share(const double* values, const Lane* spread, std::size_t node) {
  const Lane share(values[node]);
  return spread == nullptr ? share : share + spread[node];
}

}  // namespace solidus::mechanics
