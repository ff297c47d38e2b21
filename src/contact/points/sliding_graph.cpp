/// Which nodes a point of sliding contact couples, and when that has changed.
#include <algorithm>
#include <cassert>

#include "contact/points/frame_push.hpp"
#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/slave_rule.hpp"

namespace solidus::contact {

void SlidingKinematics::add_share_rates(Index, std::span<Point> rates) const {
  assert(rates.size() == last_.n_nodes * last_.n_nodes);
  for (std::size_t a = 0; a < static_cast<std::size_t>(last_.frame.n_face_nodes); ++a)
    for (std::size_t b = 0; b < last_.n_nodes; ++b) {
      Point& rate = rates[(last_.n_slave + a) * last_.n_nodes + b];
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        rate = contact::add_scaled(rate, -last_.frame.slope[a][alpha], last_.xi_rate[b][alpha]);
    }
}

std::span<const Index> SlidingKinematics::allowed(Index slave_face) const {
  const auto f = static_cast<std::size_t>(slave_face);
  return std::span(allowed_.faces).subspan(allowed_.first[f], allowed_.first[f + 1] - allowed_.first[f]);
}

bool SlidingKinematics::graph_outdated() const {
  if (master_->max_nodes() == 0) return allowed_.first.empty();
  for (std::size_t p = 0; p < points_.face.size(); ++p) {
    if (points_.concern[p] != reached || points_.partner[p].face < 0 ||
        points_.partner[p].penetration < -options_.graph_distance)
      continue;
    if (allowed_.first.empty()) return true;
    const auto faces = allowed(points_.face[p]);
    if (!std::binary_search(faces.begin(), faces.end(), points_.partner[p].face)) return true;
  }
  return false;
}

void SlidingKinematics::add_to_graph(CliqueSink& sink) {
  allowed_.faces.clear();
  allowed_.first.assign(1, 0);
  // The graph of the matrix has room for the partners that a point may get while the graph holds: the faces
  // around its present partner, ring by ring.
  std::vector<Index> faces, wider, clique;
  std::size_t p = 0;
  for (Index slave = 0; slave < slave_.n_faces(); ++slave) {
    faces.clear();
    for (; p < points_.face.size() && points_.face[p] == slave; ++p)
      if (points_.concern[p] != none && points_.partner[p].face >= 0 &&
          points_.partner[p].penetration >= -options_.graph_distance)
        faces.push_back(points_.partner[p].face);
    for (int ring = 0; ring < options_.graph_rings; ++ring) {
      wider.clear();
      for (Index f : faces) wider.insert(wider.end(), master_->around(f).begin(), master_->around(f).end());
      faces.insert(faces.end(), wider.begin(), wider.end());
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
    const auto own = slave_.nodes(slave);
    if (master_->max_nodes() == 0) {
      sink.add(own);
      faces.clear();
    }
    clique.assign(own.begin(), own.end());
    for (Index f : faces) {
      if (!options_.meets_several) clique.resize(own.size());
      clique.insert(clique.end(), master_->nodes(f).begin(), master_->nodes(f).end());
      if (!options_.meets_several) sink.add(clique);
    }
    if (options_.meets_several && !faces.empty()) {
      std::sort(clique.begin(), clique.end());
      clique.erase(std::unique(clique.begin(), clique.end()), clique.end());
      sink.add(clique);
    }
    // The allowed faces are kept for each slave face, so that a point that leaves them is noticed and the
    // graph made again.
    allowed_.faces.insert(allowed_.faces.end(), faces.begin(), faces.end());
    allowed_.first.push_back(allowed_.faces.size());
  }
}

}  // namespace solidus::contact
