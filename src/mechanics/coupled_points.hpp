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

#include "material/structural_lines.hpp"
#include "material/structural_partials.hpp"
#include "mechanics/coupled_kernel.hpp"
#include "mechanics/point_block.hpp"

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
    this->points_.keep();
    // Every iterate is a new start here, and the other parts of the tangent are the consistent ones.
    this->follows_directions_ = false;
    return Kernel::prepare(start);
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) override {
    const BlockWork work = Kernel::finish(old_u, u, end);
    count_from(carried_);
    return work;
  }

  void carry(double factor, std::span<const double> temperature) override {
    PackVector<StructuralDensities> next(this->properties_.size());
    before_.resize(next.size());
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch)
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        const auto& point = this->points_.at(batch, q);
        const StructuralDensities now =
            this->points_.densities(batch, q, temperature_at(this->geometry_, batch, q, temperature));
        const std::size_t i = this->index(batch, q);
        before_[i] = {point.old_entropy, point.old_energy};
        next[i] = {point.old_entropy + Lane(factor) * (now.entropy - point.old_entropy),
                   point.old_energy + Lane(factor) * (now.energy - point.old_energy)};
      }
    carried_ = std::move(next);
  }
  void drop_carried() override {
    count_from(before_);
    before_.clear();
    carried_.clear();
  }

  std::size_t bytes() const override {
    return Kernel::bytes() + heat_slots_.bytes() +
           (carried_.capacity() + before_.capacity()) * sizeof(StructuralDensities);
  }

 protected:
  /// Derivatives at a point: of the stress and of the heat per time [W/m³].
  struct Rates {
    Sym<Lane> stress;            ///< σ_Θ [Pa/K]
    Sym<Lane> heat_strain{};     ///< h_ε
    Lane heat_temperature{0.0};  ///< h_Θ
  };

  /// @param strain, increment  that the law sees, and since the start of the step
  Rates rates(std::optional<StructuralForm> form, Index batch, int q, Lane theta, const Sym<Lane>& strain,
              const Sym<Lane>& increment) const {
    const auto start = this->start_state(batch, q);
    const auto p = jets(batch, q, theta);
    const auto r = this->update(batch, q, strain);
    const material::Variation<Lane> update(this->law_, p, start, strain, this->effective_dt_, r);
    Rates d;
    d.stress = update.stress();
    if (!form) return d;
    const auto& at = this->points_.at(batch, q);
    const auto partials = material::structural_partials<Lane>(
        this->law_.material(),
        material::along_lines(this->law_.material(), at.line_temperature, theta, at.strain_offset), theta,
        at.now.strain_trace, at.now.elastic_squared, p.elastic.solid_fraction.v >= Lane(1.0),
        at.now.hardening, at.now.back_squared);
    const Lane rate(1.0 / this->dt_);
    if (form == StructuralForm::energy) {
      auto energy = update.along(partials.internal_energy);
      if (this->law_.material().flow && this->law_.material().flow->heat_share) {
        const auto stored = update.cold_work();
        energy.temperature += stored.temperature;
        energy.strain += stored.strain;
      }
      const Lane at_end(this->stress_share_);  // of σ in the stress at work
      d.heat_temperature = rate * (energy.temperature - at_end * dot(d.stress, increment));
      d.heat_strain = rate * (energy.strain - this->mean_stress(batch, q, r.stress) -
                              at_end * transposed_tangent(r, increment));
    } else {
      const auto entropy = update.along(partials.entropy);
      const auto dissipation = update.dissipation();
      d.heat_temperature =
          rate * (entropy.value - at.old_entropy + theta * entropy.temperature) - dissipation.temperature;
      d.heat_strain = Lane(rate * theta) * entropy.strain - dissipation.strain;
    }
    return d;
  }

  /// The jets at the temperature of the iterate, phases held as in prepare().
  material::Viscoplastic::Properties<Jet<Lane>> jets(Index batch, int q, Lane theta) const {
    auto p =
        thermal_properties(this->law_, theta, temperature_at(this->geometry_, batch, q, initial_temperature_),
                           material::Frozen{.phase = true});
    const auto held = this->properties_[this->index(batch, q)].elastic;
    p.elastic.thermal_strain.v = held.thermal_strain;
    p.elastic.solid_fraction.v = held.solid_fraction;
    if (this->law_.material().chooses_viscosity()) p.elastic.viscosity = Jet<Lane>(held.viscosity);
    return p;
  }

  const linear::BlockMatrix::Slot* heat_slots_of(Index batch) const { return heat_slots_.of(batch); }

 private:
  /// Cᵀ : a.
  template <class Response>
  static Sym<Lane> transposed_tangent(const Response& r, const Sym<Lane>& a) {
    Sym<Lane> t = r.twice_shear * dev(a) + dot(r.left, a) * r.right;
    const Lane volumetric = r.bulk * trace(a);
    for (int i = 0; i < 3; ++i) t[i] += volumetric;
    return t;
  }

  /// Sets S and E from which the step counts, unless there are none.
  void count_from(const PackVector<StructuralDensities>& densities) {
    if (densities.empty()) return;
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch)
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        auto& point = this->points_.at(batch, q);
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
