/// Points fixed on the faces of a slave surface, whatever the master: Gauss points or nodes.
#pragma once

#include <vector>

#include "contact/surfaces/face.hpp"
#include "contact/surfaces/integration_rule.hpp"

namespace solidus::contact {

struct SlaveRulePoint {
  Point xi{};
  double weight = 0;  ///< area in the configuration of the face, with 2πr [m²]
};

/// 2πr for axisymmetry, one else.
double circumference(AnalysisKind kind, const Point& x);
/// The points of a face. Rule `segments` depends on a master and is none of these.
std::vector<SlaveRulePoint> slave_rule(const Face& face, AnalysisKind kind, IntegrationRule rule,
                                       int gauss_degree);
/// The reference coordinates of node `a`: vertices, then the middles of the edges.
Point node_xi(mesh::Shape shape, std::size_t a);

}  // namespace solidus::contact
