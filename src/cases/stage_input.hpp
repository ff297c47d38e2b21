/// Stages and cycles of a case, laid out in time.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/restart_data.hpp"

namespace solidus::cases {

/// One stage as it comes in the run.
struct StageRun {
  const StageSpec* stage = nullptr;
  int number = 0;             ///< of the stage in the case, from one
  int cycle = 0;              ///< how often its cycle has come round, from one; zero outside of cycles
  double start = 0, end = 0;  ///< [s]
  int shot = 0;               ///< the shot that it belongs to, from one; zero: to none
  bool begins_shot = false, ends_shot = false;
  bool pours = false;  ///< a body is there that was not in the stage before
};

/// Whether the rounds of a cycle are shots: bodies come and leave in it, or its periodic state is wanted.
bool is_of_shots(const CaseSpec& spec, const CycleSpec& cycle);

/// Bodies that are there in all stages of the shots, [body].
std::vector<char> staying_bodies(const CaseSpec& spec);

/// The cycle whose periodic state ends the run; null where none does.
const CycleSpec* periodic_cycle(const CaseSpec& spec);

/// All stages in the order of the run; empty in a case without stages. The case must outlive them.
std::vector<StageRun> stage_runs(const CaseSpec& spec);

/// Whether something that names its stages holds in one of them; without names it holds in all, and without a
/// stage always.
bool holds(const std::vector<std::string>& stages, const StageRun* run);

/// A table of the case, on the clock that the user chose.
TimeFunction on_clock(const Function& function, TimeOrigin clock, const StageRun* run);

/// The first step of a stage [s].
double first_step(const StageSpec& stage, const TimeSpec& time);

/// Checks stages and cycles by themselves and sets the end of the run where there are stages. Throws
/// InputError.
void resolve_stages(CaseSpec& spec);

/// Checks that everything that names stages names existing ones. Throws InputError.
void check_stage_names(const CaseSpec& spec);

/// Throws InputError unless the stage that a checkpoint of this time is in is the same in the case.
void check_stage_of_checkpoint(const CaseSpec& spec, const coupling::StageStart& stage, double time);

}  // namespace solidus::cases
