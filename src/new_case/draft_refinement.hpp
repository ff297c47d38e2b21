/// Refines the draft of a new case by building it: the built case shows cores and free skins, the number of
/// nodes and the freezing time, from which bodies, films, sizes, walls and the end of the run follow.
#pragma once

#include <string>
#include <vector>

#include "material/material.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/new_case_text.hpp"

namespace solidus::new_case {

/// The last draft as it was built.
struct DraftEstimate {
  double nodes = 0, metal_nodes = 0;
  double shortest_edge = 0, longest_edge = 0;  ///< of the elements of what is poured [m]
  double freezing = 0;                         ///< [s]
  double least_quality = 1;             ///< of elements where no way of meshing gave sound ones, else 1
  std::string worst_element;            ///< its place (mesh/making/worst_tetrahedron.hpp)
  std::vector<std::string> skin_notes;  ///< remarks on new skins of facets (RawMesh::notes)
  std::string overlap;  ///< MeshingOutlook::overlap of the part; empty where no bodies overlap
};

/// Writes the folder of the draft: case.toml and a copy of the geometry. Throws InputError.
void write_draft(const Draft& draft);

/// Builds, checks and writes the case until its sizes and walls fit, at most four times.
/// @param alloy     what is cast: its heat is what the channels of a die take, shot after shot
/// @param fineness  so many times as many elements along each edge as usual
/// @param time_of_direct_ways  what measuring the part has left of it (mesh/making/kept_mesh.hpp) [s]
/// Throws InputError, and then leaves no case.toml.
DraftEstimate refine_draft(Draft& draft, const CastingProcess& process, const material::Material& alloy,
                           double fineness, double time_of_direct_ways);

}  // namespace solidus::new_case
