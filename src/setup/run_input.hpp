/// Makes the probes of a run from the case.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "results/tables/probes.hpp"
#include "results/tables/profile_table.hpp"

namespace solidus::setup {

/// The probes in the order of the case; points know the number of their body. Throws InputError for a
/// component that the field does not have.
std::vector<results::Probe> probes(const cases::CaseSpec& spec);
/// Throws InputError as probes().
std::vector<results::Profile> profiles(const cases::CaseSpec& spec);

}  // namespace solidus::setup
