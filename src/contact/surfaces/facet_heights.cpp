/// Heights are quadratic forms in the shape functions: one number for each pair of nodes of a face, from
/// the shape operator of the smooth surface.
#include "contact/surfaces/facet_heights.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "contact/surfaces/master_mesh.hpp"
#include "contact/surfaces/surface_curvature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

FacetHeights::FacetHeights(const ContactSurface& surface) {
  const std::vector<ShapeOperator> shapes = shape_operators(surface, MeshMasterOptions{}.feature_angle);
  for (Index f = 0; f < surface.n_faces(); ++f) {
    first_.push_back(pair_.size());
    largest_.push_back(0);
    outward_.push_back(0);
    const Face face = surface.reference_face(f);
    // Quadratic faces follow the curved surface themselves: facets are those of linear faces.
    if (mesh::order(face.shape) > 1) continue;
    const ShapeOperator& shape = shapes[as_size(f)];
    const auto n = as_size(face.n_nodes);
    // The true surface over the edge of two nodes bulges by an eighth of its length squared times
    // the curvature; pairs of nodes carry it, so that any place on the face is interpolated by
    // products of shape functions.
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b) {
        pair_.push_back(0.5 * shape.agreement * shape.turn_along(subtract(face.x[b], face.x[a])));
        largest_.back() += std::abs(pair_.back());
        outward_.back() += pair_.back();
      }
    // At the centre, where all shape functions are 1/n.
    largest_.back() /= static_cast<double>(n * n);
  }
  measure_turns(surface, MeshMasterOptions{}.feature_angle);
}

void FacetHeights::measure_turns(const ContactSurface& surface, double feature_angle) {
  // Normals at the centres of the faces, and the faces that share a node.
  std::unordered_map<Index, std::vector<Index>> at_node;
  std::vector<Point> normal;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Face face = surface.reference_face(f);
    normal.push_back(face.normal(reference_centre(face.shape)));
    for (const Index node : surface.nodes(f)) at_node[node].push_back(f);
  }
  turn_.assign(normal.size(), 0.0);
  // The largest angle to a neighbour; above the feature angle it is an edge of the drawing, not a
  // facet of a round.
  for (const auto& [node, faces] : at_node)
    for (const Index f : faces)
      for (const Index g : faces) {
        const Point &a = normal[as_size(f)], &b = normal[as_size(g)];
        const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
        double& turn = turn_[as_size(f)];
        if (angle < feature_angle) turn = std::max(turn, angle);
      }
}

double FacetHeights::at(Index face, std::span<const double> shape) const {
  const auto f = as_size(face);
  if (!(largest_[f] > 0)) return 0;
  double height = 0;
  const double* pair = pair_.data() + first_[f];
  for (std::size_t a = 0; a < shape.size(); ++a)
    for (std::size_t b = a + 1; b < shape.size(); ++b) height += shape[a] * shape[b] * *pair++;
  return height;
}

FacetGap facet_gap(const FacetHeights& slave, Index slave_face, std::span<const double> slave_shape,
                   const FacetHeights* master, Index master_face, std::span<const double> master_shape) {
  FacetGap gap{slave.at(slave_face, slave_shape), slave.largest(slave_face)};
  if (master == nullptr || master_face < 0) return gap;
  gap.height += master->at(master_face, master_shape);
  gap.bound += master->largest(master_face);
  gap.fits = slave.outward(slave_face) * master->outward(master_face) < 0 ? 1 : 0;
  return gap;
}

}  // namespace solidus::contact
