/// What a user reads when a run stops before its end.
#pragma once

#include <string>

#include "coupling/continuation.hpp"
#include "model/case_spec.hpp"

namespace solidus::model {

/// Reason, place, what was tried, where the checkpoint lies, and what may help; several lines.
/// @param time the run reached [s]
/// @param checkpoint its file
std::string stop_text(const coupling::Stop& stop, const CaseSpec& spec, double time,
                      const std::string& checkpoint);

}  // namespace solidus::model
