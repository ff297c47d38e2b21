/// Makes the cooling channels of the heat room of those of a case.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "numbers/place_function.hpp"

namespace solidus::setup {

/// Checks what a case says of dies: their channels, and their fatigue (criteria_input.hpp). Throws
/// InputError.
void check_dies(const cases::CaseSpec& spec);
/// Checks ways, flows and what the analysis can do with them. Throws InputError.
void check_channels(const cases::CaseSpec& spec);
/// The corners of a way that has been checked, read from its file or made of its lists [m].
std::vector<Position> channel_path(const cases::ChannelSpec& channel, int dimension);
/// Adds all channels; those that do not flow in the stage have a flow of zero.
void add_channels(const cases::CaseSpec& spec, const cases::StageRun* stage,
                  heat::ThermalConditions& conditions);

}  // namespace solidus::setup
