/// Volumes, skins and sizes of elements of the bodies of a case, over all processes.
#pragma once

#include <span>
#include <vector>

#include "mesh/block_geometry.hpp"
#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::check {

/// Measures of one body. In plane strain they are of one metre of thickness, in axisymmetry of the whole
/// revolution.
struct BodyMeasures {
  mesh::Point low{}, high{};   ///< corners of the bounding box [m]
  double volume = 0;           ///< [m³]
  double skin = 0;             ///< area of the boundary [m²]
  std::vector<double> shared;  ///< [other body] part of it that is a face of both bodies [m²]
  double shortest_edge = 0, longest_edge = 0;  ///< between vertices of elements [m]
  double mean_edge = 0;                        ///< [m]
  double flattest = 1;  ///< longest edge of an element over its shortest one, the largest of all elements
  GlobalIndex nodes = 0, elements = 0;
  std::vector<GlobalIndex> shared_nodes;  ///< [other body]
};

/// [body]. Collective. In bounded memory: faces are looked at a part at a time.
std::vector<BodyMeasures> measure_bodies(const mesh::Mesh& mesh, AnalysisKind kind);

/// Length or area of a face by its vertices, per metre of thickness or over the revolution [m²].
double skin_area(const mesh::Mesh& mesh, std::span<const Index> vertices, AnalysisKind kind);

/// Volume of an element of a geometry [m³].
double element_volume(const mesh::BlockGeometry& geometry, Index element);

/// The share of a body's volume in elements all of whose nodes are marked: they reach from skin to skin where
/// the nodes of the skin are. Collective.
/// @param marked  [local node], ghosts included
double share_between(const mesh::Mesh& mesh, AnalysisKind kind, int body, const std::vector<char>& marked);

}  // namespace solidus::check
