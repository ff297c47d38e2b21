/// A step is too long if its error would have shortened it, had it not been the shortest one.
#include "run/growth_step_watch.hpp"

#include <algorithm>

#include "coupling/simulation.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/time_input.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

constexpr double k_stretched = 1.2;  ///< a step may be longer by this to land on an event

}  // namespace

bool chooses_shortest_step_of_growth(const cases::CaseSpec& spec) {
  return !spec.depositions.empty() && spec.has_mechanics() && spec.time.adaptive && !spec.time.min_step;
}

GrowthStepWatch::GrowthStepWatch(const cases::CaseSpec& spec, const setup::Assembly& a) {
  const coupling::TimeOptions options = setup::time_options(spec);
  shortest_ = options.step.min_step;
  for (const coupling::Stage& stage : options.stages) shortest_ = std::max(shortest_, stage.step.min_step);
  limits_ = options.step.limits;
  limits_.displacement = setup::displacement_error(spec.time, setup::sections_of(spec, a.mesh));
}

void GrowthStepWatch::step(const coupling::StepRecord& record, const coupling::State&) {
  ++steps_;
  if (record.dt > k_stretched * shortest_) return;
  coupling::StepMeasure measure;
  measure.displacement_error = record.displacement_error;
  if (!coupling::strictest(limits_, measure).exceeded) return;
  ++too_long_;
  if (record.displacement_error <= worst_) return;
  worst_ = record.displacement_error;
  worst_time_ = record.time;
}

void GrowthStepWatch::report() const {
  if (too_long_ == 0) return;
  logging::warn(
      "{} of {} steps have errors of the displacement above {:.3g} m, up to {:.3g} m at t = {:g} s, but were "
      "not "
      "made shorter than {:.3g} s, for bodies grow; a smaller time.min_step lets them",
      too_long_, steps_, limits_.displacement, worst_, worst_time_, shortest_);
}

}  // namespace solidus::run
