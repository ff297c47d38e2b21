/// Finds the times at which steps should end because a condition of the case bends or jumps there.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "numbers/time_events.hpp"

namespace solidus::setup {

/// Events of all that is a function of time: thermal and mechanical conditions that hold in the stage, and
/// rigid surfaces. Of tables the points that they need (corners()); of formulas of t alone every jump and
/// bend that breaks() sees; of formulas of place and time those of their comparisons that have no coordinate,
/// `t < 5`; of files of points their times. In no order.
/// @param stage     null: a run without stages
/// @param from, to  times of the run [s]
/// @param step      asked for [s]
std::vector<TimeEvent> time_events(const cases::CaseSpec& spec, const cases::StageRun* stage, double from,
                                   double to, double step);

}  // namespace solidus::setup
