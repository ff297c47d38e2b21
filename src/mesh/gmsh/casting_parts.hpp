/// Bodies of a geometry while Gmsh has it open, for the making of the mesh of a casting (casting_mesh.cpp).
/// In the reader's process.
#pragma once

#include <gmsh.h>

#include <set>
#include <string>
#include <vector>

#include "mesh/making/casting_geometry.hpp"

namespace solidus::mesh {

/// A box along the axes, in units of the file.
struct Extent {
  Point low, high;
  double diagonal() const;
};

/// The box around entities of the geometry; a little large, as Gmsh has it.
Extent extent_of(const gmsh::vectorpair& entities);

/// All volumes of the geometry.
gmsh::vectorpair all_volumes();

/// The numbers of the surfaces of a volume.
std::vector<int> boundary_of(int volume);

/// A body of the file: its volumes change their numbers on the way.
struct BodyVolumes {
  std::string name;
  gmsh::vectorpair volumes;
};

struct CastingParts {
  std::vector<BodyVolumes> bodies;
  std::string overlap;  ///< as in MeshingOutlook
};

/// The bodies of the geometry that Gmsh has open, closed, healed, halved, with riser and mould, cut with each
/// other so that they share the faces in which they touch.
/// @param healing  tolerance, of the extent of each body; 0: the bodies stay as the file has them
/// Throws InputError where nothing solid is there, bodies overlap, or a group of the case fits none.
CastingParts make_parts(const MeshSource& source, const CastingGeometry& geometry, double healing);

/// gmsh::model::mesh::generate(), whose errors come as std::string also where several threads mesh surfaces:
/// Gmsh itself would end the process there.
void generate_mesh(int dimension);

/// The numbers of the surfaces that errors and warnings of Gmsh name.
std::set<int> surfaces_at_fault();

/// The last error of Gmsh, and the surfaces that it complained of by their owners and places:
/// " (Error: …); at fault: a face of 'casting' around (1, 2, 3), 4 long"; empty where it has said nothing.
std::string place_of_complaints(const std::vector<BodyVolumes>& parts);

}  // namespace solidus::mesh
