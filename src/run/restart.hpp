/// The checkpoint that a run is to go on from.
#pragma once

#include <optional>

#include "results/recorder.hpp"
#include "run/session.hpp"
#include "setup/assembly.hpp"
#include "setup/fingerprint.hpp"

namespace solidus::run {

/// Reports errors that case and folder show before the mesh is read. Throws InputError.
void check_restart(const cases::CaseSpec& spec, const RunOptions& options);

/// Reads the checkpoint; nothing without RunOptions::restart. Collective. Throws InputError where it does not
/// fit the case, or the run has ended already.
std::optional<results::Checkpoint> checkpoint(const cases::CaseSpec& spec, const RunOptions& options,
                                              setup::Assembly& a, const results::Fingerprint& fingerprint);

}  // namespace solidus::run
