/// Solids of risers, sleeves, chills and gating, while Gmsh has the geometry of the casting open. In the
/// reader's process.
#pragma once

#include <gmsh.h>

#include <functional>
#include <string>
#include <vector>

#include "mesh/making/casting_geometry.hpp"

namespace solidus::mesh {

/// A body that is made next to those of the file.
struct AddedBody {
  std::string name;
  int volume = -1;  ///< its number in the CAD kernel
};

/// Adds risers, gating, then the sleeves of the risers, then chills: of what several of them fill, the first
/// keeps it.
/// @param unit  of the file [m]
/// @param kept  what of a volume lies in the half that is kept
std::vector<AddedBody> add_feeders(const CastingGeometry& geometry, double unit,
                                   const std::function<int(int)>& kept);

}  // namespace solidus::mesh
