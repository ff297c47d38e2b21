/// The mixed kernel of linear triangles and tetrahedra (mixed_kernel.hpp): any law, eight elements at a time.
#pragma once

#include "mechanics/element_matrix.hpp"
#include "mechanics/mixed_kernel.hpp"
#include "mechanics/mixed_parts.hpp"
#include "mechanics/point_block.hpp"

namespace solidus::mechanics {

/// Volumetric strain that may be wrong where it is found by iteration; the stress has its mean anyway.
inline constexpr double k_volume_tolerance = 1e-11;
inline constexpr int k_max_volumes = 30;
/// Of one step of that iteration: beyond it no law holds.
inline constexpr double k_largest_volume_step = 0.05;
/// c of τ = c h²/(2Ĝ). What orthogonal sub-scales leave out is of higher order, and the answer hardly depends
/// on c; algebraic ones soften a body with c (docs/decisions/0007-mixed-simplices.md).
inline constexpr double k_orthogonal = 1.0, k_algebraic = 0.25;

/// Behind the law's state at a point: e_v, and in axisymmetry p_a − p̄ of its nodes.
template <int n_nodes, AnalysisKind kind>
inline constexpr int k_mixed_extra = kind == AnalysisKind::axisymmetric ? 1 + n_nodes : 1;

template <class Law, int n_nodes, AnalysisKind kind>
class MixedBlock final : public PointBlock<Law, n_nodes, kind, false, k_mixed_extra<n_nodes, kind>>,
                         public MixedKernel {
  using Base = PointBlock<Law, n_nodes, kind, false, k_mixed_extra<n_nodes, kind>>;
  using Base::dim, Base::gather, Base::nodes_of, Base::geometry_, Base::n_kept, Base::n_state;
  using typename Base::Operator, typename Base::Vectors, typename Base::State, typename Base::Properties,
      typename Base::Response, typename Base::Matrix;
  using Nodal = std::array<Lane, n_nodes>;
  static_assert(n_nodes == static_cast<int>(dim) + 1, "a linear simplex");
  static_assert(IsotropicTangent<Response>);
  static constexpr bool adiabatic = AdiabaticTangent<Response>;
  static constexpr bool hoop = kind == AnalysisKind::axisymmetric;
  static constexpr double share = 1.0 / n_nodes;  ///< N_a at the one point

 public:
  MixedBlock(const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material,
             Stabilisation stabilisation)
      : Base(mesh, block, material), orthogonal_(stabilisation == Stabilisation::orthogonal) {
    const auto n = static_cast<std::size_t>(geometry_.n_batches);
    volume_.resize(n, Lane(0.0));
    compliance_.resize(n);
    twice_shear_.resize(n);
    tau_.resize(n);
    if constexpr (adiabatic) tangent_.resize(n);
    if constexpr (hoop) masses_ = mesh::basis_integrals(mesh, block, kind);
  }

  double prepare(const StepStart& start) override {
    this->begin_step(start);
    Lane scale(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const std::size_t i = at(batch);
      const Operator b = at_point(batch);
      volume_[i] = kept_volume(*start.held_history, batch);
      const Sym<Lane> held = strain(b.strain(gather(start.held_displacement, batch)), volume_[i]);
      const Lane bulk = this->set_properties(start, batch, 0, held);
      const auto& properties = this->properties_[i];
      twice_shear_[i] =
          secant_shear(this->law_, properties, this->start_state(batch, 0), this->effective_dt_);
      tau_[i] = Lane(orthogonal_ ? k_orthogonal : k_algebraic) * squared_length(b) / twice_shear_[i];
      compliance_[i] = Lane(1.0) / bulk;
      if constexpr (adiabatic) {
        tangent_[i] = volume_tangent(this->update(batch, 0, held));
        compliance_[i] = Lane(1.0) / tangent_[i].stiffness;
      }
      Vectors f{};
      this->add_stiffness(b, bulk * geometry_.weight_at(batch, 0), f);
      scale += this->counted(batch) * this->squares(f);
    }
    return sum(scale);
  }

  double add_forces(std::span<const double> u, std::span<double> forces) override {
    Lane total(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Point point = answer(batch, b.strain(gather(u, batch)));
      Vectors f{};
      b.add_force(geometry_.weight_at(batch, 0) * dev(point.response.stress), f);
      add_pressure_force(b, batch, gather_pressure(pressure_, batch), f);
      if (point.response.status != material::Status::converged) this->spoil(f);
      total += this->counted(batch) * this->squares(f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), forces);
    }
    return sum(total);
  }

  void add_tangent(std::span<const double> u, algebra::BlockMatrix& matrix) override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Lane w = geometry_.weight_at(batch, 0);
      const auto response = answer(batch, b.strain(gather(u, batch))).response;
      Matrix symmetric;
      std::optional<Matrix> skew;
      if (!this->law_.symmetric()) skew.emplace();
      add_isotropic(b, Lane(augmentation_) * w * twice_shear_[at(batch)], w * response.twice_shear,
                    symmetric);
      if constexpr (RankOneTangent<Response>)
        if (any(response.flow_increment > Lane(0.0)))  // right is of unit length
          this->add_rank_one(b, response.left, response.right, w, dot(response.left, response.right),
                             symmetric, skew);
      if constexpr (adiabatic) {
        VolumeTangent& t = tangent_[at(batch)];
        t = volume_tangent(response);
        this->add_rank_one(b, t.thermal_left, t.thermal_right, w * t.factor, Lane(1.0), symmetric, skew);
      }
      scatter<1>(symmetric, this->slots_of(batch), matrix);
      if (skew) scatter<-1>(*skew, this->slots_of(batch), matrix);
    }
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, BlockHistory& trial) override {
    typename Base::Tally tally;
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      const Sym<Lane> old_gradient = b.strain(old_displacement), gradient = b.strain(displacement);
      const Lane old_volume = kept_volume(*this->old_history_, batch);
      const Point point = answer(batch, gradient);
      typename Base::Average average;
      const Sym<Lane> at_work = this->record(batch, 0, strain(old_gradient, old_volume), point.strain,
                                             point.response, trial, average, tally);
      keep_volume(trial, batch, point.volume);
      // What the pressure works on the difference of the volumes: the sub-scales take it up.
      const Nodal now = volume_change(b, batch, displacement),
                  before = volume_change(b, batch, old_displacement);
      const Nodal variation = variation_at_work(batch, trial);
      const Lane pressure = Lane(1.0 / 3.0) * trace(at_work);
      Lane left_over = geometry_.weight_at(batch, 0) * pressure * (old_volume - point.volume);
      for (std::size_t a = 0; a < n_nodes; ++a) left_over += (pressure + variation[a]) * (now[a] - before[a]);
      tally.stabilisation_work += this->counted(batch) * left_over;
      this->keep(batch, average);
    }
    return this->total(tally);
  }

  void rest(const StepStart& start) override {
    prepare(start);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Sym<Lane> gradient = at_point(batch).strain(gather(start.held_displacement, batch));
      this->points_.rest(batch, 0,
                         this->deformation(strain(gradient, volume_[at(batch)]), this->old_state(batch, 0),
                                           this->is_solid(batch, 0)));
    }
  }

  std::string failure(std::span<const double> u) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Sym<Lane> gradient = at_point(batch).strain(gather(u, batch));
      std::string text = this->failure_at(batch, 0, strain(gradient, volume_[at(batch)]));
      if (!text.empty()) return text;
    }
    return {};
  }

  /// ∫ N_a dV: in axisymmetry exact, as the pressure's forces are, so that a liquid column rests.
  void add_nodal_volume(double weight, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal mass = masses(batch);
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t lane = 0; lane < k_lanes; ++lane)
          out[static_cast<std::size_t>(nodes_of(batch)[a * k_lanes + lane])] +=
              weight * mass[a][static_cast<int>(lane)];
    }
  }

  std::size_t bytes() const override {
    return Base::bytes() +
           (volume_.capacity() + compliance_.capacity() + twice_shear_.capacity() + tau_.capacity()) *
               sizeof(Lane) +
           tangent_.capacity() * sizeof(VolumeTangent) + masses_.capacity() * sizeof(Lane) +
           pressure_slots_.capacity() * sizeof(Slot);
  }

  void use_pressure(std::span<const double> pressure, PressureField field) override {
    pressure_ = pressure;
    field_ = field;
  }
  void bind_pressure(const algebra::BlockMatrix& matrix) override {
    pressure_slots_ = matrix.lane_slots(geometry_.nodes, n_nodes, geometry_.n_elements);
  }
  void set_body_force(const std::array<double, 3>& force) override { body_force_ = force; }
  void set_augmentation(double part) override { augmentation_ = part; }

  std::array<double, 2> mean_stiffness() const override {
    Lane volume(0.0), stiffness(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Lane w = this->counted(batch) * geometry_.weight_at(batch, 0);
      volume += w;
      stiffness += w * twice_shear_[at(batch)];
    }
    return {sum(volume), sum(stiffness)};
  }

  void add_projection_weight(std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      Nodal weight;
      weight.fill(projection_weight(batch));
      scatter_pressure(weight, batch, out);
    }
  }

  void add_gradient(std::span<const double> p, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const auto g = pressure_gradient(gather_pressure(p, batch), batch);
      const Lane w = projection_weight(batch);
      for (std::size_t i = 0; i < dim; ++i) {
        const Lane value = w * g[i];
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t lane = 0; lane < k_lanes; ++lane)
            out[place(batch, a, lane) * dim + i] += value[static_cast<int>(lane)];
      }
    }
  }

  void add_projected(std::span<const double> projection, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Lane w = projection_weight(batch);  // τV × the share of a node in the mean
      Nodal result{};
      for (std::size_t i = 0; i < dim; ++i) {
        Lane total(0.0);
        for (std::size_t a = 0; a < n_nodes; ++a) {
          alignas(sizeof(Lane)) double values[k_lanes];
          for (std::size_t lane = 0; lane < k_lanes; ++lane)
            values[lane] = projection[place(batch, a, lane) * dim + i];
          total += Lane::load(values);
        }
        for (std::size_t a = 0; a < n_nodes; ++a) result[a] += w * total * b.gradient[a][i];
      }
      scatter_pressure(result, batch, out);
    }
  }

  void add_volume_defect(std::span<const double> u, std::span<double> defect,
                         std::span<double> size) override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Lane w = geometry_.weight_at(batch, 0), stabilised = tau_[at(batch)] * w;
      const Vectors displacement = gather(u, batch);
      const Nodal p = gather_pressure(pressure_, batch), mass = masses(batch);
      find_volume(batch, b.strain(displacement), mean(p, batch));
      const Lane volume = volume_[at(batch)];
      const auto g = pressure_gradient(p, batch);
      Nodal here = volume_change(b, batch, displacement), magnitude;
      for (std::size_t a = 0; a < n_nodes; ++a) {
        magnitude[a] = abs(here[a]) + mass[a] * abs(volume);
        here[a] -= mass[a] * volume;
        for (std::size_t i = 0; i < dim; ++i) {
          const Lane stabilisation = stabilised * b.gradient[a][i] * (g[i] + body_force(i));
          here[a] -= stabilisation;
          magnitude[a] += abs(stabilisation);
        }
      }
      scatter_pressure(here, batch, defect);
      scatter_pressure(magnitude, batch, size);
    }
  }

  void add_compliance(double scale, algebra::BlockMatrix& matrix) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch)
      add_to_pressures(Lane(scale), compliance_[at(batch)], batch, matrix);
  }

  void add_mass(double scale, algebra::BlockMatrix& matrix) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal mass = masses(batch);
      const Lane softness = Lane(scale) / twice_shear_[at(batch)];
      for (std::size_t a = 0; a < n_nodes; ++a) add_entry(softness * mass[a], batch, a, a, matrix);
    }
  }

  void add_saddle(double unit, algebra::CoupledMatrix& matrix) const override {
    const auto fields = static_cast<std::size_t>(field_.n_fields),
               field = static_cast<std::size_t>(field_.field);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Nodal mass = masses(batch);
      Lane compliance = compliance_[at(batch)];
      Vectors left{}, right{};  // of the stress and of the volume
      if constexpr (adiabatic) {
        const VolumeTangent& t = tangent_[at(batch)];
        b.add_force(Lane(unit) * t.left, left);
        b.add_force(Lane(unit) * t.right, right);
        compliance = Lane(1.0) / t.stiffness;
      }
      const Slot* const slots = this->slots_of(batch);
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t c = 0; c < n_nodes; ++c)
          for (std::size_t i = 0; i < dim; ++i) {
            // Row u_a, column p_c; and row p_a, column u_c.
            const Lane force = Lane(unit) * divergence(b, batch, a, i, c, mass) + mass[c] * left[a][i];
            const Lane volume = Lane(unit) * divergence(b, batch, c, i, a, mass) + mass[a] * right[c][i];
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
              const Slot slot = slots[(a * n_nodes + c) * k_lanes + lane];
              matrix.force_by_temperature(slot)[i * fields + field] += force[static_cast<int>(lane)];
              matrix.heat_by_displacement(slot)[field * dim + i] += volume[static_cast<int>(lane)];
            }
          }
      add_to_pressures(Lane(-unit * unit), compliance, batch, matrix.temperature());
    }
  }

  void add_divergence(double factor, std::span<const double> x, std::span<double> y) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Lane pull = Lane(factor * augmentation_) * geometry_.weight_at(batch, 0) *
                        twice_shear_[at(batch)] * trace(b.strain(gather(x, batch)));
      Vectors f{};
      b.add_force(pull * Sym<Lane>::identity(), f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), y);
    }
  }

 private:
  using Slot = algebra::BlockMatrix::Slot;
  struct Point {
    Sym<Lane> strain;
    Lane volume;  ///< e_v
    Response response;
  };

  static std::size_t at(Index batch) { return static_cast<std::size_t>(batch); }
  Operator at_point(Index batch) const {
    return Operator(geometry_.gradients_at(batch, 0), this->values_at(0), this->inverse_radius(batch, 0),
                    nullptr);
  }
  static Sym<Lane> strain(const Sym<Lane>& gradient, const Lane& volume) {
    Sym<Lane> e = gradient;
    const Lane excess = Lane(1.0 / 3.0) * (volume - trace(gradient));
    for (int i = 0; i < 3; ++i) e[i] += excess;
    return e;
  }
  Lane kept_volume(const BlockHistory& history, Index batch) const {
    return history.values[at(batch) * n_kept + n_state];
  }
  void keep_volume(BlockHistory& history, Index batch, const Lane& volume) const {
    history.values[at(batch) * n_kept + n_state] = volume;
  }

  /// h² of the stabilisation: that of a regular simplex with the same mean square of gradients, hence of the
  /// short way through a flat one.
  static Lane squared_length(const Operator& b) {
    Lane squares(0.0);
    for (const auto& gradient : b.gradient)
      for (const Lane& g : gradient) squares += g * g;
    return Lane(2.0 * static_cast<double>(dim)) / squares;
  }

  /// The law at ∇u and the pressure in use.
  Point answer(Index batch, const Sym<Lane>& gradient) {
    const Lane pressure = mean(gather_pressure(pressure_, batch), batch);
    const bool found = find_volume(batch, gradient, pressure);
    const Lane volume = volume_[at(batch)];
    Point point{strain(gradient, volume), volume, {}};
    point.response = this->update(batch, 0, point.strain);
    if (!found) point.response.status = material::Status::cut_the_step;
    const Lane excess = pressure - Lane(1.0 / 3.0) * trace(point.response.stress);
    for (int i = 0; i < 3; ++i) point.response.stress[i] += excess;  // what the iteration has left
    return point;
  }

  /// Sets e_v with which the law has this mean stress; false where it finds none.
  bool find_volume(Index batch, const Sym<Lane>& gradient, const Lane& pressure) {
    Lane& volume = volume_[at(batch)];
    if constexpr (!adiabatic) {
      const auto& p = elastic_part(this->law_, this->properties_[at(batch)]);
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

  Lane body_force(std::size_t i) const { return Lane(body_force_[i]); }
  Lane projection_weight(Index batch) const {
    if (!orthogonal_) return Lane(0.0);
    return Lane(share) * tau_[at(batch)] * geometry_.weight_at(batch, 0);
  }
  std::array<Lane, dim> pressure_gradient(const Nodal& p, Index batch) const {
    const Operator b = at_point(batch);
    std::array<Lane, dim> g{};
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) g[i] += p[a] * b.gradient[a][i];
    return g;
  }

  /// ∫ N_a dV.
  Nodal masses(Index batch) const {
    Nodal mass;
    if constexpr (hoop)
      std::copy_n(masses_.begin() + static_cast<std::ptrdiff_t>(batch) * n_nodes, n_nodes, mass.begin());
    else
      mass.fill(Lane(share) * geometry_.weight_at(batch, 0));
    return mass;
  }
  /// The pressure that the law works with, ∫ p dV/V.
  Lane mean(const Nodal& p, Index batch) const {
    Lane total(0.0);
    if constexpr (hoop) {
      const Nodal mass = masses(batch);
      Lane volume(0.0);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        total += mass[a] * p[a];
        volume += mass[a];
      }
      return select(volume > Lane(0.0), total / volume, Lane(0.0));  // padding has no volume
    } else {
      for (const Lane& value : p) total += value;
      return Lane(share) * total;
    }
  }
  /// ∫ b_a N_c dV in direction i, exact: in axisymmetry the hoop part is ∫ N_a N_c 2π dA.
  Lane divergence(const Operator& b, Index batch, std::size_t a, std::size_t i, std::size_t c,
                  const Nodal& mass) const {
    Lane d = b.gradient[a][i] * mass[c];
    if constexpr (hoop)
      if (i == 0) d += hoop_integral(batch) * Lane(a == c ? 2.0 : 1.0);
    return d;
  }
  /// ∫ N_a N_c 2π dA, a ≠ c.
  Lane hoop_integral(Index batch) const {
    return Lane(1.0 / 12.0) * geometry_.weight_at(batch, 0) * this->inverse_radius(batch, 0);
  }
  /// f_a += ∫ b_a p dV.
  void add_pressure_force(const Operator& b, Index batch, const Nodal& p, Vectors& f) const {
    const Nodal mass = masses(batch);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c)
        for (std::size_t i = 0; i < dim; ++i) f[a][i] += divergence(b, batch, a, i, c, mass) * p[c];
  }
  /// ∫ N_c div u dV.
  Nodal volume_change(const Operator& b, Index batch, const Vectors& u) const {
    const Nodal mass = masses(batch);
    Nodal change{};
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c)
        for (std::size_t i = 0; i < dim; ++i) change[c] += divergence(b, batch, a, i, c, mass) * u[a][i];
    return change;
  }
  /// p_a − p̄ of the stress whose work the step does; leaves that of its end for the next one. Without a hoop
  /// it does no work.
  Nodal variation_at_work(Index batch, BlockHistory& trial) {
    Nodal variation{};
    if constexpr (hoop) {
      const Nodal p = gather_pressure(pressure_, batch);
      const Lane middle = mean(p, batch);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        const std::size_t place = at(batch) * n_kept + n_state + 1 + a;
        variation[a] = trial.values[place] = p[a] - middle;
        if (this->new_stress_ != nullptr)
          variation[a] = Lane(this->stress_share_) * variation[a] +
                         Lane(1.0 - this->stress_share_) * this->old_history_->values[place];
      }
      if (this->work_ == StressAtWork::end) return variation;
      kept_variation_.resize(volume_.size());
      Nodal& kept = kept_variation_[at(batch)];
      if (this->work_ == StressAtWork::end_kept) kept = variation;
      return kept;
    }
    return variation;
  }

  /// Of a node of an element in an array of [local node][field].
  std::size_t place(Index batch, std::size_t node, std::size_t lane) const {
    const Index local = nodes_of(batch)[node * k_lanes + lane];
    return static_cast<std::size_t>(local) * static_cast<std::size_t>(field_.n_fields) +
           static_cast<std::size_t>(field_.field);
  }
  Nodal gather_pressure(std::span<const double> p, Index batch) const {
    Nodal result;
    for (std::size_t a = 0; a < n_nodes; ++a) {
      alignas(sizeof(Lane)) double values[k_lanes];
      for (std::size_t lane = 0; lane < k_lanes; ++lane) values[lane] = p[place(batch, a, lane)];
      result[a] = Lane::load(values);
    }
    return result;
  }
  void scatter_pressure(const Nodal& values, Index batch, std::span<double> out) const {
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t lane = 0; lane < k_lanes; ++lane)
        out[place(batch, a, lane)] += values[a][static_cast<int>(lane)];
  }

  void add_entry(const Lane& value, Index batch, std::size_t a, std::size_t c,
                 algebra::BlockMatrix& matrix) const {
    const auto fields = static_cast<std::size_t>(field_.n_fields),
               field = static_cast<std::size_t>(field_.field);
    const Slot* const slots =
        pressure_slots_.data() + (at(batch) * n_nodes * n_nodes + a * n_nodes + c) * k_lanes;
    for (std::size_t lane = 0; lane < k_lanes; ++lane)
      matrix.block(slots[lane])[field * fields + field] += value[static_cast<int>(lane)];
  }
  /// scale (∫ N compliance N dV + τ V ∇N·∇N).
  void add_to_pressures(const Lane& scale, const Lane& compliance, Index batch,
                        algebra::BlockMatrix& matrix) const {
    const Operator b = at_point(batch);
    const Lane w = geometry_.weight_at(batch, 0), stabilised = scale * w * tau_[at(batch)];
    const Nodal mass = masses(batch);
    const Lane density = select(w > Lane(0.0), scale * compliance / w, Lane(0.0));  // padding has no volume
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c) {
        Lane product(0.0);
        for (std::size_t i = 0; i < dim; ++i) product += b.gradient[a][i] * b.gradient[c][i];
        add_entry(density * mass[a] * mass[c] + stabilised * product, batch, a, c, matrix);
      }
  }

  bool orthogonal_;
  std::array<double, 3> body_force_{};  ///< ρ g_0 [N/m³]
  double augmentation_ = 0;
  std::span<const double> pressure_;
  PressureField field_;
  std::vector<Slot> pressure_slots_;   ///< [batch][a][b][lane]
  PackVector<Lane> volume_;            ///< e_v of the last update, [batch]
  PackVector<Lane> compliance_;        ///< 1/κ_v at the start of the step [1/Pa]
  PackVector<Lane> twice_shear_;       ///< 2Ĝ of the stabilisation [Pa]
  PackVector<Lane> tau_;               ///< [m²/Pa]
  PackVector<Lane> masses_;            ///< ∫ N_a dV, axisymmetric only: [batch][node]
  PackVector<Nodal> kept_variation_;   ///< [batch] [Pa]; empty where nobody asked for it
  PackVector<VolumeTangent> tangent_;  ///< of the last add_tangent(), adiabatic laws only
};

}  // namespace solidus::mechanics
