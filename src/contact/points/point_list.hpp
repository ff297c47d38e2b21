/// The contact points of one slave face while they are being found; an internal header of the integration
/// rules.
#pragma once

#include <vector>

#include "contact/points/integration.hpp"
#include "contact/surfaces/search.hpp"

namespace solidus::contact {

struct PairedPoint {
  Index master_face = 0;
  Point slave_xi{}, master_xi{};
  double measure = 0;  ///< length or area that the point stands for; rule `segments`: without 2πr
};

struct CutOptions {
  double search_distance = 0;  ///< [m]
  bool cells = false;          ///< the slave is cut into its cells too (face_cells.hpp)
  int degree = 0;              ///< of the Gauss points of a piece; zero: that of products of shape functions
};

/// Faces of the master that a normal line of the slave's face may meet within this distance [m].
std::vector<Index> faces_within(const Face& slave, const FaceSearch& master, double distance);

/// Pieces of a slave face in 2-D, cut at the projections of the master's vertices; Gauss points in each.
void cut_line(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              const CutOptions& options, std::vector<PairedPoint>& points);

/// Pieces of a slave face in 3-D: intersections with the master's faces in the plane of the slave face (Puso
/// and Laursen 2004), cut into triangles with Gauss points.
void cut_face(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              const CutOptions& options, std::vector<PairedPoint>& points);

/// Degree that integrates products of shape functions of both sides exactly where that is possible, and
/// closely on distorted quads, whose shape functions are rational in the plane.
int product_degree(const Face& slave, const Face& master);

}  // namespace solidus::contact
