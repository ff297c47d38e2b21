/// What the keys of [mesh] say together.
#pragma once

#include "cases/case_spec.hpp"

namespace solidus::setup {

/// Throws InputError where keys of [mesh] contradict each other or the kind of the analysis, each with a
/// message of its own.
void check_mesh(const cases::MeshSpec& mesh, const cases::AnalysisSpec& analysis);

}  // namespace solidus::setup
