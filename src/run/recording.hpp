/// Options of the recorder of a run, from the case and what was built of it.
#pragma once

#include "results/recorder.hpp"
#include "run/session.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// Whether the case has shots.
bool has_shots(const setup::Assembly& a);

/// Nodes and elements of the mesh, with the names of the bodies, which need not be those of their groups.
/// Collective.
results::MeshCounts counts(const cases::CaseSpec& spec, const mesh::Mesh& mesh);

/// Probes, fields, castings and the head of the summary. Collective. Throws InputError for an output that the
/// case cannot have.
results::RecorderOptions recorder_options(const setup::Case& c, const RunOptions& options,
                                          const setup::Assembly& a);

}  // namespace solidus::run
