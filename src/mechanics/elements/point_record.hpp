/// The record of a step at the points: the trial history, values for results, sums over the block, and the
/// deformation that the thermal phase needs.
#pragma once

#include <algorithm>
#include <cstring>

#include "mechanics/elements/element_averages.hpp"
#include "mechanics/elements/law_history.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class PointRecord : public LawHistory<Law, n_nodes, kind, b_bar, n_extra> {
  using Base = LawHistory<Law, n_nodes, kind, b_bar, n_extra>;

 public:
  using typename Base::Lanes, typename Base::Properties, typename Base::Response, typename Base::State;
  using Values = decltype(values_of(std::declval<Law>(), std::declval<Properties>(), std::declval<Response>(),
                                    Sym<Lane>{}));
  using Averages = ElementAverages<Values>;

  using Base::Base;

 protected:
  using Base::counted, Base::deformation, Base::dt_, Base::geometry_, Base::index, Base::is_solid,
      Base::kept_, Base::law_, Base::n_kept_, Base::old_base, Base::old_state, Base::points_,
      Base::properties_;

  /// Sums of a step over the counted elements, lane by lane.
  struct Tally {
    Lane internal_work{0.0}, stabilisation_work{0.0}, dissipation{0.0}, least{0.0}, largest{0.0},
        inelastic_entropy{0.0};
    PlasticPower plastic;
  };
  /// Average over the points of a batch, weighted with their volumes.
  struct Average {
    Values sums;
    Lane volume{0.0};
  };

  void begin_step(const StepStart& start) {
    Base::begin_step(start);
    old_stress_ = start.old_stress;
    stress_share_ = start.stress_share;
    at_work_ = start.at_work;
  }
  /// @return the values of the elements, to be written; null: not asked for
  Averages* begin_finish(const BlockEnd& end) {
    this->own_points();
    if (end.at_work != nullptr) end.at_work->stress.resize(properties_.size());
    if (end.elements == nullptr) return nullptr;
    return &averages_to_write<Values>(*end.elements, geometry_.n_elements, geometry_.n_batches);
  }

  /// Keeps the answer of a point at the end of a step: history, values for results, what the thermal phase
  /// needs; strains are those that the law has seen.
  /// @return the stress whose work the step does
  Sym<Lane> record(Index batch, int q, const Sym<Lane>& old_strain, const Sym<Lane>& strain,
                   const Response& response, const BlockEnd& end, Average& average, Tally& tally) {
    BlockHistory& trial = end.history;
    const Lane w = geometry_.weight_at(batch, q), share = counted(batch) * w;
    const Properties p = properties_[index(batch, q)];
    Lane* to = trial.values.data() + index(batch, q) * n_kept_;
    if constexpr (KeepsStateInPlace<Law>) {
      std::copy_n(response.state.values, kept_.size(), to);
    } else {
      const auto lanes = std::bit_cast<Lanes>(response.state);
      for (const std::size_t lane : kept_) *to++ = lanes[lane];
    }
    if (end.elements != nullptr) {
      average.volume += w;
      add_weighted(average.sums, w, values_of(law_, p, response, strain));
    }

    if (end.stress != nullptr)
      std::memcpy(static_cast<void*>(end.stress->values.data() + index(batch, q) * k_stress_lanes),
                  &response.stress, sizeof response.stress);
    Sym<Lane> at_work = mean_stress(batch, q, response.stress);
    if (end.at_work != nullptr) end.at_work->stress[index(batch, q)] = at_work;
    if (at_work_ != nullptr) at_work = at_work_->stress[index(batch, q)];
    const Lane work = dot(at_work, strain - old_strain);
    if (points_->kept()) {
      const LaneMask solid = elastic_part(law_, p).solid_fraction >= Lane(1.0);
      auto& point = points_->at(batch, q);
      if constexpr (HoldsEntropy<Properties>) point.pass_temperature = response.temperature;
      const State old = old_state(batch, q);
      point.now = deformation(strain, response.state, solid);
      point.change = change(strain, response.state, old_strain, old, solid);
      point.dissipated = Lane(dt_) * response.dissipation;
      point.work = work;
      const StructuralBase base = old_base(batch, q);
      points_->set_old(batch, q, deformation(old_strain, old, base.solid > Lane(0.0)), base);
      if (this->keeps_base_) this->keep_base(trial, batch, q, points_->base(batch, q, solid));
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

  /// @param averages  null: not asked for
  static void keep(Index batch, const Average& average, Averages* averages) {
    if (averages == nullptr) return;
    const Lane inverse = select(average.volume > Lane(0.0), Lane(1.0) / average.volume,
                                Lane(0.0));  // padding has no volume
    Values mean{};
    add_weighted(mean, inverse, average.sums);
    averages->set(batch, mean);
  }

  /// Hands the deformation out; null without structural heat.
  std::shared_ptr<const StructuralPoints> deformation_found() const {
    return points_->kept() ? points_ : nullptr;
  }
  /// The same of a deformation that has been held.
  std::shared_ptr<const StructuralPoints> deformation_held(const StepStart& start) {
    if (start.expands) points_->expect_expansion();
    return deformation_found();
  }
  void hand_out_deformation(const BlockEnd& end) const {
    if (end.deformation != nullptr) *end.deformation = deformation_found();
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

  /// The mean of the stresses at both ends of a dynamic step.
  Sym<Lane> mean_stress(Index batch, int point, const Sym<Lane>& stress) const {
    if (old_stress_ == nullptr) return stress;
    Sym<Lane> old;
    std::memcpy(static_cast<void*>(&old), old_stress_->values.data() + index(batch, point) * k_stress_lanes,
                sizeof old);
    return Lane(stress_share_) * stress + Lane(1.0 - stress_share_) * old;
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

  double stress_share_ = 1;                   ///< of the end of the step in the stress at work
  const BlockHistory* old_stress_ = nullptr;  ///< as in StepStart
  const StressAtWork* at_work_ = nullptr;     ///< as in StepStart

 private:
  static constexpr std::size_t k_stress_lanes = sizeof(Sym<Lane>) / sizeof(Lane);
};

}  // namespace solidus::mechanics
