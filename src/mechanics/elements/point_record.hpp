/// The record of a step at the points: the trial history, values for results, sums over the block
/// (step_sums.hpp), the stress whose work the step does (stress_of_work.hpp), and the deformation that the
/// thermal phase needs.
#pragma once

#include "mechanics/elements/element_averages.hpp"
#include "mechanics/elements/law_history.hpp"
#include "mechanics/elements/step_sums.hpp"
#include "mechanics/elements/stress_of_work.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class PointRecord : public LawHistory<Law, n_nodes, kind, b_bar, n_extra> {
  using Base = LawHistory<Law, n_nodes, kind, b_bar, n_extra>;

 public:
  using typename Base::Properties, typename Base::Response, typename Base::State;
  using Values = decltype(values_of(std::declval<Law>(), std::declval<Properties>(), std::declval<Response>(),
                                    Sym<Lane>{}));
  using Averages = ElementAverages<Values>;

  using Base::Base;

 protected:
  using Base::counted, Base::deformation, Base::dt_, Base::geometry_, Base::index, Base::is_solid, Base::law_,
      Base::layout_, Base::old_base, Base::old_state, Base::points_, Base::properties_;

  /// Average over the points of a batch, weighted with their volumes.
  struct Average {
    Values sums;
    Lane volume{0.0};
  };

  void begin_step(const StepStart& start) {
    Base::begin_step(start);
    stress_of_work_.begin_step(start);
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
                   const Response& response, const BlockEnd& end, Average& average, StepSums& sums) {
    BlockHistory& trial = end.history;
    const Lane w = geometry_.weight_at(batch, q), share = counted(batch) * w;
    const Properties p = properties_[index(batch, q)];
    layout_.write(response.state, trial, index(batch, q));
    if (end.elements != nullptr) {
      average.volume += w;
      add_weighted(average.sums, w, values_of(law_, p, response, strain));
    }

    const Sym<Lane> at_work = stress_of_work_.record(index(batch, q), response.stress, end);
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
      if (layout_.has_base()) layout_.write_base(points_->base(batch, q, solid), trial, index(batch, q));
    }

    sums.internal_work += share * work;
    sums.add_power(share, response.dissipation, plastic_power(law_, response));
    sums.inelastic_entropy +=
        share * (inelastic_entropy(response.state) - inelastic_entropy(old_state(batch, q)));
    sums.add_extremes(counted(batch), response.dissipation);
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

  StressOfWork stress_of_work_;
};

}  // namespace solidus::mechanics
