/// The outlook on a mesh before it is made: the extent of the geometry and the expected number of nodes. The
/// reader of meshes tells it before the long part of its work begins (mesh/making/reader_process.hpp), so
/// that a wrong unit or element size is named at once and not after the machine's memory has run out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

struct MeshingOutlook {
  Point sides{};      ///< of the box around the parts, without a mould that is made around them [m]
  double volume = 0;  ///< of the parts [m³]; 0: not known
  double smallest = 0, largest = 0;  ///< sizes of the elements of the parts [m]; 0: as the file says
  double nodes = 0;                  ///< expected, of all bodies, within a factor of two; 0: not known
  /// "'a' and 'b' have 8.2 cm3 in common": bodies of the file of which each has a part for itself and one in
  /// common with the other, which goes to the first; empty where there are none.
  std::string overlap{};
};

/// A piece of the skin of a body and the size of elements on it.
struct SkinPiece {
  double area = 0, size = 0;
};

/// Nodes that tetrahedra take in a body, whose sizes grow from its skin inward up to the largest one:
/// 1.5 / h³ for each volume, integrated over the depth, and what is shared by less elements on the skin.
/// @param skin     lengths in whatever unit the other arguments have
/// @param growth   of the size for each length away from the skin, at least 0
double expected_nodes(const std::vector<SkinPiece>& skin, double volume, double largest, double growth);

/// Nodes of a mesh of second order for each of a mesh of first order with the same tetrahedra.
inline constexpr double k_nodes_of_second_order = 7.5;

/// "1.25 x 0.98 x 0.7 m and 120 dm3 in elements of 5.6 to 8.4 mm, some 12 million nodes".
std::string outlook_text(const MeshingOutlook& outlook);

/// The memory that meshing takes [byte], 0 where the number of nodes is not known.
double meshing_memory(const MeshingOutlook& outlook);

/// From now on tell_outlook() calls `listener`; an empty function: nothing listens. A reader process has a
/// listener of its own, which hands the outlook to the process that asked for the mesh; there it is told
/// again.
void listen_to_outlook(std::function<void(const MeshingOutlook&)> listener);
void tell_outlook(const MeshingOutlook& outlook);

/// Called every now and then while a mesh is waited for, with what goes on: a line of the log; from now on a
/// call of `listener` instead, until that is an empty function.
void listen_to_progress(std::function<void(const std::string&)> listener);
void tell_progress(const std::string& text);

}  // namespace solidus::mesh
