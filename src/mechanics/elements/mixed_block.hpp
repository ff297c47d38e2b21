/// The mixed kernel of linear triangles and tetrahedra (mixed_kernel.hpp): any law, eight elements at a time.
#pragma once

#include "mechanics/elements/compaction.hpp"
#include "mechanics/elements/mixed_parts.hpp"
#include "mechanics/elements/point_block.hpp"
#include "mechanics/elements/pores.hpp"
#include "mechanics/elements/pressure_nodes.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind>
class MixedBlock : public PointBlock<Law, n_nodes, kind, false, k_mixed_extra<n_nodes, kind>>,
                   public PressureNodes<n_nodes, kind> {
  using Base = PointBlock<Law, n_nodes, kind, false, k_mixed_extra<n_nodes, kind>>;
  using Nodes = PressureNodes<n_nodes, kind>;

 protected:
  using Base::dim, Base::gather, Base::geometry_, Base::nodes_of, Base::layout_;
  using Nodes::at, Nodes::at_point, Nodes::weight, Nodes::mean, Nodes::masses;
  using typename Base::State, typename Base::Properties, typename Base::Response, typename Base::Matrix;
  using typename Nodes::Slot;
  static_assert(IsotropicTangent<Response>);
  static constexpr bool adiabatic = AdiabaticTangent<Response>;

 public:
  using typename Base::Operator, typename Base::Vectors, typename Nodes::Nodal;

  MixedBlock(const mesh::Mesh& mesh, const mesh::ElementBlock& block, const material::Material& material,
             Stabilisation stabilisation)
      : Base(mesh, block, material),
        Nodes(mesh, block, Base::geometry_, material, stabilisation),
        compaction_(material, this->flow_.flows(), n_batches()),
        pores_(material, n_batches()) {
    const auto n = as_size(n_batches());
    volume_.resize(n, Lane(0.0));
    old_volume_.resize(n, Lane(0.0));
    old_divergence_.resize(n, Lane(0.0));
    if constexpr (adiabatic) tangent_.resize(n);
    if (this->flow_.flows()) layout_.add_extra(dim + 2);
  }

  bool set_initial_stress(const StepStart& start, std::span<const double> stress) override {
    const bool can = Base::set_initial_stress(start, stress);
    this->strain_at_start_ = this->initial_strain_;
    return can;
  }
  BlockHistory initial_history() const override {
    BlockHistory history = Base::initial_history();
    for (Index batch = 0; batch < n_batches(); ++batch)
      if (const Sym<Lane>* strain = this->initial_strain(batch, 0))
        keep_volume(history, batch, trace(*strain));
    return history;
  }

  double prepare(const StepStart& start) override {
    // The state of the step: volumes kept, properties, pores, flow of melt, compaction, stabilisation.
    this->begin_step(start);
    Lane scale(0.0);
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const std::size_t i = at(batch);
      const Operator b = at_point(batch);
      volume_[i] = kept_volume(*start.held_history, batch);
      old_volume_[i] = kept_volume(*start.old_history, batch);
      old_divergence_[i] = trace(b.strain(gather(start.old_displacement, batch)));
      const Sym<Lane> held = strain(b.strain(gather(start.held_displacement, batch)), volume_[i]);
      const Lane bulk = this->set_properties(start, batch, 0, held);
      pores_.begin_step(batch, this->phase_at(start, batch, 0).solid_fraction, start.melt_modulus(),
                        kept_pores(*start.old_history, batch));
      if (this->flow_.flows()) {
        const Lane fraction = this->phase_at(start, batch, 0).solid_fraction;
        this->flow_.begin_step(batch, fraction, start.dt, kept_flow(*start.old_history, batch));
        compaction_.begin_step(batch, network(start, batch, fraction));
      }
      Lane stiffness = bulk;
      if constexpr (adiabatic) {
        tangent_[i] = volume_tangent(this->update(batch, 0, held));
        stiffness = tangent_[i].stiffness;
      }
      const Properties at_start = stabilisation_properties(start, batch);
      this->set_step(batch, b,
                     secant_shear(this->law_, at_start, this->start_state(batch, 0), this->effective_.dt),
                     elastic_part(this->law_, at_start).bulk, Lane(1.0) / stiffness);
      Vectors f{};
      this->add_stiffness(b, bulk * weight(batch), f);
      scale += this->counted(batch) * this->squares(f);
    }
    return sum(scale);
  }

  double add_forces(std::span<const double> u, std::span<double> forces) override {
    // Each batch evaluates the law at its displacement and pressure. Its forces and its defect of volume are
    // then scattered to the nodes; the sum of the squared forces is returned.
    Lane total(0.0);
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      const Vectors displacement = gather(u, batch);
      const Sym<Lane> gradient = b.strain(displacement);
      const Nodal p = this->gather_pressure(this->field_.pressure, batch), mass = masses(batch);
      const Lane mean_pressure = mean(p, batch), pores = pores_.fraction(batch, mean_pressure);
      const MixedPoint point = answer(batch, gradient, mean_pressure);
      // Forces come from deviator, compaction and nodal pressure; the defect is that of the volume.
      Vectors f{};
      Sym<Lane> effective = dev(point.response.stress);
      const Lane compacting = compaction_.stress(batch, trace(gradient));
      for (int k = 0; k < 3; ++k) effective[k] += compacting;
      b.add_force(weight(batch) * effective, f);
      this->add_pressure_force(b, batch, p, f);
      Nodal defect = this->volume_change(b, batch, displacement), change;
      const Lane changed =
          abs(trace(gradient) - old_divergence_[at(batch)]) + abs(point.volume - old_volume_[at(batch)]);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        defect[a] -= mass[a] * (point.volume + pores);
        change[a] = mass[a] * changed;
      }
      this->subtract_stabilisation(b, batch, p, defect);
      if (point.response.status != material::Status::converged) this->invalidate(f);
      total += this->counted(batch) * this->squares(f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), forces);
      this->scatter_pressure(defect, batch, this->field_.volume_residual);
      this->scatter_pressure(change, batch, this->field_.volume_change);
    }
    return sum(total);
  }

  void add_tangent(std::span<const double> u, linear::BlockMatrix& matrix) override {
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      const Lane w = weight(batch);
      const Lane pressure = mean(this->gather_pressure(this->field_.pressure, batch), batch);
      const auto response = answer(batch, b.strain(gather(u, batch)), pressure).response;
      this->pore_compliance_[at(batch)] = pores_.compliance(batch, pressure);
      this->tangent_shear_[at(batch)] = max(response.twice_shear, Lane(k_least_shear) * response.bulk);
      Matrix symmetric;
      std::optional<Matrix> skew;
      if (!this->law_.symmetric()) skew.emplace();
      add_isotropic(b, w * compaction_.stiffness(batch), w * response.twice_shear, symmetric);
      if constexpr (RankOneTangent<Response>) this->add_flow(b, batch, 0, response, w, symmetric, skew);
      if constexpr (adiabatic) {
        VolumeTangent& t = tangent_[at(batch)];
        t = volume_tangent(response);
        this->add_rank_one(b, t.thermal_left, t.thermal_right, w * t.factor, Lane(1.0), symmetric, skew);
      }
      scatter<1>(symmetric, this->slots_of(batch), matrix);
      if (skew) scatter<-1>(*skew, this->slots_of(batch), matrix);
    }
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) override {
    auto* const averages = this->begin_finish(end);
    BlockHistory& trial = end.history;
    StepSums sums;
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      const Sym<Lane> old_gradient = b.strain(old_displacement), gradient = b.strain(displacement);
      const Lane old_volume = kept_volume(*this->old_history_, batch);
      const Lane mean_pressure = mean(this->gather_pressure(this->field_.pressure, batch), batch);
      const MixedPoint point = answer(batch, gradient, mean_pressure);
      typename Base::Average average;
      const Sym<Lane> at_work = this->record(batch, 0, strain(old_gradient, old_volume), point.strain,
                                             point.response, end, average, sums);
      keep_volume(trial, batch, point.volume);
      const Lane pores = pores_.fraction(batch, mean_pressure);
      trial.values[layout_.extra(at(batch)) + 1] = pores;
      keep_pores(batch, pores, averages);
      keep_flow(trial, batch);
      // The work of the pressure on the difference of the volumes is taken up by the sub-scales, the pores
      // and the flow of melt; that of compaction by its viscosity.
      const Nodal now = this->volume_change(b, batch, displacement),
                  before = this->volume_change(b, batch, old_displacement);
      const Nodal variation = variation_at_work(batch, end);
      const Lane pressure = Lane(1.0 / 3.0) * trace(at_work);
      const Lane compacting = compaction_at_work(batch, trace(gradient), end);
      Lane left_over = weight(batch) * (pressure * (old_volume - point.volume) +
                                        compacting * (trace(gradient) - old_divergence_[at(batch)]));
      for (std::size_t a = 0; a < n_nodes; ++a) left_over += (pressure + variation[a]) * (now[a] - before[a]);
      sums.stabilisation_work += this->counted(batch) * left_over;
      this->keep(batch, average, averages);
    }
    this->hand_out_deformation(end);
    return sums.total(this->dt_);
  }

  void release_pores() override { pores_.release(); }
  bool fill_pores() override {
    bool filled = false;
    for (Index batch = 0; batch < n_batches(); ++batch)
      filled |= pores_.fill(batch, mean(this->gather_pressure(this->field_.pressure, batch), batch));
    return filled;
  }

  FlowChange restart_flow(const StepStart& start, std::span<const double> old_u, std::span<const double> u,
                          const BlockEnd& end) override {
    BlockHistory& trial = end.history;
    auto* const averages = this->begin_restart(end);
    typename Base::Restart restart;
    Workspace<Law> space(this->law_);
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      typename Base::Average average;
      this->restart_point(
          start, batch, 0, strain(b.strain(gather(old_u, batch)), kept_volume(*this->old_history_, batch)),
          strain(b.strain(gather(u, batch)), kept_volume(trial, batch)), space, trial, average, restart);
      this->keep(batch, average, averages);
      keep_pores(batch, kept_pores(trial, batch), averages);
    }
    this->hand_out_deformation(end);
    return this->total(restart);
  }

  std::shared_ptr<const StructuralPoints> held_deformation(const StepStart& start) override {
    prepare(start);
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Sym<Lane> gradient = at_point(batch).strain(gather(start.held_displacement, batch));
      this->hold_point(batch, 0, strain(gradient, volume_[at(batch)]));
    }
    return this->deformation_held(start);
  }

  LawFailure failure(std::span<const double> u) const override {
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Sym<Lane> gradient = at_point(batch).strain(gather(u, batch));
      LawFailure found = this->failure_at(batch, 0, strain(gradient, volume_[at(batch)]));
      if (!found.text.empty()) return found;
    }
    return {};
  }

  FlowingVolume flowing(std::span<const double> u) const override {
    FlowingVolume volume;
    for (Index batch = 0; batch < n_batches(); ++batch)
      this->add_flowing(batch, 0, strain(at_point(batch).strain(gather(u, batch)), volume_[at(batch)]),
                        volume);
    return volume;
  }

  /// ∫ N_a dV: in axisymmetry exact, as the pressure's forces are, so that a liquid column rests.
  void add_nodal_volume(double factor, std::span<double> out) const override {
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Nodal mass = masses(batch);
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t lane = 0; lane < k_lanes; ++lane)
          out[as_size(nodes_of(batch)[a * k_lanes + lane])] += factor * mass[a][static_cast<int>(lane)];
    }
  }

  std::size_t bytes() const override {
    return Base::bytes() + this->bytes_of_nodes() +
           (volume_.capacity() + old_volume_.capacity() + old_divergence_.capacity()) * sizeof(Lane) +
           tangent_.capacity() * sizeof(VolumeTangent) + pores_.bytes() + compaction_.bytes();
  }

  void add_augmentation(double factor, std::span<const double> stiffness,
                        linear::BlockMatrix& displacement) const override {
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      Matrix symmetric;
      Vectors divergence{};
      b.add_force(Sym<Lane>::identity(), divergence);
      Lane total(0.0);
      for (const Lane& value : this->gather_pressure(stiffness, batch)) total += value;
      add_product(divergence, Lane(factor / n_nodes) * weight(batch) * total, symmetric);
      scatter<1>(symmetric, this->slots_of(batch), displacement);
    }
  }

  void add_saddle(double unit, linear::SaddleMatrix& matrix) const override {
    const auto fields = as_size(this->field_.n_fields), field = as_size(this->field_.field);
    for (Index batch = 0; batch < n_batches(); ++batch) {
      const Operator b = at_point(batch);
      const Nodal mass = masses(batch);
      Lane compliance = this->compliance_[at(batch)];
      Vectors left{}, right{};  // of the stress and of the volume
      if constexpr (adiabatic) {
        const VolumeTangent& t = tangent_[at(batch)];
        b.add_force(Lane(unit) * t.left, left);
        b.add_force(Lane(unit) * t.right, right);
        compliance = Lane(1.0) / t.stiffness;
      }
      compliance += this->pore_compliance_[at(batch)];
      const auto terms = this->compliance_terms(Lane(-unit * unit), compliance, batch);
      const Slot* const slots = this->slots_of(batch);
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t c = 0; c < n_nodes; ++c) {
          // Row u_a, column p_c; and row p_a, column u_c.
          std::array<Lane, dim> force, volume;
          for (std::size_t i = 0; i < dim; ++i) {
            force[i] = Lane(unit) * this->divergence(b, batch, a, i, c, mass) + mass[c] * left[a][i];
            volume[i] = Lane(unit) * this->divergence(b, batch, c, i, a, mass) + mass[a] * right[c][i];
          }
          for (int lane = 0; lane < k_lanes; ++lane) {
            double* const border = matrix.border(slots[(a * n_nodes + c) * k_lanes + as_size(lane)]);
            for (std::size_t i = 0; i < dim; ++i) {
              border[i * fields + field] += force[i][lane];
              border[(fields + field) * dim + i] += volume[i][lane];
            }
            border[2 * dim * fields + field * fields + field] += terms[a * n_nodes + c][lane];
          }
        }
    }
  }

 protected:  // for the kernel of the simultaneous scheme (coupled_mixed_block.hpp)
  Index n_batches() const { return Base::geometry_.n_batches; }
  /// The answer of the law.
  struct MixedPoint {
    Sym<Lane> strain;  ///< that it sees
    Lane volume;       ///< e_v
    Response response;
  };

  static Sym<Lane> strain(const Sym<Lane>& gradient, const Lane& volume) {
    Sym<Lane> e = gradient;
    const Lane excess = Lane(1.0 / 3.0) * (volume - trace(gradient));
    for (int i = 0; i < 3; ++i) e[i] += excess;
    return e;
  }
  const Compaction& compaction() const { return compaction_; }
  Lane kept_volume(const BlockHistory& history, Index batch) const {
    return history.values[layout_.extra(at(batch))];
  }
  Lane kept_pores(const BlockHistory& history, Index batch) const {
    return history.values[layout_.extra(at(batch)) + 1];
  }
  std::array<Lane, dim> kept_flow(const BlockHistory& history, Index batch) const {
    std::array<Lane, dim> q;
    std::copy_n(history.values.begin() + static_cast<std::ptrdiff_t>(flow_place(batch)), dim, q.begin());
    return q;
  }
  /// The law at ∇u and the mean pressure of the element.
  MixedPoint answer(Index batch, const Sym<Lane>& gradient, const Lane& pressure) {
    const bool found = find_volume(batch, gradient, pressure);
    const Lane volume = volume_[at(batch)];
    MixedPoint point{strain(gradient, volume), volume, {}};
    point.response = this->update(batch, 0, point.strain);
    if (!found) point.response.status = material::Status::cut_the_step;
    const Lane excess = pressure - Lane(1.0 / 3.0) * trace(point.response.stress);
    for (int i = 0; i < 3; ++i) point.response.stress[i] += excess;  // what the iteration has left
    return point;
  }

 private:
  Network network(const StepStart& start, Index batch, const Lane& fraction) const {
    const std::span<const double> freezing = start.phases.freezing;
    const Lane contracting =
        freezing.empty() ? fraction : within_nodes(this->geometry_, batch, 0, start.phases.contracting);
    return {.contracting = contracting,
            .stiffness = start.compaction_stiffness(fraction, contracting),
            .divergence = old_divergence_[at(batch)],
            .old_thermal_strain = start.old_history->values[flow_place(batch) + dim + 1],
            .thermal_strain = elastic_part(this->law_, this->properties_[at(batch)]).thermal_strain,
            .freezing = freezing.empty() ? Lane(0.0) : within_nodes(this->geometry_, batch, 0, freezing)};
  }
  std::size_t flow_place(Index batch) const {
    return layout_.extra(at(batch)) + k_mixed_extra<n_nodes, kind>;
  }
  void keep_flow(BlockHistory& history, Index batch) const {
    if (!this->flow_.flows()) return;
    const Nodal p = this->gather_pressure(this->field_.pressure, batch);
    const auto q = this->liquid_flow(this->pressure_gradient(p, batch), batch);
    std::copy(q.begin(), q.end(), history.values.begin() + static_cast<std::ptrdiff_t>(flow_place(batch)));
  }
  void keep_pores(Index batch, const Lane& fraction, typename Base::Averages* averages) const {
    if (averages != nullptr && pores_.may_open()) averages->set_pores(batch, fraction);
  }
  void keep_volume(BlockHistory& history, Index batch, const Lane& volume) const {
    history.values[layout_.extra(at(batch))] = volume;
  }

  /// The properties at Θ_n, also where the law works at the temperature of an iterate: with them the
  /// stabilisation is the same from the first iteration of a step to the last, and from scheme to scheme.
  Properties stabilisation_properties(const StepStart& start, Index batch) const {
    if (start.pass_temperature.data() == start.temperature.data()) return this->properties_[at(batch)];
    const material::PhaseState<Lane> phase = this->phase_at(start, batch, 0);
    Properties properties =
        this->law_.properties_at(temperature_at(this->geometry_, batch, 0, start.temperature),
                                 temperature_at(this->geometry_, batch, 0, start.initial_temperature), phase);
    if (start.melt_modulus() > 0) set_melt_viscosity(start.melt_viscosity(phase.solid_fraction), properties);
    return properties;
  }

  /// Sets e_v with which the law has this mean stress; false where it finds none.
  bool find_volume(Index batch, const Sym<Lane>& gradient, const Lane& pressure) {
    Lane& volume = volume_[at(batch)];
    if constexpr (!adiabatic) {
      const auto p = elastic_part(this->law_, this->properties_[at(batch)]);
      volume = pressure / p.bulk + p.thermal_strain;
      return true;
    } else {
      for (int i = 0; i < k_max_volumes; ++i) {
        const Response r = this->update(batch, 0, strain(gradient, volume));
        const Lane stiffness = volume_tangent(r).stiffness;
        const Lane step = (pressure - Lane(1.0 / 3.0) * trace(r.stress)) / stiffness;
        const Lane largest(k_largest_volume_step);
        volume += max(min(step, largest), -largest);
        if (!any(abs(step) > Lane(k_volume_tolerance))) return r.status == material::Status::converged;
      }
      return false;
    }
  }

  /// The mean stress of compaction whose work the step does; writes that of its end for the next one.
  Lane compaction_at_work(Index batch, const Lane& divergence, const BlockEnd& end) const {
    if (!this->flow_.flows()) return Lane(0.0);
    const std::size_t place = flow_place(batch) + dim;
    Lane stress = end.history.values[place] = compaction_.stress(batch, divergence);
    end.history.values[place + 1] = compaction_.thermal_strain(batch);
    stress = this->stress_of_work_.mean(stress, [&] { return this->old_history_->values[place]; });
    if (end.at_work != nullptr) {
      end.at_work->compaction.resize(volume_.size());
      end.at_work->compaction[at(batch)] = stress;
    }
    const StressAtWork* const given = this->stress_of_work_.given();
    return given != nullptr ? given->compaction[at(batch)] : stress;
  }
  /// p_a − p̄ of the stress whose work the step does; writes that of its end for the next one. Without a hoop
  /// it does no work.
  Nodal variation_at_work(Index batch, const BlockEnd& end) const {
    Nodal variation{};
    if constexpr (Nodes::hoop) {
      const Nodal p = this->gather_pressure(this->field_.pressure, batch);
      const Lane middle = mean(p, batch);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        const std::size_t place = layout_.extra(at(batch)) + 2 + a;
        variation[a] = end.history.values[place] = p[a] - middle;
        variation[a] =
            this->stress_of_work_.mean(variation[a], [&] { return this->old_history_->values[place]; });
      }
      const std::size_t first = at(batch) * n_nodes;
      if (end.at_work != nullptr) {
        end.at_work->variation.resize(volume_.size() * n_nodes);
        for (std::size_t a = 0; a < n_nodes; ++a) end.at_work->variation[first + a] = variation[a];
      }
      if (const StressAtWork* const given = this->stress_of_work_.given())
        for (std::size_t a = 0; a < n_nodes; ++a) variation[a] = given->variation[first + a];
    }
    return variation;
  }

  PackVector<Lane> volume_;          ///< e_v of the last update, [batch]
  PackVector<Lane> old_volume_;      ///< e_v at t_n, [batch]
  PackVector<Lane> old_divergence_;  ///< div u at t_n, [batch]
  Compaction compaction_;
  Pores pores_;
  PackVector<VolumeTangent> tangent_;  ///< of the last add_tangent(), adiabatic laws only
};

}  // namespace solidus::mechanics
