/// The points of a mesh block: geometry, law and the properties of a step, eight elements at a time. All
/// element kernels build on it (point_record.hpp, point_restart.hpp, point_block.hpp). Its parts are the
/// layout of histories (history_layout.hpp), the deformation for the heat balance (structural_points.hpp) and
/// the properties, stored once where they are the same everywhere (common_packs.hpp).
#pragma once

#include <cmath>
#include <type_traits>
#include <vector>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/element_transfer.hpp"
#include "mechanics/elements/history_layout.hpp"
#include "mechanics/elements/law_parts.hpp"
#include "mechanics/elements/law_traits.hpp"
#include "mechanics/elements/padding.hpp"
#include "mechanics/elements/structural_points.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/common_packs.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Law: built from a material; `properties_at`, `update`, `symmetric`, and the overloads of law_parts.hpp.
/// @tparam n_extra  numbers that the element keeps at a point behind the law's state
template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class LawHistory : public BlockKernel {
 public:
  using Operator = Kinematics<n_nodes, kind, b_bar>;
  using Vectors = typename Operator::Vectors;
  using State = typename Law::template State<Lane>;
  using Properties = typename Law::template Properties<Lane>;
  using Response = typename Law::template Response<Lane>;
  static constexpr std::size_t dim = Operator::dim;

  LawHistory(const mesh::Mesh& mesh, const mesh::ElementBlock& block, const material::Material& material)
      : geometry_(mesh, block, kind, mesh::stiffness_rule(block.shape)),
        law_(material),
        points_(std::make_shared<StructuralPoints>(geometry_, material)),
        layout_(law_, n_extra),
        properties_(as_size(geometry_.n_batches * geometry_.n_points)) {}

  bool symmetric() const override { return law_.symmetric(); }

  void bind(const linear::BlockMatrix& matrix) override {
    slots_ = {matrix, geometry_.nodes, n_nodes, geometry_.n_elements};
  }

  BlockHistory initial_history() const override {
    BlockHistory history{static_cast<int>(layout_.lanes()), geometry_.n_points, {}};
    history.values.assign(properties_.size() * layout_.lanes(), Lane(0.0));
    return history;
  }

  bool set_initial_stress(const StepStart& start, std::span<const double> stress) override {
    if constexpr (KeepsStateInPlace<Law>) {
      return false;
    } else {
      initial_strain_.assign(properties_.size(), Sym<Lane>());
      for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
        Sym<Lane> of_batch;
        for (int k = 0; k < 6; ++k)
          of_batch[k] = lane_of_elements(batch, geometry_.n_elements, stress.data() + k, 6);
        // The strain that the elastic law answers with this stress, thermal strain being zero.
        for (int q = 0; q < geometry_.n_points; ++q) {
          const auto p = elastic_part(
              law_, law_.properties_at(temperature_at(geometry_, batch, q, start.temperature),
                                       temperature_at(geometry_, batch, q, start.initial_temperature),
                                       phase_at(start, batch, q)));
          Sym<Lane> strain = (Lane(0.5) / p.shear) * dev(of_batch);
          for (int k = 0; k < 3; ++k) strain[k] += Lane(1.0 / 9.0) * trace(of_batch) / p.bulk;
          initial_strain_[index(batch, q)] = strain;
        }
      }
      return true;
    }
  }

  void add_nodal_volume(double weight, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Index* nodes = nodes_of(batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Lane w = Lane(weight) * geometry_.weight_at(batch, q);
        for (int a = 0; a < n_nodes; ++a)
          for (int lane = 0; lane < k_lanes; ++lane)
            out[as_size(nodes[a * k_lanes + lane])] += values_at(q)[a] * w[lane];
      }
    }
  }

  void spread_heat_as_stored(const PackVector<Lane>& weights) override {
    layout_.add_base();
    own_points();
    points_->keep();
    points_->spread_as_stored(weights);
  }

  std::size_t bytes() const override {
    return geometry_.bytes() + points_->bytes() + properties_.bytes() + slots_.bytes() +
           initial_strain_.capacity() * sizeof(Sym<Lane>);
  }

 protected:
  std::size_t index(Index batch, int point) const {
    return as_size(batch) * as_size(geometry_.n_points) + as_size(point);
  }
  const Index* nodes_of(Index batch) const {
    return geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  }
  const double* values_at(int point) const { return geometry_.values.data() + point * n_nodes; }
  Lane counted(Index batch) const { return geometry_.counted[as_size(batch)]; }
  Lane inverse_radius(Index batch, int point) const {
    if constexpr (kind == AnalysisKind::axisymmetric)
      return geometry_.inverse_radius[index(batch, point)];
    else
      return Lane(0.0);
  }
  /// Null where none has been set.
  const Sym<Lane>* initial_strain(Index batch, int point) const {
    return initial_strain_.empty() ? nullptr : &initial_strain_[index(batch, point)];
  }
  const linear::BlockMatrix::Slot* slots_of(Index batch) const { return slots_.of(batch); }

  State old_state(Index batch, int point) const { return layout_.state(*old_history_, index(batch, point)); }
  State start_state(Index batch, int point) const {
    return layout_.state(*start_history_, index(batch, point));
  }

  /// @param space  of a law whose state lies in place: the state of the answer is in it
  Response update(Index batch, int point, const Sym<Lane>& strain, Workspace<Law>& space) const {
    if constexpr (KeepsStateInPlace<Law>)
      return law_.update(properties_[index(batch, point)], start_state(batch, point), strain, effective_,
                         space);
    else
      return law_.update(properties_[index(batch, point)], start_state(batch, point), strain, effective_);
  }
  Response update(Index batch, int point, const Sym<Lane>& strain) const requires(!KeepsStateInPlace<Law>) {
    return law_.update(properties_[index(batch, point)], start_state(batch, point), strain, effective_);
  }

  void begin_step(const StepStart& start) {
    old_history_ = start.old_history;
    start_history_ = start.start_history;
    dt_ = start.dt;
    effective_ = start.effective;
    temperature_ = start.temperature;
    initial_temperature_ = start.initial_temperature;
    old_displacement_ = start.old_displacement;
    own_points();
    points_->set_dt(start.dt);
  }

  /// Properties for the temperature of this step, and the entropy that an isentropic law holds.
  /// @param held_strain  of the state whose entropy is held
  /// @return the bulk modulus [Pa]
  Lane set_properties(const StepStart& start, Index batch, int q, const Sym<Lane>& held_strain) {
    const bool iterates = start.pass_temperature.data() != start.temperature.data();
    const Lane old_theta = temperature_at(geometry_, batch, q, start.temperature);
    const Lane theta = iterates ? temperature_at(geometry_, batch, q, start.pass_temperature) : old_theta;
    const material::PhaseState<Lane> phase = phase_at(start, batch, q);
    Properties properties =
        law_.properties_at(theta, temperature_at(geometry_, batch, q, start.initial_temperature), phase);
    if (start.melt_modulus() > 0) set_melt_viscosity(start.melt_viscosity(phase.solid_fraction), properties);
    const auto& p = elastic_part(law_, properties);
    points_->set_temperature(batch, q, old_theta, theta, p.thermal_strain);
    if (start.lead != nullptr) points_->begin_with(batch, q, (*start.lead)[index(batch, q)]);
    if constexpr (HoldsEntropy<Properties>) {
      const State held = layout_.state(*start.held_history, index(batch, q));
      properties.entropy = law_.entropy(properties, held_strain, held);
      // The energy of the state at t_n is continued from its own base; an iterate has the base of this step
      // already.
      if (start.held_history == start.old_history && layout_.has_base()) {
        const StructuralBase base = old_base(batch, q);
        properties.entropy +=
            points_->entropy_ahead(batch, q, deformation(held_strain, held, base.solid > Lane(0.0)), base);
      }
      if (start.lead != nullptr) properties.entropy += (*start.lead)[index(batch, q)].entropy;
    }
    properties_.set(index(batch, q), properties);
    return p.bulk;
  }

  /// The phases of the nodes at a point.
  material::PhaseState<Lane> phase_at(const StepStart& start, Index batch, int q) const {
    material::PhaseState<Lane> phase{Lane(1.0), Lane(0.0)};
    if (!start.phases.solid_fraction.empty())
      phase.solid_fraction = within_nodes(geometry_, batch, q, start.phases.solid_fraction);
    if (!start.phases.straining.empty())
      phase.straining = within_nodes(geometry_, batch, q, start.phases.straining);
    return phase;
  }

  /// Forces that a strain of 1 would cause at a point.
  void add_stiffness(const Operator& b, Lane weighted_bulk, Vectors& f) const {
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) f[a][i] += weighted_bulk * abs(b.divergence(a, i));
  }

  /// The base of the state at t_n, behind its law's history; zero where nothing has been solved yet. Where
  /// energy is evaluated again, or no one asked for structural heat, that of this step.
  StructuralBase old_base(Index batch, int q) const {
    if (!layout_.has_base() || !points_->carries_energy()) return points_->base(batch, q, is_solid(batch, q));
    StructuralBase base = layout_.base(*old_history_, index(batch, q));
    const LaneMask known = base.line_temperature > Lane(0.0);
    if (!any(!known)) return base;
    const StructuralBase initial =
        points_->initial_base(temperature_at(geometry_, batch, q, initial_temperature_));
    for (Lane StructuralBase::*part :
         {&StructuralBase::line_temperature, &StructuralBase::strain_offset, &StructuralBase::solid})
      base.*part = select(known, base.*part, initial.*part);
    return base;
  }

  /// Takes a copy of the deformation where others have it, so that it stays with them as it is.
  void own_points() {
    if (points_.use_count() > 1) points_ = std::make_shared<StructuralPoints>(*points_);
  }

  LaneMask is_solid(Index batch, int q) const {
    return elastic_part(law_, properties_[index(batch, q)]).solid_fraction >= Lane(1.0);
  }

  /// Holds the deformation of the state at t_n in a point.
  void hold_point(Index batch, int q, const Sym<Lane>& strain) {
    if (!points_->kept()) return;
    const StructuralBase base = old_base(batch, q);
    points_->hold_deformation(batch, q, deformation(strain, old_state(batch, q), base.solid > Lane(0.0)),
                              base);
  }

  static Deformation deformation(const Sym<Lane>& strain, const State& state, const LaneMask& solid) {
    const Sym<Lane> elastic = dev(strain - inelastic_strain(state));
    const auto [hardening, back_squared] = hardening_of(state);
    return {trace(strain) - inelastic_volume(state), select(solid, dot(elastic, elastic), Lane(0.0)),
            hardening, back_squared, cold_work(state)};
  }

  Vectors gather(std::span<const double> u, Index batch) const {
    return mechanics::gather<n_nodes, static_cast<int>(dim)>(u, nodes_of(batch));
  }

  mesh::BlockGeometry geometry_;
  Law law_;
  /// The deformation of the pass that runs. Passes hand it out: own_points() before it is written to.
  std::shared_ptr<StructuralPoints> points_;
  HistoryLayout<Law> layout_;
  CommonPacks<Properties> properties_;  ///< at Θ_n: [batch][point]
  linear::LaneSlots slots_;
  PackVector<Sym<Lane>> initial_strain_;         ///< C⁻¹ σ_0, [batch][point]; empty: none
  std::span<const double> temperature_;          ///< Θ_n of the step, [local node]
  std::span<const double> initial_temperature_;  ///< Θ_0, [local node]
  std::span<const double> old_displacement_;     ///< at t_n [m], [local node][component]
  const BlockHistory* old_history_ = nullptr;
  const BlockHistory* start_history_ = nullptr;
  double dt_ = 0;
  material::TimeStep effective_{0};  ///< of the law
};

}  // namespace solidus::mechanics
