/// Fingerprint of a case: the data that it must have in common with the case whose checkpoint it continues.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "results/checkpoint/checkpoint.hpp"

namespace solidus::setup {

/// The state must mean the same: analysis, every node and element of the mesh, bodies, what the materials are
/// made of, and the temperatures that the run began with. Loads, times, tolerances and outputs may have
/// changed. Collective; the same on every number of processes.
/// @param initial  temperatures at the start of the run, [node] of this process; empty without heat
results::Fingerprint fingerprint(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                 const std::vector<material::Material>& materials,
                                 const std::vector<double>& initial);

}  // namespace solidus::setup
