#include "run/gap_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "contact/contact_report.hpp"
#include "coupling/state.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::model {

void GapWatch::begin(const coupling::State& state) {
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (contacts_[i]->heat() != nullptr)
      pairs_[i].conductance = contact::nodal_fields(contacts_[i]->view(), state.heat.temperature).conductance;
}

void GapWatch::step(const coupling::StepRecord& record, const coupling::State& state) {
  exchanged_ += record.energy.heat_exchanged;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (contacts_[i]->heat() == nullptr) continue;
    Pair& pair = pairs_[i];
    const contact::ContactNodalFields now =
        contact::nodal_fields(contacts_[i]->view(), state.heat.temperature);
    double late = 0, all = 0;
    for (std::size_t a = 0; a < now.conductance.size(); ++a) {
      const double area = now.paired_area[a], before = pair.conductance[a], h = now.conductance[a];
      if (!(area > 0) || !(h > 0) || !(before >= 0)) continue;  // no partner now, or none before
      const double flow = std::abs(now.heat_flux[a] - now.frictional_heat_flux[a]) * area;
      all += flow / h * before;
      late += flow / h * std::abs(h - before);
    }
    pair.conductance = now.conductance;
    // Both surfaces count: half of the sums is the heat that passed.
    late = 0.5 * record.dt * parallel::global_sum(late);
    pair.all += 0.5 * record.dt * parallel::global_sum(all);
    pair.late += late;
    if (late > pair.worst) {
      pair.worst = late;
      pair.worst_time = record.time;
      pair.worst_step = record.dt;
    }
  }
}

void GapWatch::report() const {
  constexpr double k_worth_a_warning = 0.05, k_worth_saying = 0.01;
  constexpr double k_much_heat = 0.01;  // of what moved in the run: interfaces that pass less matter little
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (!(pair.late > k_worth_saying * pair.all && pair.all > k_much_heat * exchanged_)) continue;
    const std::string text = fmt::format(
        "contact '{}': heat passes through the gaps of a step's start; what they changed within the steps is "
        "{:.2g} % of the heat that passed, most in the step of {:g} s to t = {:g} s, {:.3g} of {:.3g} J in "
        "all; "
        "shorter steps there, or coupling.scheme = \"block_iterative\"",
        contacts_[i]->spec().name, 100 * pair.late / pair.all, pair.worst_step, pair.worst_time, pair.worst,
        pair.all);
    if (pair.late > k_worth_a_warning * pair.all)
      logging::warn("{}", text);
    else
      logging::info("{}", text);
  }
}

}  // namespace solidus::model
