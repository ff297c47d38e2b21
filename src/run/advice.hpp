/// Text for the user when a run stops before its end.
#pragma once

#include <span>
#include <string>

#include "cases/case_spec.hpp"
#include "check/coupling_estimate.hpp"
#include "coupling/restart_data.hpp"

namespace solidus::run {

/// The physics behind it, the equations that failed, the place, what was tried, where the checkpoint lies,
/// and what may help; several lines.
/// @param time the run reached [s]
/// @param checkpoint its file
/// @param couplings  of a run by the isothermal split, otherwise empty
std::string stop_text(const coupling::Stop& stop, const cases::CaseSpec& spec, double time,
                      const std::string& checkpoint, std::span<const check::CouplingEstimate> couplings = {});

}  // namespace solidus::run
