/// The contact points of one slave face while they are being found; an internal header of the integration
/// rules.
#pragma once

#include <vector>

#include "contact/integration.hpp"
#include "contact/search.hpp"

namespace solidus::contact {

struct PairedPoint {
  Index master_face = 0;
  Point slave_xi{}, master_xi{};
  double measure = 0;  ///< length or area that the point stands for; rule `segments`: without 2πr
};

/// Pieces of a slave face in 2-D, cut at the projections of the master's vertices; Gauss points in each.
void cut_line(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              double search_distance, std::vector<PairedPoint>& points);

/// Pieces of a slave face in 3-D: intersections with the master's faces in the plane of the slave face (Puso
/// and Laursen 2004), cut into triangles with Gauss points.
void cut_face(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              double search_distance, std::vector<PairedPoint>& points);

/// Degree that integrates products of shape functions of both sides exactly where that is possible, and
/// closely on distorted quads, whose shape functions are rational in the plane.
int product_degree(const Face& slave, const Face& master);

}  // namespace solidus::contact
