/// Boxes of elements in an R-tree: one of the nearest gives a bound, and those within it come by their
/// distance, so that the search ends as soon as no box can hold a nearer element.
#include "mesh/element_search.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "mesh/nearest_place.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;

struct ElementSearch::Tree {
  struct Element {
    std::size_t block;
    Index element;
    auto operator<=>(const Element&) const = default;
  };
  using Entry = std::pair<TreeBox, Element>;
  bg::index::rtree<Entry, bg::index::quadratic<16>> boxes;
};

ElementSearch::ElementSearch(const Mesh& mesh, int body) : mesh_(mesh), tree_(std::make_unique<Tree>()) {
  std::vector<Tree::Entry> entries;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (body >= 0 && mesh.blocks[b].body != body) continue;
    for (Index e = 0; e < mesh.blocks[b].size(); ++e) {
      const Box box = element_box(mesh, mesh.blocks[b], e);
      entries.push_back({TreeBox(TreePoint(box.low[0], box.low[1], box.low[2]),
                                 TreePoint(box.high[0], box.high[1], box.high[2])),
                         {b, e}});
    }
  }
  tree_->boxes = {entries.begin(), entries.end()};
}

ElementSearch::~ElementSearch() = default;

bool ElementSearch::empty() const {
  return tree_->boxes.empty();
}

ElementSearch::Found ElementSearch::find(const Point& point) const {
  NearestPlace best;
  Tree::Element answers{};
  const TreePoint at(point[0], point[1], point[2]);
  // At equal distance the lower element wins, whatever the tree's order.
  const auto look = [&](const Tree::Element& element) {
    const ElementBlock& block = mesh_.blocks[element.block];
    NearestPlace here = nearest_place(mesh_, block.shape, block.element(element.element), point);
    if (here.distance > best.distance || (here.distance == best.distance && answers < element)) return;
    best = std::move(here);
    answers = element;
  };
  // The element of one of the nearest boxes says how far away the answer can be.
  std::vector<Tree::Entry> entries;
  tree_->boxes.query(bg::index::nearest(at, 1U), std::back_inserter(entries));
  if (!entries.empty()) look(entries.front().second);
  // All boxes that reach so near are looked at by rising distance, a lower bound of that to their elements.
  // (One query of the tree that goes on from box to box sorts all that it has met again at each step.)
  const double reach = best.distance;
  entries.clear();
  tree_->boxes.query(
      bg::index::intersects(TreeBox(TreePoint(point[0] - reach, point[1] - reach, point[2] - reach),
                                    TreePoint(point[0] + reach, point[1] + reach, point[2] + reach))),
      std::back_inserter(entries));
  std::vector<std::pair<double, Tree::Element>> near;
  for (const Tree::Entry& entry : entries) near.emplace_back(bg::distance(at, entry.first), entry.second);
  std::sort(near.begin(), near.end());
  for (const auto& [distance, element] : near) {
    if (distance > best.distance) break;
    look(element);
  }
  // Shape functions at that place are the weights of its nodes.
  Found found;
  found.distance = best.distance;
  found.weights.resize(best.local.size());
  basis_values(best.shape, best.xi, found.weights);
  const ElementBlock& block = mesh_.blocks[answers.block];
  for (const int a : best.local) found.nodes.push_back(block.element(answers.element)[a]);
  const Box box = element_box(mesh_, block, answers.element);
  for (std::size_t k = 0; k < as_size(mesh_.dimension); ++k)
    found.size += (box.high[k] - box.low[k]) / mesh_.dimension;
  return found;
}

}  // namespace solidus::mesh
