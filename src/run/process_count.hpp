/// How many processes pay for a case, by what its steps cost (decision 0077). All numbers that decide are
/// in process_count.cpp.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "material/material.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::run {

/// What a run has to do.
struct RunWork {
  double heat_nodes = 0;       ///< of the mesh that have a temperature
  double mechanics_nodes = 0;  ///< that have a displacement
  double poured_nodes = 0;     ///< of these, that melt, flow and yield
  bool solid = false;          ///< in three dimensions
  double steps = 1;            ///< as many as the run takes at least, or is likely to take
};

/// Counts the nodes of the bodies that take part.
/// @param materials  of the bodies, in their order
RunWork run_work(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                 const mesh::RawMesh& mesh);

/// The wall clock that a run is expected to take on free cores [s].
double expected_seconds(const RunWork& work, int processes);

/// The number of processes beyond which another one is hardly worth its core, from one to `cores`.
int processes_that_pay(const RunWork& work, int cores);

}  // namespace solidus::run
