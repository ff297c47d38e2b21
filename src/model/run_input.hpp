/// From the case to what a run needs besides the phases: times and probes.
#pragma once

#include <vector>

#include "coupling/simulation.hpp"
#include "model/case_spec.hpp"
#include "results/probes.hpp"

namespace solidus::model {

/// End, step sizes, and all output times of a transient run.
coupling::TimeOptions time_options(const CaseSpec& spec);

/// The probes in the order of the case; points know the number of their body. Throws InputError for a
/// component that the field does not have.
std::vector<results::Probe> probes(const CaseSpec& spec);

}  // namespace solidus::model
