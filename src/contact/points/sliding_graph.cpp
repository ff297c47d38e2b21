/// Which nodes a point of sliding contact couples, and when that has changed.
#include <algorithm>

#include "contact/points/sliding_points.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

std::span<const Index> SlidingPoints::allowed(Index slave_face) const {
  const auto f = as_size(slave_face);
  return std::span(allowed_.faces).subspan(allowed_.first[f], allowed_.first[f + 1] - allowed_.first[f]);
}

bool SlidingPoints::graph_outdated() const {
  if (master_->max_nodes() == 0) return allowed_.first.empty();
  for (std::size_t p = 0; p < table_.face.size(); ++p) {
    if (table_.concern[p] != reached || table_.partner[p].face < 0 ||
        table_.partner[p].penetration < -options_.graph_distance)
      continue;
    if (allowed_.first.empty()) return true;
    const auto faces = allowed(table_.face[p]);
    if (!std::binary_search(faces.begin(), faces.end(), table_.partner[p].face)) return true;
  }
  return false;
}

void SlidingPoints::add_to_graph(ContactKinematics::CliqueSink& sink) {
  allowed_.faces.clear();
  allowed_.first.assign(1, 0);
  // The graph of the matrix has room for the partners that a point may get while the graph holds: the faces
  // around its present partner, ring by ring.
  std::vector<Index> faces, wider, clique;
  std::size_t p = 0;
  for (Index slave = 0; slave < slave_.n_faces(); ++slave) {
    faces.clear();
    for (; p < table_.face.size() && table_.face[p] == slave; ++p)
      if (table_.concern[p] != none && table_.partner[p].face >= 0 &&
          table_.partner[p].penetration >= -options_.graph_distance)
        faces.push_back(table_.partner[p].face);
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
