/// What a case must have in common with the one whose checkpoint it continues.
#pragma once

#include <vector>

#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "model/case_spec.hpp"
#include "results/checkpoint.hpp"

namespace solidus::model {

/// The state must mean the same: analysis, mesh, bodies, and what the materials are made of. Loads, times,
/// tolerances and outputs may have changed. Collective.
results::Fingerprint fingerprint(const CaseSpec& spec, const mesh::Mesh& mesh,
                                 const std::vector<material::Material>& materials);

}  // namespace solidus::model
