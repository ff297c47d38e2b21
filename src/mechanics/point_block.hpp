/// Common base of all element kernels: geometry, law, history and the results of a step at the points, eight
/// elements at a time.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/block_kernel.hpp"
#include "mechanics/element_transfer.hpp"
#include "mechanics/flow_directions.hpp"
#include "mechanics/law_parts.hpp"
#include "mechanics/structural_points.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/common_packs.hpp"

namespace solidus::mechanics {

/// A law whose tangent is κ 1⊗1 + 2Ĝ I_dev; others offer a full `tangent` (Sym4), which is symmetric where
/// the law says so.
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

/// A law whose state has as many numbers as its user says: its State refers to them in the history.
template <class Law>
concept KeepsStateInPlace = requires {
  typename Law::StateInPlace;
};

/// Law: built from a material; `properties_at`, `update`, `symmetric`, and the overloads of law_parts.hpp.
/// @tparam n_extra  numbers that the element keeps at a point behind the law's state
template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class PointBlock : public BlockKernel {
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
  static_assert(KeepsStateInPlace<Law> || sizeof(State) % sizeof(Lane) == 0, "a state is made of lanes");
  using Lanes = std::array<Lane, sizeof(State) / sizeof(Lane)>;

  PointBlock(const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material)
      : geometry_(mesh, block, kind, mesh::stiffness_rule(block.shape)),
        block_(block),
        law_(material),
        points_(geometry_, material),
        kept_(kept_lanes(law_)),
        n_state_(kept_.size()),
        n_kept_(n_state_ + n_extra),
        properties_(static_cast<std::size_t>(geometry_.n_batches * geometry_.n_points)),
        averages_(static_cast<std::size_t>(geometry_.n_batches)) {}

  bool symmetric() const override { return law_.symmetric(); }

  void bind(const linear::BlockMatrix& matrix) override {
    slots_ = {matrix, geometry_.nodes, n_nodes, geometry_.n_elements};
  }

  BlockHistory initial_history() const override {
    BlockHistory history{static_cast<int>(n_kept_), geometry_.n_points, {}};
    history.values.assign(properties_.size() * n_kept_, Lane(0.0));
    return history;
  }

  void get_field(ElementField which, std::span<double> out) const override {
    const int n_components = component_count(which);
    const CommonPacks<Values>& averages = kept_averages_ ? *kept_averages_ : averages_;
    double* to = out.data();
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Values values = averages[static_cast<std::size_t>(batch)];
      for (int lane = 0; lane < k_lanes && batch * k_lanes + lane < geometry_.n_elements; ++lane) {
        put(which, element_of<typename Values::OfOne>(values, lane), to);
        to += n_components;
      }
    }
  }
  void keep_fields() override {
    kept_averages_.reset();
    keeps_averages_ = true;
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

  void spread_heat_as_stored(const PackVector<Lane>& weights) override {
    if (!std::exchange(keeps_base_, true)) {  // histories have it behind the law's state from now on
      n_state_ += k_base_lanes;
      n_kept_ += k_base_lanes;
    }
    points_.keep();
    points_.spread_as_stored(weights);
  }
  void add_structural_heat(StructuralForm form, std::span<const double> temperature, bool tangent,
                           std::span<double> out) const override {
    points_.add_heat(form, temperature, tangent, out);
  }
  void begin_heat_stage(const linear::Stage& stage, std::span<const double> temperature) override {
    points_.begin_stage(stage, temperature);
  }
  const StructuralPoints& structural_points() const override { return points_; }

  std::size_t bytes() const override {
    return geometry_.bytes() + points_.bytes() + properties_.bytes() + slots_.bytes() + averages_.bytes() +
           directions_.bytes() + (kept_averages_ ? kept_averages_->bytes() : 0) +
           kept_stress_.capacity() * sizeof(Sym<Lane>) + answers_.capacity() * sizeof(Answer);
  }

 protected:
  /// Sums of a step over the counted elements, lane by lane.
  struct Tally {
    Lane internal_work{0.0}, stabilisation_work{0.0}, dissipation{0.0}, least{0.0}, largest{0.0},
        inelastic_entropy{0.0};
    PlasticPower plastic;
  };
  /// FlowChange of a block, lane by lane.
  struct Restart {
    Tally change;
    LaneMask flows = Lane(0.0) > Lane(0.0);
    bool found = true;
  };
  /// Average over the points of a batch, weighted with their volumes.
  struct Average {
    Values sums;
    Lane volume{0.0};
  };

  std::size_t index(Index batch, int point) const {
    return static_cast<std::size_t>(batch) * static_cast<std::size_t>(geometry_.n_points) +
           static_cast<std::size_t>(point);
  }
  const Index* nodes_of(Index batch) const {
    return geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  }
  const double* values_at(int point) const { return geometry_.values.data() + point * n_nodes; }
  Lane counted(Index batch) const { return geometry_.counted[static_cast<std::size_t>(batch)]; }
  Lane inverse_radius(Index batch, int point) const {
    if constexpr (kind == AnalysisKind::axisymmetric)
      return geometry_.inverse_radius[index(batch, point)];
    else
      return Lane(0.0);
  }
  const linear::BlockMatrix::Slot* slots_of(Index batch) const { return slots_.of(batch); }

  State state_of(const BlockHistory& history, Index batch, int point) const {
    const Lane* from = history.values.data() + index(batch, point) * n_kept_;
    if constexpr (KeepsStateInPlace<Law>) {
      return State{from};
    } else {
      Lanes lanes{};
      for (const std::size_t lane : kept_) lanes[lane] = *from++;
      return std::bit_cast<State>(lanes);
    }
  }
  State old_state(Index batch, int point) const { return state_of(*old_history_, batch, point); }
  State start_state(Index batch, int point) const { return state_of(*start_history_, batch, point); }

  Response update(Index batch, int point, const Sym<Lane>& strain) const {
    return law_.update(properties_[index(batch, point)], start_state(batch, point), strain, effective_dt_);
  }

  /// The same for a law that is not to be asked twice: keeps the answer for answer_at().
  Response update_and_keep(Index batch, int point, const Sym<Lane>& strain) {
    Response response = update(batch, point, strain);
    if constexpr (KeepsStateInPlace<Law>) {
      if (answers_.empty()) {
        answers_.resize(properties_.size());
        for (Answer& answer : answers_) answer.strain[0] = Lane(std::numeric_limits<double>::quiet_NaN());
      }
      answers_[index(batch, point)] = {strain, response};
    }
    return response;
  }
  /// Stress and tangent, of the answer that is kept where it is that of this strain.
  Response answer_at(Index batch, int point, const Sym<Lane>& strain) const {
    if constexpr (KeepsStateInPlace<Law>) {
      if (!answers_.empty()) {
        const Answer& answer = answers_[index(batch, point)];
        LaneMask same = answer.strain[0] == strain[0];
        for (int i = 1; i < 6; ++i) same = same & (answer.strain[i] == strain[i]);
        if (!any(!same)) return answer.response;
      }
    }
    return update(batch, point, strain);
  }

  void begin_step(const StepStart& start) {
    answers_.clear();
    old_history_ = start.old_history;
    start_history_ = start.start_history;
    dt_ = start.dt;
    old_stress_ = start.old_stress;
    new_stress_ = start.new_stress;
    stress_share_ = start.stress_share;
    work_ = start.work;
    effective_dt_ = start.effective_dt;
    temperature_ = start.temperature;
    initial_temperature_ = start.initial_temperature;
    old_displacement_ = start.old_displacement;
    points_.set_dt(start.dt);
    directions_.begin();
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
    points_.set_temperature(batch, q, old_theta, theta, p.thermal_strain);
    if constexpr (HoldsEntropy<Properties>) {
      const State held = state_of(*start.held_history, batch, q);
      properties.entropy = law_.entropy(properties, held_strain, held);
      // That of the state at t_n goes on as it is; an iterate has the base of this step already.
      if (start.held_history == start.old_history && keeps_base_) {
        const StructuralBase base = old_base(batch, q);
        properties.entropy +=
            points_.entropy_ahead(batch, q, deformation(held_strain, held, base.solid > Lane(0.0)), base);
      }
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
  /// energy is evaluated anew, or nobody asked for structural heat, that of this step.
  StructuralBase old_base(Index batch, int q) const {
    if (!keeps_base_ || !points_.carries_energy()) return points_.base(batch, q, is_solid(batch, q));
    const Lane* from = base_of(*old_history_, batch, q);
    StructuralBase base{from[0], from[1], from[2]};
    const LaneMask known = base.line_temperature > Lane(0.0);
    if (!any(!known)) return base;
    const StructuralBase initial =
        points_.initial_base(temperature_at(geometry_, batch, q, initial_temperature_));
    for (Lane StructuralBase::*part :
         {&StructuralBase::line_temperature, &StructuralBase::strain_offset, &StructuralBase::solid})
      base.*part = select(known, base.*part, initial.*part);
    return base;
  }

  LaneMask is_solid(Index batch, int q) const {
    return elastic_part(law_, properties_[index(batch, q)]).solid_fraction >= Lane(1.0);
  }

  /// Holds the deformation of the state at t_n in a point.
  void hold_point(Index batch, int q, const Sym<Lane>& strain) {
    if (!points_.kept()) return;
    const StructuralBase base = old_base(batch, q);
    points_.hold_deformation(batch, q, deformation(strain, old_state(batch, q), base.solid > Lane(0.0)),
                             base);
  }

  /// Keeps the answer of a point at the end of a step: history, values for results, what the thermal phase
  /// needs; strains are those that the law has seen.
  /// @return the stress whose work the step does
  Sym<Lane> record(Index batch, int q, const Sym<Lane>& old_strain, const Sym<Lane>& strain,
                   const Response& response, BlockHistory& trial, Average& average, Tally& tally) {
    const Lane w = geometry_.weight_at(batch, q), share = counted(batch) * w;
    const Properties p = properties_[index(batch, q)];
    Lane* to = trial.values.data() + index(batch, q) * n_kept_;
    if constexpr (KeepsStateInPlace<Law>) {
      std::copy_n(response.state.values, kept_.size(), to);
    } else {
      const auto lanes = std::bit_cast<Lanes>(response.state);
      for (const std::size_t lane : kept_) *to++ = lanes[lane];
    }
    average.volume += w;
    add_weighted(average.sums, w, values_of(law_, p, response, strain));

    const Sym<Lane> at_work = stress_at_work(batch, q, mean_stress(batch, q, response.stress));
    const Lane work = dot(at_work, strain - old_strain);
    if (points_.kept()) {
      const LaneMask solid = elastic_part(law_, p).solid_fraction >= Lane(1.0);
      auto& point = points_.at(batch, q);
      if constexpr (HoldsEntropy<Properties>) point.pass_temperature = response.temperature;
      const State old = old_state(batch, q);
      point.now = deformation(strain, response.state, solid);
      point.change = change(strain, response.state, old_strain, old, solid);
      point.dissipated = Lane(dt_) * response.dissipation;
      point.work = work;
      const StructuralBase base = old_base(batch, q);
      points_.set_old(batch, q, deformation(old_strain, old, base.solid > Lane(0.0)), base);
      if (keeps_base_) keep_base(trial, batch, q, points_.base(batch, q, solid));
    }

    const PlasticPower power = plastic_power(law_, response);
    tally.internal_work += share * work;
    tally.dissipation += share * response.dissipation;
    tally.plastic.dissipation += share * power.dissipation;
    tally.plastic.power += share * power.power;
    tally.inelastic_entropy +=
        share * (inelastic_entropy(response.state) - inelastic_entropy(old_state(batch, q)));
    tally.least = min(tally.least, counted(batch) * response.dissipation);
    tally.largest = max(tally.largest, counted(batch) * response.dissipation);
    return at_work;
  }

  /// restart_flow() at a point; strains are those that the law has seen in the mechanical phase.
  void restart_point(const StepStart& start, Index batch, int q, const Sym<Lane>& old_strain,
                     const Sym<Lane>& strain, BlockHistory& trial, Average& average, Restart& restart) {
    const Properties properties = properties_[index(batch, q)];
    const LaneMask solid = elastic_part(law_, properties).solid_fraction >= Lane(1.0);
    const State old = old_state(batch, q);
    // All of the mechanical phase's answer is taken before the law is asked again: a state may lie in the
    // law.
    const Response kept = update(batch, q, strain);
    Values values = values_of(law_, properties, kept, strain);
    const Flow of_mechanics = flow(law_, kept, strain, old_strain, old, solid);

    const auto& law = law_at_temperature(law_);
    auto p = law.properties_at(temperature_at(geometry_, batch, q, start.pass_temperature),
                               temperature_at(geometry_, batch, q, start.initial_temperature),
                               phase_at(start, batch, q));
    if (start.melt_modulus() > 0)
      set_melt_viscosity(start.melt_viscosity(phase_at(start, batch, q).solid_fraction), p);
    const auto anew = law.update(p, start_state(batch, q), strain, effective_dt_);
    restart.found = restart.found && anew.status == material::Status::converged;
    const Flow now = select_lanes(solid, flow(law, anew, strain, old_strain, old, solid), of_mechanics);

    auto& shown = values_at_temperature(values);
    shown = select_lanes(solid, values_of(law, p, anew, strain), shown);
    const Lane w = geometry_.weight_at(batch, q), share = counted(batch) * w;
    average.volume += w;
    add_weighted(average.sums, w, values);
    replace_state(anew.state, solid, batch, q, trial);
    if (points_.kept()) {
      points_.keep_of_mechanics(batch, q, of_mechanics.now);
      auto& point = points_.at(batch, q);
      point.now = now.now;
      point.change = now.change;
      point.dissipated = Lane(dt_) * now.dissipation;
    }
    Tally& change = restart.change;
    change.dissipation += share * (now.dissipation - of_mechanics.dissipation);
    change.plastic.dissipation += share * (now.plastic.dissipation - of_mechanics.plastic.dissipation);
    change.plastic.power += share * (now.plastic.power - of_mechanics.plastic.power);
    change.inelastic_entropy += share * (now.inelastic_entropy - of_mechanics.inelastic_entropy);
    change.least = min(change.least, counted(batch) * now.dissipation);
    change.largest = max(change.largest, counted(batch) * now.dissipation);
    restart.flows = restart.flows | (abs(now.dissipation - of_mechanics.dissipation) > Lane(0.0)) |
                    (abs(now.now.elastic_squared - of_mechanics.now.elastic_squared) > Lane(0.0));
  }

  void keep(Index batch, const Average& average) {
    if (std::exchange(keeps_averages_, false)) kept_averages_ = averages_;
    const Lane inverse = select(average.volume > Lane(0.0), Lane(1.0) / average.volume,
                                Lane(0.0));  // padding has no volume
    Values mean{};
    add_weighted(mean, inverse, average.sums);
    averages_.set(static_cast<std::size_t>(batch), mean);
  }

  FlowChange total(const Restart& restart) const {
    return {total(restart.change), any(restart.flows), restart.found};
  }
  BlockWork total(const Tally& tally) const {
    BlockWork work;
    work.internal_work = sum(tally.internal_work);
    work.stabilisation_work = sum(tally.stabilisation_work);
    work.dissipation = dt_ * sum(tally.dissipation);
    work.plastic_dissipation = dt_ * sum(tally.plastic.dissipation);
    work.plastic_work = dt_ * sum(tally.plastic.power);
    work.inelastic_entropy = sum(tally.inelastic_entropy);
    for (int lane = 0; lane < k_lanes; ++lane) {
      work.least_dissipation = std::min(work.least_dissipation, tally.least[lane]);
      work.largest_dissipation = std::max(work.largest_dissipation, tally.largest[lane]);
    }
    return work;
  }

  /// Adds a point of strain `strain` to the volume that flows.
  void add_flowing(Index batch, int q, const Sym<Lane>& strain, FlowingVolume& volume) const {
    const Lane share = counted(batch) * geometry_.weight_at(batch, q);
    volume.all += sum(share);
    if constexpr (RankOneTangent<Response>) {
      const Response response = update(batch, q, strain);
      volume.flowing += sum(select(response.flow_increment > Lane(0.0), share, Lane(0.0)));
    }
  }

  /// The first element of a batch whose law finds no state at these strains, with its inputs.
  std::string failure_at(Index batch, int q, const Sym<Lane>& strain) const {
    if constexpr (KeepsStateInPlace<Law>) update(batch, q, strain);
    for (int lane = 0; lane < k_lanes && batch * k_lanes + lane < geometry_.n_elements; ++lane) {
      const auto p =
          element_of<typename Law::template Properties<double>>(properties_[index(batch, q)], lane);
      const auto strain_of_one = element_of<Sym<double>>(strain, lane);
      if (!std::isfinite(norm(strain_of_one))) continue;  // that is not the law's fault
      const std::string start = failed_start(batch, q, lane, p, strain_of_one);
      if (start.empty()) continue;
      return fmt::format("element {}: temperature {:.6g} K, solid fraction {:.4g}, strain {}, {}",
                         block_.input_element[static_cast<std::size_t>(batch * k_lanes + lane)],
                         temperature_at(geometry_, batch, q, temperature_)[lane],
                         elastic_part(law_, p).solid_fraction, text(strain_of_one), start);
    }
    return {};
  }

  /// The state from which the law of an element found none, in words; empty if it found one.
  template <class PropertiesOfOne>
  std::string failed_start(Index batch, int q, int lane, const PropertiesOfOne& p,
                           const Sym<double>& strain) const {
    if constexpr (KeepsStateInPlace<Law>) {
      return law_.failure(lane);
    } else {
      const auto start = element_of<typename Law::template State<double>>(start_state(batch, q), lane);
      if (law_.update(p, start, strain, effective_dt_).status == material::Status::converged) return {};
      return "at the start of the step " + text(start);
    }
  }

  /// What the heat balance takes from the flow of a point.
  struct Flow {
    Deformation now, change;
    Lane dissipation;  ///< D_mech [W/m³]
    PlasticPower plastic;
    Lane inelastic_entropy;  ///< [J/(m³ K)]
  };
  template <class AnyLaw, class Answer>
  static Flow flow(const AnyLaw& law, const Answer& r, const Sym<Lane>& strain, const Sym<Lane>& old_strain,
                   const State& old, const LaneMask& solid) {
    return {deformation(strain, r.state, solid), change(strain, r.state, old_strain, old, solid),
            r.dissipation, plastic_power(law, r), solidus::mechanics::inelastic_entropy(r.state)};
  }

  /// Writes the state of the lanes where the mask holds.
  void replace_state(const State& state, const LaneMask& mask, Index batch, int q,
                     BlockHistory& trial) const {
    Lane* to = trial.values.data() + index(batch, q) * n_kept_;
    if constexpr (KeepsStateInPlace<Law>) {
      for (std::size_t i = 0; i < kept_.size(); ++i) to[i] = select(mask, state.values[i], to[i]);
    } else {
      const auto lanes = std::bit_cast<Lanes>(state);
      for (const std::size_t lane : kept_) {
        *to = select(mask, lanes[lane], *to);
        ++to;
      }
    }
  }

  static constexpr std::size_t k_base_lanes = sizeof(StructuralBase) / sizeof(Lane);

  template <class History>
  auto base_of(History& history, Index batch, int q) const {
    return history.values.data() + index(batch, q) * n_kept_ + n_state_ - k_base_lanes;
  }
  void keep_base(BlockHistory& history, Index batch, int q, const StructuralBase& base) const {
    Lane* to = base_of(history, batch, q);
    to[0] = base.line_temperature;
    to[1] = base.strain_offset;
    to[2] = base.solid;
  }

  static Deformation deformation(const Sym<Lane>& strain, const State& state, const LaneMask& solid) {
    const Sym<Lane> elastic = dev(strain - inelastic_strain(state));
    const auto [hardening, back_squared] = hardening_of(state);
    return {trace(strain) - inelastic_volume(state), select(solid, dot(elastic, elastic), Lane(0.0)),
            hardening, back_squared, cold_work(state)};
  }

  /// Now : Δ since the old state.
  static Deformation change(const Sym<Lane>& strain, const State& state, const Sym<Lane>& old_strain,
                            const State& old, const LaneMask& solid) {
    const Sym<Lane> elastic = dev(strain - inelastic_strain(state));
    const Sym<Lane> old_elastic = dev(old_strain - inelastic_strain(old));
    const auto [hardening, back] = hardening_change(state, old);
    return {trace(strain - old_strain) - (inelastic_volume(state) - inelastic_volume(old)),
            select(solid, dot(elastic, elastic - old_elastic), Lane(0.0)), hardening, back,
            cold_work(state) - cold_work(old)};
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

  /// The part left ⊗ right of the tangent where metal flows, with the directions of FlowDirections.
  void add_flow(const Operator& b, Index batch, int q, const Response& response, Lane weight,
                Matrix& symmetric, std::optional<Matrix>& skew) requires RankOneTangent<Response> {
    const LaneMask flows = response.flow_increment > Lane(0.0);
    if (!any(flows)) return;
    const Sym<Lane>& n = response.right;  // of unit length
    const Lane c = dot(response.left, n);
    if (!follows_directions_) {
      add_rank_one(b, response.left, n, weight, c, symmetric, skew);
      return;
    }
    const Sym<Lane> m =
        directions_.at(index(batch, q), properties_.size(), response.relative_norm * n, flows, [&] {
          return isothermal_law(law_).loading(isothermal_part(law_, properties_[index(batch, q)]),
                                              start_state(batch, q),
                                              b.strain(gather(old_displacement_, batch)), effective_dt_);
        });
    Vectors of_left{}, of_right{};
    b.add_force(n, of_right);
    if (skew) {
      b.add_force(response.left + c * (m - n), of_left);
      add_product(of_left, of_right, weight, symmetric, *skew);
    } else {
      b.add_force(m, of_left);
      add_symmetric_product(of_left, of_right, weight * c, symmetric);
    }
  }

  Vectors gather(std::span<const double> u, Index batch) const {
    return mechanics::gather<n_nodes, static_cast<int>(dim)>(u, nodes_of(batch));
  }

  /// Sets the forces to NaN, which Newton's iteration treats as a step that is too long.
  static void invalidate(Vectors& f) {
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
  std::vector<std::size_t> kept_;       ///< lanes of the state that the material can change, rising
  std::size_t n_state_;                 ///< of them, with structural heat also those of StructuralBase
  std::size_t n_kept_;                  ///< with n_extra: lanes of a point's history
  CommonPacks<Properties> properties_;  ///< at Θ_n: [batch][point]
  linear::LaneSlots slots_;
  CommonPacks<Values> averages_;  ///< [batch], of the last finish()
  /// Those that are kept, from the next finish() until the one after it is committed.
  std::optional<CommonPacks<Values>> kept_averages_;
  bool keeps_averages_ = false;  ///< the next finish() sets them aside
  bool keeps_base_ = false;      ///< histories hold a StructuralBase
  FlowDirections directions_;    ///< of the tangents since begin_step()
  /// Whether they are unknowns of their own: false for the consistent tangent.
  bool follows_directions_ = true;
  std::span<const double> temperature_;          ///< Θ_n of the step, [local node]
  std::span<const double> initial_temperature_;  ///< Θ_0, [local node]
  std::span<const double> old_displacement_;     ///< at t_n [m], [local node][component]
  const BlockHistory* old_history_ = nullptr;
  const BlockHistory* start_history_ = nullptr;
  const BlockHistory* old_stress_ = nullptr;
  BlockHistory* new_stress_ = nullptr;
  double stress_share_ = 1;
  double dt_ = 0, effective_dt_ = 0;
  StressAtWork work_ = StressAtWork::end;
  struct Answer {
    Sym<Lane> strain;
    Response response;  ///< its state is not read
  };
  PackVector<Answer> answers_;         ///< of the last forces in this step, [batch][point]; empty: none
  PackVector<Sym<Lane>> kept_stress_;  ///< [batch][point] [Pa]; empty where it is not requested
};

}  // namespace solidus::mechanics
