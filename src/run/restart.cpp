/// A checkpoint is read, compared with the case, and refused where the run has ended already.
#include "run/restart.hpp"

#include <fmt/format.h>

#include "cases/stage_input.hpp"
#include "numbers/index_casts.hpp"
#include "results/output/run_lock.hpp"
#include "setup/run_input.hpp"
#include "setup/time_input.hpp"
#include "system/log.hpp"

namespace solidus::run {

void check_restart(const cases::CaseSpec& spec, const RunOptions& options) {
  if (!options.restart) return;
  if (spec.time.steady)
    throw InputError(spec.time.where, "a steady analysis has nothing to continue", "run without --restart");
  results::CheckpointFolder(options.folder).require();
}

std::optional<results::Checkpoint> checkpoint(const cases::CaseSpec& spec, const RunOptions& options,
                                              setup::Assembly& a, const results::Fingerprint& fingerprint) {
  // Without --restart a run begins again.
  if (!options.restart) return {};
  const results::CheckpointFolder folder(options.folder);
  results::Checkpoint found = folder.read(a.mesh, fingerprint, a.initial);
  cases::check_stage_of_checkpoint(spec, found.continuation.stage, found.state.time);
  // A run may have ended for three reasons before its time: periodic, all solid, or its end time reached.
  const cases::CycleSpec* cycle = cases::periodic_cycle(spec);
  const cases::StageRun* stage =
      found.continuation.stage.number > 0 ? &a.stages[as_size(found.continuation.stage.number) - 1] : nullptr;
  const bool periodic = cycle != nullptr && stage != nullptr && stage->ends_shot &&
                        found.state.time == stage->end && found.continuation.shots.shots > 0 &&
                        found.continuation.shots.change <= *cycle->periodic;
  // Each reason that has ended the run is told with the key that would let it go on.
  if (periodic && results::is_finished(options.folder))
    throw InputError(cycle->where,
                     fmt::format("the run has found its periodic state already, to {:.3g} K in shot {}",
                                 found.continuation.shots.change, found.state.shot),
                     "a smaller 'periodic' in the cycle");
  constexpr double k_solid = 1 - 1e-12;
  const bool solid = spec.time.until == cases::TimeSpec::Until::solid && a.heat &&
                     a.heat->states().mean_solid_fraction(found.state.heat) >= k_solid;
  if (solid && results::is_finished(options.folder))
    throw InputError(
        spec.time.where,
        fmt::format("the run has ended at t = {:g} s: all that was poured is solid", found.state.time),
        "time.until = \"end\" to go on until time.end");
  // A run that was killed behind its last checkpoint has but its summary to write.
  const bool reached = found.state.time == *spec.time.end || periodic || solid;
  if (reached && !results::is_finished(options.folder)) {
    logging::info("the run has reached t = {:g} s already; its results are completed", found.state.time);
    return found;
  }
  if (found.state.time >= *spec.time.end)
    throw InputError(spec.time.where,
                     fmt::format("the run has reached t = {:g} s already; the end is at {:g} s",
                                 found.state.time, *spec.time.end),
                     spec.stages.empty() ? "a later end: time.end" : "further stages");
  return found;
}

}  // namespace solidus::run
