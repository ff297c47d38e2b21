#include "mesh/surfaces/vertex_sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

namespace solidus::mesh {
namespace {

using testing::ElementsAre;

TEST(VertexSets, EqualWhateverTheirOrder) {
  const auto set = [](const std::vector<Index>& vertices) { return vertex_set(vertices); };
  const std::vector<VertexSet> sets = {set({7, 3, 9}), set({3, 7, 8}), set({9, 7, 3}),
                                       set({3, 7}),    set({4, 7, 9}), set({3, 9, 7})};
  EXPECT_THAT(first_equal_set(sets), ElementsAre(0, 1, 0, 3, 4, 0));
  EXPECT_TRUE(first_equal_set({}).empty());
}

/// Against a map of sorted vertices: edges, triangles, quadrangles and hexahedra of few vertices, most of
/// them there more than once.
TEST(VertexSets, FoundAsByAMapOfSortedVertices) {
  std::mt19937 random(11);
  std::map<std::vector<Index>, Index> first;
  std::vector<VertexSet> sets;
  std::vector<Index> expected;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Index> all(12);
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v] = 1000000 * static_cast<Index>(v % 3) + static_cast<Index>(v);
    std::ranges::shuffle(all, random);
    constexpr std::array<std::size_t, 4> n_vertices{2, 3, 4, 8};
    all.resize(n_vertices[random() % n_vertices.size()]);
    sets.push_back(vertex_set(all));
    std::ranges::sort(all);
    expected.push_back(first.emplace(all, i).first->second);
  }
  EXPECT_EQ(first_equal_set(sets), expected);
}

}  // namespace
}  // namespace solidus::mesh
