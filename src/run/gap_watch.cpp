/// Sums of heat that passed gaps of another width than the step ended with.
#include "run/gap_watch.hpp"

#include <fmt/format.h>

#include "coupling/scheme_names.hpp"
#include "coupling/state.hpp"
#include "system/log.hpp"

namespace solidus::run {

void GapWatch::step(const coupling::StepRecord& record, const coupling::State& /*state*/) {
  // Heat that passed a gap of another width than the step ended with is misplaced; it is summed up,
  // and its worst step is kept.
  exchanged_ += record.energy.heat_exchanged;
  for (std::size_t i = 0; i < record.gap_heat.size(); ++i) {
    Pair& pair = pairs_[i];
    const double late = record.dt * record.gap_heat[i].misplaced;
    pair.all += record.dt * record.gap_heat[i].passed;
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
  // Interfaces that misplaced a share of their heat worth a word, and passed enough heat to matter.
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (!(pair.late > k_worth_saying * pair.all && pair.all > k_much_heat * exchanged_)) continue;
    const std::string text = fmt::format(
        "contact '{}': gaps changed within steps after their heat had passed; that misplaced {:.2g} % of it, "
        "most in the step of {:g} s to t = {:g} s, {:.3g} of {:.3g} J in all; shorter steps there, a smaller "
        "coupling.gap_tolerance, or coupling.scheme = {}",
        contacts_[i]->parts().spec.name, 100 * pair.late / pair.all, pair.worst_step, pair.worst_time,
        pair.worst, pair.all,
        coupling::names_of_schemes([](const coupling::SchemeTraits& t) { return t.iterates; }));
    if (pair.late > k_worth_a_warning * pair.all)
      logging::warn("{}", text);
    else
      logging::info("{}", text);
  }
}

}  // namespace solidus::run
