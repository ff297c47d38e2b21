/// A whole mesh as it was read or generated, on rank 0 only, before it is distributed.
#pragma once

#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "mesh/geometry_choice.hpp"
#include "mesh/mesh.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

struct RawBlock {
  Shape shape;
  std::vector<Index> nodes;  ///< [element][node], numbers into RawMesh::x
  InputNumbers input_element;
};
struct RawGroup {
  int dimension;  ///< of its elements; 0 for points
  std::vector<RawBlock> blocks;
};
/// One smooth face of a geometry.
struct DrawnFace {
  /// Each by its vertices in rising order; of triangles the first is −1 (FaceKey).
  std::vector<std::array<Index, 4>> facets;
  double radius = 0;  ///< of a cylinder [m]; 0: it is none
};

/// By less do the facets of a smooth part of a skin, and the faces of a geometry that continue one another,
/// bend [rad].
inline constexpr double k_smooth_bend = std::numbers::pi / 6;

struct RawMesh {
  int dimension = 2;
  std::vector<Point> x;  ///< [m]
  std::vector<GlobalIndex> input_node;
  std::map<std::string, RawGroup> groups;  ///< named groups of every dimension, as in the input
  /// What was left out or taken for something while the file was read, for the user: a sentence each.
  std::vector<std::string> notes = {};
  /// Why nothing is to be computed on this mesh, where it is not sound; told after what else a case has
  /// wrong.
  std::optional<InputError> unsound = {};
  /// Of all solids of a CAD file, by its surfaces and not by the mesh's facets [m]; absent: it is no CAD
  /// file.
  std::optional<Point> centre_of_volume = {};
  /// The smooth faces of the geometry that the mesh was made of; empty: it was made of none, or facets of it
  /// are not known.
  std::vector<DrawnFace> drawn_faces = {};
};

/// A mesh file and how it is to be read.
struct MeshSource {
  std::string path;
  double unit_in_metres = 1;  ///< length of one unit of the file (0.001 for millimetres)
  double element_size = 0;  ///< target size [m] for files that Gmsh meshes (.geo, STEP); 0: as the file says
  int element_order = 1;    ///< 1 or 2, for files that Gmsh meshes
  /// Values for the constants that a .geo script declares with DefineConstant, by name and in the script's
  /// units.
  std::map<std::string, double> constants = {};
  GeometryChoice geometry = {};  ///< groups of files that Gmsh meshes
  /// Run a script without checks, and the options file next to a mesh: it can do whatever a program can do.
  /// Else a script may only make geometry (mesh/files/gmsh_script.hpp).
  bool trust_script = false;
  double size_factor = 1;  ///< on all element sizes of a file that Gmsh meshes
};

/// Reads a mesh, or makes one of a geometry (mesh/files/file_format.hpp lists the formats). Rank 0 only.
/// Throws InputError naming the file for a missing, empty, truncated or meaningless mesh, for one that is not
/// what its name says, for a script that does more than geometry, and for a constant that a script does not
/// declare.
RawMesh read_mesh(const MeshSource& source);
/// The same, without the further choices.
RawMesh read_mesh(const std::string& path, double unit_in_metres, double element_size = 0,
                  int element_order = 1, const std::map<std::string, double>& constants = {},
                  const GeometryChoice& geometry = {});

/// Checks that every element has a positive Jacobian (reorients mirrored elements, throws InputError with
/// number and place for degenerate or inverted ones), finite coordinates, no unused bodies; boundary faces
/// are oriented outward of their element.
void validate_and_orient(RawMesh& mesh, const std::string& path);

/// Splits a mesh over the processes of PETSC_COMM_WORLD (collective; `raw` matters on rank 0 only).
/// @param bodies      groups of full dimension that take part, in this order: Mesh::bodies
/// @param replicated  surfaces that every process holds (contact)
Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated);

}  // namespace solidus::mesh
