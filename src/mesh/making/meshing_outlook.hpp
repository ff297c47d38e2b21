/// Estimates before a mesh is made: the extent of the geometry and the expected number of nodes. The reader
/// of meshes reports them before its long work begins (mesh/making/reader_process.hpp), so that a wrong unit
/// or element size is noticed at once and not when the memory is exhausted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

struct MeshingOutlook {
  Point sides{};      ///< of the bounding box of the parts, without a mould generated around them [m]
  double volume = 0;  ///< of the parts [m³]; 0: not known
  double smallest = 0, largest = 0;  ///< sizes of the elements of the parts [m]; 0: as the file says
  double nodes = 0;                  ///< expected, of all bodies, within a factor of two; 0: not known
  /// "'a' and 'b' have 8.2 cm3 in common": bodies of the file that partly overlap; the common part belongs to
  /// the first. Empty if there are none.
  std::string overlap{};
};

/// A piece of the surface of a body and the size of elements on it.
struct SkinPiece {
  double area = 0, size = 0;
};

/// Number of nodes of tetrahedra in a body, whose sizes grow from its surface inward up to the largest
/// one: 1.5 / h³ per volume, integrated over the depth, and a term for nodes on the surface, which are shared
/// by fewer elements.
/// @param skin     lengths in the same unit as the other arguments
/// @param growth   of the size per distance from the surface, at least 0
double expected_nodes(const std::vector<SkinPiece>& skin, double volume, double largest, double growth);

/// Ratio of the number of nodes of a second-order mesh to that of a first-order mesh with the same
/// tetrahedra.
inline constexpr double k_nodes_of_second_order = 7.5;

/// "1.25 x 0.98 x 0.7 m and 120 dm3 in elements of 5.6 to 8.4 mm, some 12 million nodes".
std::string outlook_text(const MeshingOutlook& outlook);

/// Memory for meshing [byte], 0 if the number of nodes is not known.
double meshing_memory(const MeshingOutlook& outlook);

/// From now on tell_outlook() calls `listener`; with an empty function it calls nothing. A reader process has
/// its own listener, which passes the outlook to the process that requested the mesh and calls tell_outlook()
/// there.
void listen_to_outlook(std::function<void(const MeshingOutlook&)> listener);
void tell_outlook(const MeshingOutlook& outlook);

/// tell_progress() is called repeatedly while a mesh is being made, with a text on the progress. It writes a
/// line of the log or, from listen_to_progress() on, calls `listener` unless that is an empty function.
void listen_to_progress(std::function<void(const std::string&)> listener);
void tell_progress(const std::string& text);

}  // namespace solidus::mesh
