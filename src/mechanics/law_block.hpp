/// The kernels: forces, tangent and update of one mesh block for one law, shape and analysis kind, eight
/// elements at a time.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "mechanics/block_kernel.hpp"
#include "mechanics/element_matrix.hpp"
#include "mechanics/element_transfer.hpp"
#include "mechanics/law_parts.hpp"
#include "mechanics/structural_points.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::mechanics {

/// A law whose tangent is κ 1⊗1 + 2Ĝ I_dev; others offer a full symmetric `tangent` (Sym4).
template <class Response>
concept IsotropicTangent = requires(const Response& r) {
  r.bulk;
  r.twice_shear;
};
/// A law whose tangent is the isotropic one + left ⊗ right, where flow_increment > 0.
template <class Response>
concept RankOneTangent = IsotropicTangent<Response> && requires(const Response& r) {
  r.left;
  r.right;
  r.flow_increment;
};
/// A law whose tangent has the adiabatic part thermal_factor thermal_left ⊗ thermal_right besides.
template <class Response>
concept AdiabaticTangent = RankOneTangent<Response> && requires(const Response& r) {
  r.thermal_factor;
  r.thermal_left;
  r.thermal_right;
};
/// A law that holds the entropy of the committed state.
template <class Properties>
concept HoldsEntropy = requires(Properties& p) {
  p.entropy;
};

/// Law: built from a material; `properties_at`, `update`, `symmetric`, and the overloads of law_parts.hpp.
template <class Law, int n_nodes, AnalysisKind kind, bool b_bar>
class LawBlock : public BlockKernel {
 public:
  using Operator = Kinematics<n_nodes, kind, b_bar>;
  using Vectors = typename Operator::Vectors;
  using State = typename Law::template State<Lane>;
  using Properties = typename Law::template Properties<Lane>;
  using Response =
      decltype(std::declval<Law>().update(std::declval<Properties>(), State{}, Sym<Lane>{}, 1.0));
  using Values = decltype(values_of(std::declval<Law>(), std::declval<Properties>(), std::declval<Response>(),
                                    Sym<Lane>{}));
  using Matrix = ElementMatrix<n_nodes, Operator::dim>;
  static constexpr std::size_t dim = Operator::dim;
  static_assert(sizeof(State) % sizeof(Lane) == 0, "a state is made of lanes");
  static constexpr int n_state = static_cast<int>(sizeof(State) / sizeof(Lane));

  LawBlock(const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material)
      : geometry_(mesh, block, kind, mesh::stiffness_rule(block.shape)),
        block_(block),
        law_(material),
        points_(geometry_, material) {
    properties_.resize(static_cast<std::size_t>(geometry_.n_batches * geometry_.n_points));
    averages_.resize(static_cast<std::size_t>(geometry_.n_batches));
    if constexpr (b_bar) compute_means();
  }

  bool symmetric() const override { return law_.symmetric(); }

  void bind(const algebra::BlockMatrix& matrix) override {
    slots_ = matrix.lane_slots(geometry_.nodes, n_nodes, geometry_.n_elements);
  }

  BlockHistory initial_history() const override {
    BlockHistory history{n_state, geometry_.n_points, {}};
    history.values.assign(properties_.size() * n_state, Lane(0.0));
    return history;
  }

  double prepare(const StepStart& start) override {
    old_history_ = start.old_history;
    start_history_ = start.start_history;
    dt_ = start.dt;
    old_stress_ = start.old_stress;
    new_stress_ = start.new_stress;
    stress_share_ = start.stress_share;
    work_ = start.work;
    effective_dt_ = start.effective_dt;
    points_.set_dt(start.dt);
    const bool iterates = start.pass_temperature.data() != start.temperature.data();
    Lane scale(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      [[maybe_unused]] const Vectors held_displacement = gather(start.held_displacement, batch);
      Vectors f{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane old_theta = temperature_at(geometry_, batch, q, start.temperature);
        const Lane theta = iterates ? temperature_at(geometry_, batch, q, start.pass_temperature) : old_theta;
        Properties& properties = properties_[index(batch, q)];
        properties =
            law_.properties_at(theta, temperature_at(geometry_, batch, q, start.initial_temperature));
        if (iterates) hold_phase(law_, theta, old_theta, properties);
        if constexpr (HoldsEntropy<Properties>)
          properties.entropy =
              law_.entropy(properties, b.strain(held_displacement), state_of(*start.held_history, batch, q));
        const auto& p = elastic_part(law_, properties);
        points_.set_temperature(batch, q, old_theta, theta, p.thermal_strain);
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t i = 0; i < dim; ++i)
            f[a][i] += p.bulk * geometry_.weight_at(batch, q) * abs(b.divergence(a, i));
      }
      scale += geometry_.counted[static_cast<std::size_t>(batch)] * squares(f);
    }
    return sum(scale);
  }

  double add_forces(std::span<const double> u, std::span<double> forces) override {
    Lane total(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      Vectors f{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const auto response = law_.update(properties_[index(batch, q)], start_state(batch, q),
                                          b.strain(displacement), effective_dt_);
        b.add_force(geometry_.weight_at(batch, q) * response.stress, f);
        if (response.status != material::Status::converged) spoil(f);
      }
      total += geometry_.counted[static_cast<std::size_t>(batch)] * squares(f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), forces);
    }
    return sum(total);
  }

  void add_tangent(std::span<const double> u, algebra::BlockMatrix& matrix) override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      Matrix symmetric;
      std::optional<Matrix> skew;
      if (!law_.symmetric()) skew.emplace();
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane w = geometry_.weight_at(batch, q);
        const auto response = law_.update(properties_[index(batch, q)], start_state(batch, q),
                                          b.strain(displacement), effective_dt_);
        if constexpr (IsotropicTangent<Response>) {
          add_isotropic(b, w * response.bulk, w * response.twice_shear, symmetric);
        } else {
          Sym4<Lane> c = response.tangent;
          for (auto& row : c.c)
            for (auto& entry : row) entry *= w;
          add_general(b, c, symmetric);
        }
        if constexpr (RankOneTangent<Response>)
          if (any(response.flow_increment > Lane(0.0)))  // right is of unit length
            add_rank_one(b, response.left, response.right, w, dot(response.left, response.right), symmetric,
                         skew);
        if constexpr (AdiabaticTangent<Response>)
          add_rank_one(b, response.thermal_left, response.thermal_right, w * response.thermal_factor,
                       Lane(1.0), symmetric, skew);
      }
      const auto* slots = slots_.data() + static_cast<std::size_t>(batch) * n_nodes * n_nodes * k_lanes;
      scatter<1>(symmetric, slots, matrix);
      if (skew) scatter<-1>(*skew, slots, matrix);
    }
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, BlockHistory& trial) override {
    BlockWork work;
    Lane internal_work(0.0), dissipation(0.0), least(0.0), largest(0.0);
    PlasticPower plastic;
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      const Lane counted = geometry_.counted[static_cast<std::size_t>(batch)];
      Values sums;
      Lane volume(0.0);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane w = geometry_.weight_at(batch, q);
        const auto& p = properties_[index(batch, q)];
        const Sym<Lane> old_strain = b.strain(old_displacement), strain = b.strain(displacement);
        const auto response = law_.update(p, start_state(batch, q), strain, effective_dt_);
        std::memcpy(static_cast<void*>(trial.values.data() + index(batch, q) * n_state), &response.state,
                    sizeof(State));
        volume += w;
        add_weighted(sums, w, values_of(law_, p, response, strain));

        const LaneMask solid = elastic_part(law_, p).solid_fraction >= Lane(1.0);
        auto& point = points_.at(batch, q);
        if constexpr (HoldsEntropy<Properties>) point.pass_temperature = response.temperature;
        const State old = old_state(batch, q);
        point.now = deformation(strain, response.state, solid);
        point.change = change(strain, response.state, old_strain, old, solid);
        point.dissipated = Lane(dt_) * response.dissipation;
        point.work =
            dot(stress_at_work(batch, q, mean_stress(batch, q, response.stress)), strain - old_strain);
        points_.set_old(batch, q, deformation(old_strain, old, solid));

        const PlasticPower power = plastic_power(law_, response);
        internal_work += counted * w * point.work;
        dissipation += counted * w * response.dissipation;
        plastic.dissipation += counted * w * power.dissipation;
        plastic.power += counted * w * power.power;
        least = min(least, counted * response.dissipation);
        largest = max(largest, counted * response.dissipation);
      }
      const Lane inverse =
          select(volume > Lane(0.0), Lane(1.0) / volume, Lane(0.0));  // padding has no volume
      Values& average = averages_[static_cast<std::size_t>(batch)];
      average = Values{};
      add_weighted(average, inverse, sums);
    }
    work.internal_work = sum(internal_work);
    work.dissipation = dt_ * sum(dissipation);
    work.plastic_dissipation = dt_ * sum(plastic.dissipation);
    work.plastic_work = dt_ * sum(plastic.power);
    for (int lane = 0; lane < k_lanes; ++lane) {
      work.least_dissipation = std::min(work.least_dissipation, least[lane]);
      work.largest_dissipation = std::max(work.largest_dissipation, largest[lane]);
    }
    return work;
  }

  void rest(const StepStart& start) override {
    prepare(start);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(start.held_displacement, batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const LaneMask solid = elastic_part(law_, properties_[index(batch, q)]).solid_fraction >= Lane(1.0);
        points_.rest(batch, q,
                     deformation(at_point(batch, q).strain(displacement), old_state(batch, q), solid));
      }
    }
  }

  std::string failure(std::span<const double> u) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Sym<Lane> strain = at_point(batch, q).strain(displacement);
        for (int lane = 0; lane < k_lanes && batch * k_lanes + lane < geometry_.n_elements; ++lane) {
          using StateOfOne = typename Law::template State<double>;
          const auto p =
              element_of<typename Law::template Properties<double>>(properties_[index(batch, q)], lane);
          const auto start = element_of<StateOfOne>(start_state(batch, q), lane);
          const auto strain_of_one = element_of<Sym<double>>(strain, lane);
          if (!std::isfinite(norm(strain_of_one)) ||  // that is not the law's fault
              law_.update(p, start, strain_of_one, effective_dt_).status == material::Status::converged)
            continue;
          return fmt::format(
              "element {}: temperature {:.6g} K, solid fraction {:.4g}, strain {}, at the start of the step "
              "{}",
              block_.input_element[static_cast<std::size_t>(batch * k_lanes + lane)],
              points_.at(batch, q).temperature[lane], elastic_part(law_, p).solid_fraction,
              text(strain_of_one), text(start));
        }
      }
    }
    return {};
  }

  ElementFields fields() const override {
    ElementFields out;
    for (Index e = 0; e < geometry_.n_elements; ++e)
      append(out, element_of<typename Values::OfOne>(averages_[static_cast<std::size_t>(e / k_lanes)],
                                                     e % k_lanes));
    return out;
  }

  void add_nodal_volume(double weight, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Index* nodes = nodes_of(batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Lane w = Lane(weight) * geometry_.weight_at(batch, q);
        for (int a = 0; a < n_nodes; ++a)
          for (int lane = 0; lane < k_lanes; ++lane)
            out[static_cast<std::size_t>(nodes[a * k_lanes + lane])] += values_at(q)[a] * w[lane];
      }
    }
  }

  void spread_heat_as_stored(const PackVector<Lane>& weights) override { points_.spread_as_stored(weights); }
  void add_structural_heat(StructuralForm form, std::span<const double> temperature, bool tangent,
                           std::span<double> out) const override {
    points_.add_heat(form, temperature, tangent, out);
  }
  void begin_heat_stage(const algebra::Stage& stage, std::span<const double> temperature) override {
    points_.begin_stage(stage, temperature);
  }
  const StructuralPoints& structural_points() const override { return points_; }

  std::size_t bytes() const override {
    return geometry_.bytes() + points_.bytes() + properties_.capacity() * sizeof(properties_[0]) +
           means_.capacity() * sizeof(Lane) + slots_.capacity() * sizeof(slots_[0]) +
           averages_.capacity() * sizeof(averages_[0]) + kept_stress_.capacity() * sizeof(Sym<Lane>);
  }

 protected:  // for the kernel of the simultaneous scheme (coupled_block.hpp)
  std::size_t index(Index batch, int point) const {
    return static_cast<std::size_t>(batch) * static_cast<std::size_t>(geometry_.n_points) +
           static_cast<std::size_t>(point);
  }
  const Index* nodes_of(Index batch) const {
    return geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  }
  const double* values_at(int point) const { return geometry_.values.data() + point * n_nodes; }

  Operator at_point(Index batch, int point) const {
    const Lane inverse_radius =
        kind == AnalysisKind::axisymmetric ? geometry_.inverse_radius[index(batch, point)] : Lane(0.0);
    const Lane* mean = b_bar ? means_.data() + static_cast<std::size_t>(batch) * n_nodes * dim : nullptr;
    return Operator(geometry_.gradients_at(batch, point), values_at(point), inverse_radius, mean);
  }

  State state_of(const BlockHistory& history, Index batch, int point) const {
    State state;
    std::memcpy(static_cast<void*>(&state), history.values.data() + index(batch, point) * n_state,
                sizeof(State));
    return state;
  }
  State old_state(Index batch, int point) const { return state_of(*old_history_, batch, point); }
  State start_state(Index batch, int point) const { return state_of(*start_history_, batch, point); }

  static Deformation deformation(const Sym<Lane>& strain, const State& state, const LaneMask& solid) {
    const Sym<Lane> elastic = dev(strain - inelastic_strain(state));
    const auto [hardening, back_squared] = hardening_of(state);
    return {trace(strain), select(solid, dot(elastic, elastic), Lane(0.0)), hardening, back_squared};
  }

  /// Now : Δ since the old state.
  static Deformation change(const Sym<Lane>& strain, const State& state, const Sym<Lane>& old_strain,
                            const State& old, const LaneMask& solid) {
    const Sym<Lane> elastic = dev(strain - inelastic_strain(state));
    const Sym<Lane> old_elastic = dev(old_strain - inelastic_strain(old));
    const auto [hardening, back] = hardening_change(state, old);
    return {trace(strain - old_strain), select(solid, dot(elastic, elastic - old_elastic), Lane(0.0)),
            hardening, back};
  }

  /// The mean of the stresses at both ends of a dynamic step; leaves that of its end for the next one.
  Sym<Lane> mean_stress(Index batch, int point, const Sym<Lane>& stress) const {
    if (new_stress_ == nullptr) return stress;
    constexpr std::size_t n = sizeof(Sym<Lane>) / sizeof(Lane);
    Sym<Lane> old;
    std::memcpy(static_cast<void*>(&old), old_stress_->values.data() + index(batch, point) * n, sizeof old);
    std::memcpy(static_cast<void*>(new_stress_->values.data() + index(batch, point) * n), &stress,
                sizeof stress);
    return Lane(stress_share_) * stress + Lane(1.0 - stress_share_) * old;
  }

  /// The stress whose work the step does; keeps the one of its end where that is asked for.
  const Sym<Lane>& stress_at_work(Index batch, int point, const Sym<Lane>& stress) {
    if (work_ == StressAtWork::end) return stress;
    kept_stress_.resize(properties_.size());
    Sym<Lane>& kept = kept_stress_[index(batch, point)];
    if (work_ == StressAtWork::end_kept) kept = stress;
    return kept;
  }

  /// factor left ⊗ right; without a skew part left = share right.
  static void add_rank_one(const Operator& b, const Sym<Lane>& left, const Sym<Lane>& right, Lane factor,
                           Lane share, Matrix& symmetric, std::optional<Matrix>& skew) {
    Vectors of_right{};
    b.add_force(right, of_right);
    if (!skew) {
      add_product(of_right, factor * share, symmetric);
      return;
    }
    Vectors of_left{};
    b.add_force(left, of_left);
    add_product(of_left, of_right, factor, symmetric, *skew);
  }

  /// b̄_a of 6.23.
  void compute_means() {
    means_.assign(static_cast<std::size_t>(geometry_.n_batches) * n_nodes * dim, Lane(0.0));
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      Lane* mean = means_.data() + static_cast<std::size_t>(batch) * n_nodes * dim;
      Lane volume(0.0);
      Vectors total{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);  // its own mean is zero still and not used
        volume += geometry_.weight_at(batch, q);
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t i = 0; i < dim; ++i)
            total[a][i] += geometry_.weight_at(batch, q) * b.divergence(a, i);
      }
      const Lane inverse = select(volume > Lane(0.0), Lane(1.0) / volume, Lane(0.0));
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t i = 0; i < dim; ++i) mean[a * dim + i] = inverse * total[a][i];
    }
  }

  Vectors gather(std::span<const double> u, Index batch) const {
    return mechanics::gather<n_nodes, static_cast<int>(dim)>(u, nodes_of(batch));
  }

  /// Newton's iteration takes what is not a number for a step too far.
  static void spoil(Vectors& f) {
    for (auto& node : f)
      for (Lane& value : node) value = Lane(std::numeric_limits<double>::quiet_NaN());
  }

  static Lane squares(const Vectors& f) {
    Lane s(0.0);
    for (const auto& node : f)
      for (const Lane& value : node) s += value * value;
    return s;
  }

  mesh::BlockGeometry geometry_;
  const mesh::Block& block_;
  Law law_;
  StructuralPoints points_;
  PackVector<Properties> properties_;              ///< at Θ_n: [batch][point]
  PackVector<Lane> means_;                         ///< b̄_a, B-bar only: [batch][node][dim]
  std::vector<algebra::BlockMatrix::Slot> slots_;  ///< [batch][a][b][lane]
  PackVector<Values> averages_;                    ///< [batch]
  const BlockHistory* old_history_ = nullptr;
  const BlockHistory* start_history_ = nullptr;
  const BlockHistory* old_stress_ = nullptr;
  BlockHistory* new_stress_ = nullptr;
  double stress_share_ = 1;
  double dt_ = 0, effective_dt_ = 0;
  StressAtWork work_ = StressAtWork::end;
  PackVector<Sym<Lane>> kept_stress_;  ///< [batch][point] [Pa]; empty where nobody asked for it
};

}  // namespace solidus::mechanics
