/// What the keys of [mesh] say together.
#pragma once

#include "case/case_spec.hpp"

namespace solidus::model {

/// Throws InputError where keys of [mesh] contradict each other or the kind of the analysis, each with a
/// message of its own.
void check_mesh(const MeshSpec& mesh, const AnalysisSpec& analysis);

}  // namespace solidus::model
