/// The kernel of the simultaneous scheme: the viscoplastic block (without flow it is viscoelastic) at the
/// temperature of the iterate, and the coupling parts of the exact tangent (monograph 4.1).
///
///   K_uΘ = ∫ B̄ᵀ σ_Θ N dV        K_Θu = ∫ M h_εᵀ B̄ dV        K_ΘΘ += ∫ M h_Θ N dV
///
///   energy form   h Δt = E − E_n − σ : Δε,      h_ε Δt = E_ε − (Cᵀ : Δε + σ),  h_Θ Δt = E_Θ − σ_Θ : Δε
///   entropy form  h Δt = Θ (S − S_n) − D Δt,    h_ε Δt = Θ S_ε − D_ε Δt,
///                                               h_Θ Δt = S − S_n + Θ S_Θ − D_Θ Δt
///
/// All derivatives are those along the update, flow and hardening eliminated (thermal_derivatives.hpp). M is
/// N and the share by which StructuralPoints spreads heat as it is stored.
#pragma once

#include "material/structural_lines.hpp"
#include "material/structural_partials.hpp"
#include "mechanics/coupled_kernel.hpp"
#include "mechanics/law_block.hpp"

namespace solidus::mechanics {

template <int n_nodes, AnalysisKind kind, bool b_bar>
class CoupledBlock final : public LawBlock<material::Viscoplastic, n_nodes, kind, b_bar>,
                           public CoupledKernel {
  using Base = LawBlock<material::Viscoplastic, n_nodes, kind, b_bar>;
  using Base::dim, Base::index, Base::nodes_of, Base::at_point, Base::gather;
  using typename Base::Operator, typename Base::Vectors;

 public:
  using Base::Base;

  void bind_heat(const algebra::BlockMatrix& matrix) override {
    heat_slots_ = {matrix, this->geometry_.nodes, n_nodes, this->geometry_.n_elements};
  }

  double prepare(const StepStart& start) override {
    initial_temperature_ = start.initial_temperature;
    this->points_.keep();
    return Base::prepare(start);
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, BlockHistory& trial) override {
    const BlockWork work = Base::finish(old_u, u, trial);
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
        before_[index(batch, q)] = {point.old_entropy, point.old_energy};
        next[index(batch, q)] = {point.old_entropy + Lane(factor) * (now.entropy - point.old_entropy),
                                 point.old_energy + Lane(factor) * (now.energy - point.old_energy)};
      }
    carried_ = std::move(next);
  }
  void drop_carried() override {
    count_from(before_);
    before_.clear();
    carried_.clear();
  }

  void add_coupling(StructuralForm form, std::span<const double> old_u, std::span<const double> u,
                    std::span<const double> temperature, algebra::CoupledMatrix& matrix) override {
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch), old_displacement = gather(old_u, batch);
      Element element;
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane theta = temperature_at(this->geometry_, batch, q, temperature);
        const Sym<Lane> strain = b.strain(displacement);
        const Point d = derivatives(form, batch, q, theta, strain, strain - b.strain(old_displacement));
        element.add(b, this->values_at(q), this->points_.spread(batch), this->geometry_.weight_at(batch, q),
                    d);
      }
      scatter(element, batch, matrix);
    }
  }

  std::size_t bytes() const override {
    return Base::bytes() + heat_slots_.bytes() +
           (carried_.capacity() + before_.capacity()) * sizeof(StructuralDensities);
  }

 private:
  /// Derivatives at a point: of the stress and of the heat per time [W/m³].
  struct Point {
    Sym<Lane> stress;       ///< σ_Θ [Pa/K]
    Sym<Lane> heat_strain;  ///< h_ε
    Lane heat_temperature;  ///< h_Θ
  };

  /// K_uΘ and K_Θu, [a][b][i] with a the row's node, and K_ΘΘ, [a][b].
  struct Element {
    std::array<std::array<std::array<Lane, dim>, n_nodes>, n_nodes> force{}, heat{};
    std::array<std::array<Lane, n_nodes>, n_nodes> capacity{};

    /// @param values, spread  N_a, M_a − N_a (none: zero)
    void add(const Operator& b, const double* values, const Lane* spread, Lane weight, const Point& d) {
      Vectors pull{}, heating{};
      b.add_force(weight * d.stress, pull);
      b.add_force(weight * d.heat_strain, heating);
      const Lane warming = weight * d.heat_temperature;
      for (std::size_t p = 0; p < n_nodes; ++p) {
        Lane test(values[p]);
        if (spread != nullptr) test += spread[p];
        for (std::size_t q = 0; q < n_nodes; ++q) {
          const Lane shape(values[q]);
          for (std::size_t i = 0; i < dim; ++i) {
            force[p][q][i] += pull[p][i] * shape;
            heat[p][q][i] += test * heating[q][i];
          }
          capacity[p][q] += test * shape * warming;
        }
      }
    }
  };

  /// Sets S and E from which the step counts, unless there are none.
  void count_from(const PackVector<StructuralDensities>& densities) {
    if (densities.empty()) return;
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch)
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        auto& point = this->points_.at(batch, q);
        point.old_entropy = densities[index(batch, q)].entropy;
        point.old_energy = densities[index(batch, q)].energy;
      }
  }

  /// The jets at the temperature of the iterate, phases held as in prepare().
  material::Viscoplastic::Properties<Jet<Lane>> jets(Index batch, int q, Lane theta) const {
    auto p =
        thermal_properties(this->law_, theta, temperature_at(this->geometry_, batch, q, initial_temperature_),
                           material::Frozen{.phase = true});
    const auto held = this->properties_[index(batch, q)].elastic;
    p.elastic.thermal_strain.v = held.thermal_strain;
    p.elastic.solid_fraction.v = held.solid_fraction;
    if (this->law_.material().chooses_viscosity()) p.elastic.viscosity = Jet<Lane>(held.viscosity);
    return p;
  }

  Point derivatives(StructuralForm form, Index batch, int q, Lane theta, const Sym<Lane>& strain,
                    const Sym<Lane>& increment) const {
    const auto start = this->start_state(batch, q);
    const auto p = jets(batch, q, theta);
    const auto r = this->law_.update(this->properties_[index(batch, q)], start, strain, this->effective_dt_);
    const material::Variation<Lane> update(this->law_, p, start, strain, this->effective_dt_, r);
    const auto& at = this->points_.at(batch, q);
    const auto partials = material::structural_partials<Lane>(
        this->law_.material(),
        material::along_lines(this->law_.material(), at.temperature, theta, at.strain_offset), theta,
        at.now.strain_trace, at.now.elastic_squared, p.elastic.solid_fraction.v >= Lane(1.0),
        at.now.hardening, at.now.back_squared);
    const Lane rate(1.0 / this->dt_);
    Point d;
    d.stress = update.stress();
    if (form == StructuralForm::energy) {
      const auto energy = update.along(partials.internal_energy);
      const Lane share(this->stress_share_);  // of σ in the stress at work
      d.heat_temperature = rate * (energy.temperature - share * dot(d.stress, increment));
      d.heat_strain = rate * (energy.strain - this->mean_stress(batch, q, r.stress) -
                              share * transposed_tangent(r, increment));
    } else {
      const auto entropy = update.along(partials.entropy);
      const auto dissipation = update.dissipation();
      d.heat_temperature =
          rate * (entropy.value - at.old_entropy + theta * entropy.temperature) - dissipation.temperature;
      d.heat_strain = Lane(rate * theta) * entropy.strain - dissipation.strain;
    }
    return d;
  }

  /// Cᵀ : a.
  static Sym<Lane> transposed_tangent(const typename Base::Response& r, const Sym<Lane>& a) {
    Sym<Lane> t = r.twice_shear * dev(a) + dot(r.left, a) * r.right;
    const Lane volumetric = r.bulk * trace(a);
    for (int i = 0; i < 3; ++i) t[i] += volumetric;
    return t;
  }

  void scatter(const Element& element, Index batch, algebra::CoupledMatrix& matrix) const {
    const algebra::BlockMatrix::Slot *const slots = this->slots_of(batch), *const heat_slots =
                                                                               heat_slots_.of(batch);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t b = 0; b < n_nodes; ++b) {
        const std::size_t pair = (a * n_nodes + b) * k_lanes;
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
          const auto l = static_cast<int>(lane);
          double* const force = matrix.force_by_temperature(slots[pair + lane]);
          double* const heat = matrix.heat_by_displacement(slots[pair + lane]);
          for (std::size_t i = 0; i < dim; ++i) {
            force[i] += element.force[a][b][i][l];
            heat[i] += element.heat[a][b][i][l];
          }
          *matrix.temperature().block(heat_slots[pair + lane]) += element.capacity[a][b][l];
        }
      }
  }

  std::span<const double> initial_temperature_;  ///< of the phase, which outlives the block
  algebra::LaneSlots heat_slots_;
  // Of the second stage, [batch][point]; else empty.
  PackVector<StructuralDensities> carried_;  ///< S*, E*
  PackVector<StructuralDensities> before_;   ///< S_n, E_n
};

}  // namespace solidus::mechanics
