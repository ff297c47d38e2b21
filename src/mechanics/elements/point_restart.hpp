/// The return mapping of the thermal phase at the points (4.45, 4.49, 4.54): solid metal flows again at the
/// temperatures of the step's end, from the internal variables at t_n.
#pragma once

#include "mechanics/elements/point_record.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class PointRestart : public PointRecord<Law, n_nodes, kind, b_bar, n_extra> {
  using Base = PointRecord<Law, n_nodes, kind, b_bar, n_extra>;

 public:
  using Base::Base;
  using typename Base::Properties, typename Base::Response, typename Base::State, typename Base::Values;

 protected:
  using Base::counted, Base::deformation, Base::dt_, Base::effective_, Base::geometry_, Base::index,
      Base::law_, Base::layout_, Base::old_state, Base::points_, Base::properties_, Base::start_state,
      Base::update;
  using typename Base::Average, typename Base::Averages;

  /// FlowChange of a block, lane by lane.
  struct Restart {
    StepSums change;
    LaneMask flows = Lane(0.0) > Lane(0.0);
    bool found = true;
  };

  /// restart_flow() at a point; strains are those that the law has seen in the mechanical phase.
  void restart_point(const StepStart& start, Index batch, int q, const Sym<Lane>& old_strain,
                     const Sym<Lane>& strain, Workspace<Law>& space, BlockHistory& trial, Average& average,
                     Restart& restart) {
    const Properties properties = properties_[index(batch, q)];
    const LaneMask solid = elastic_part(law_, properties).solid_fraction >= Lane(1.0);
    const State old = old_state(batch, q);
    // All of the mechanical phase's answer is taken before the law is asked again: a state may lie in the
    // workspace.
    const Response kept = update(batch, q, strain, space);
    Values values = values_of(law_, properties, kept, strain);
    const Flow of_mechanics = flow(law_, kept, strain, old_strain, old, solid);

    const auto& law = law_at_temperature(law_);
    auto p = law.properties_at(temperature_at(geometry_, batch, q, start.pass_temperature),
                               temperature_at(geometry_, batch, q, start.initial_temperature),
                               this->phase_at(start, batch, q));
    if (start.melt_modulus() > 0)
      set_melt_viscosity(start.melt_viscosity(this->phase_at(start, batch, q).solid_fraction), p);
    const auto anew = answer(law, p, start_state(batch, q), strain, space);
    restart.found = restart.found && anew.status == material::Status::converged;
    const Flow now = select_lanes(solid, flow(law, anew, strain, old_strain, old, solid), of_mechanics);

    auto& shown = values_at_temperature(values);
    shown = select_lanes(solid, values_of(law, p, anew, strain), shown);
    const Lane w = geometry_.weight_at(batch, q), share = counted(batch) * w;
    average.volume += w;
    add_weighted(average.sums, w, values);
    layout_.replace(anew.state, solid, trial, index(batch, q));
    if (points_->kept()) {
      points_->keep_of_mechanics(batch, q, of_mechanics.now);
      auto& point = points_->at(batch, q);
      point.now = now.now;
      point.change = now.change;
      point.dissipated = Lane(dt_) * now.dissipation;
    }
    StepSums& change = restart.change;
    change.add_power(share, now.dissipation - of_mechanics.dissipation,
                     {now.plastic.power - of_mechanics.plastic.power,
                      now.plastic.dissipation - of_mechanics.plastic.dissipation});
    change.inelastic_entropy += share * (now.inelastic_entropy - of_mechanics.inelastic_entropy);
    change.add_extremes(counted(batch), now.dissipation);
    restart.flows = restart.flows | (abs(now.dissipation - of_mechanics.dissipation) > Lane(0.0)) |
                    (abs(now.now.elastic_squared - of_mechanics.now.elastic_squared) > Lane(0.0));
  }

  /// Takes the deformation of the mechanical phase over, to bring it up to date.
  Averages* begin_restart(const BlockEnd& end) {
    if (end.deformation != nullptr && *end.deformation)
      points_ = std::make_shared<StructuralPoints>(**end.deformation);
    return this->begin_finish(end);
  }

  FlowChange total(const Restart& restart) const {
    return {restart.change.total(dt_), any(restart.flows), restart.found};
  }

 private:
  /// The contribution of the flow of a point to the heat balance.
  struct Flow {
    Deformation now, change;
    Lane dissipation;  ///< D_mech [W/m³]
    PlasticPower plastic;
    Lane inelastic_entropy;  ///< [J/(m³ K)]
  };
  template <class AnyLaw, class Answer>
  static Flow flow(const AnyLaw& law, const Answer& r, const Sym<Lane>& strain, const Sym<Lane>& old_strain,
                   const State& old, const LaneMask& solid) {
    return {deformation(strain, r.state, solid), Base::change(strain, r.state, old_strain, old, solid),
            r.dissipation, plastic_power(law, r), solidus::mechanics::inelastic_entropy(r.state)};
  }

  template <class AnyLaw, class AnyProperties>
  auto answer(const AnyLaw& law, const AnyProperties& p, const State& from, const Sym<Lane>& strain,
              Workspace<Law>& space) const {
    if constexpr (KeepsStateInPlace<Law>)
      return law.update(p, from, strain, effective_, space);
    else
      return law.update(p, from, strain, effective_);
  }
};

}  // namespace solidus::mechanics
