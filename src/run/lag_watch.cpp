/// Each lag is measured as a share of all change, so that its text can carry a number.
#include "run/lag_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/scheme_names.hpp"
#include "coupling/state.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

constexpr double k_worth_a_warning = 0.05, k_worth_saying = 0.01;

void say(double share, const std::string& text) {
  if (share > k_worth_a_warning)
    logging::warn("{}", text);
  else
    logging::info("{}", text);
}

}  // namespace

void LagWatch::begin(const coupling::State& state) {
  first_ = before_ = now_ = state.mechanics.displacement;
}

void LagWatch::step(const coupling::StepRecord& record, const coupling::State& state) {
  before_ = std::exchange(now_, state.mechanics.displacement);
  dt_ = record.dt;
}

void LagWatch::end(const coupling::State&) {
  constexpr double k_least = 0.001;
  double last = 0, all = 0;
  // The change of the last step as a share of all change in the run is what the lag of a step amounts to.
  for (std::size_t i = 0; i < now_.size(); ++i) {
    last = std::max(last, std::abs(now_[i] - before_[i]));
    all = std::max(all, std::abs(now_[i] - first_[i]));
  }
  last = parallel::global_max(last);
  all = parallel::global_max(all);
  // Where nothing moved at the end there is no lag.
  if (!(last > k_least * all)) return;
  const std::string text = fmt::format(
      "displacements and stresses belong to the temperatures one step before (coupling.order = "
      "\"mechanics_first\"): in the last step, {:g} s, displacements changed by {:.2g} % of all their change",
      dt_, 100 * last / all);
  if (keeps_strain_)
    say(last / all,
        text + "; what melts or yields keeps the strain of those temperatures, which heat_first does not");
  else
    logging::info("{}", text);
}

FrictionLagWatch::FrictionLagWatch(const std::vector<contact::ContactPair*>& contacts, bool maps_again,
                                   bool after_heat)
    : contacts_(contacts), pairs_(contacts.size()), maps_again_(maps_again), after_heat_(after_heat) {
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (const auto& friction = contacts[i]->parts().spec.friction)
      pairs_[i].coefficient.emplace(friction->coefficient);
}

void FrictionLagWatch::begin(const coupling::State& state) {
  for (std::size_t i = 0; i < state.contacts.size() && i < pairs_.size(); ++i) {
    pairs_[i].work.clear();
    for (const contact::ContactPointState& point : state.contacts[i].points)
      pairs_[i].work.push_back(point.work);
  }
}

void FrictionLagWatch::step(const coupling::StepRecord&, const coupling::State& state) {
  // The work of friction of this step at points that slip, and the part of it by which traction and friction
  // coefficient at the temperature now differ.
  for (std::size_t i = 0; i < state.contacts.size() && i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    const auto& points = state.contacts[i].points;
    // Only friction whose coefficient depends on temperature can lag.
    if (!pair.coefficient) continue;
    pair.work.resize(points.size(), 0.0);
    std::vector<double> conducted;
    if (after_heat_) conducted = contacts_[i]->parts().heat.conducted_temperatures(state.heat.temperature);
    for (std::size_t p = 0; p < points.size(); ++p) {
      // For each slipping point the work since the step before, and what the coefficient at today's
      // temperature would have given.
      const contact::ContactPointState& point = points[p];
      const double work = point.work - std::exchange(pair.work[p], point.work);
      if (point.status != contact::PointStatus::slips || !(point.temperature > 0) || !(work > 0)) continue;
      const double limit =
          pair.coefficient
              ->value(point.internal_variable, p < conducted.size() ? conducted[p] : point.temperature)
              .value *
          contact::rubbing_pressure(point.pressure, point.molten);
      // The relative error of the traction weighs by its work.
      if (!(limit > 0)) continue;
      pair.late += work * std::abs(contact::norm(point.traction) / limit - 1);
      pair.all += work;
    }
  }
}

void FrictionLagWatch::report() const {
  // Pairs whose error is worth a line.
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (!pairs_[i].coefficient) continue;
    const double late = parallel::global_sum(pairs_[i].late), all = parallel::global_sum(pairs_[i].all);
    if (!(late > k_worth_saying * all)) continue;
    say(late / all,
        fmt::format(
            "contact '{}': friction slips with the coefficient of the temperature before each step; "
            "its tractions are {:.3g} % off that of their own time, on average over its work; less in "
            "shorter steps, not at all with {}coupling.scheme = {}",
            contacts_[i]->parts().spec.name, 100 * late / all,
            maps_again_ ? "thermal_return_mapping in [contact.friction] or with " : "",
            coupling::names_of_schemes([](const coupling::SchemeTraits& t) {
              return t.iterates || t.mapping == mechanics::Mapping::simultaneous;
            })));
  }
}

void StressWorkWatch::step(const coupling::StepRecord& record, const coupling::State&) {
  const coupling::EnergyAudit& e = record.energy;
  const double dissipated = e.plastic_dissipation + e.viscous_dissipation + e.friction;
  excess_ += e.excess_work;
  dissipated_ += dissipated;
  moved_ += e.heat_exchanged;
}

void StressWorkWatch::report() const {
  // Deformation that heats less than this share of all heat exchanged matters little. That sum of magnitudes
  // counts heat of deformation up to four times, as given and as stored in each of two stages.
  constexpr double k_much_heat = 0.0025;
  if (!(excess_ > k_worth_saying * dissipated_ && excess_ > k_much_heat * moved_)) return;
  logging::info(
      "the stresses of the ends of steps do the work of whole steps: {:.3g} J of the heat of deformation, "
      "compared with {:.3g} J of dissipation, come of that; half as much with half the step, but of loads "
      "that act at once, half of whose work is heat",
      excess_, dissipated_);
}

}  // namespace solidus::run
