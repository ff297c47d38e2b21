#include "criteria/longest_sides.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

std::vector<double> longest_sides(const mesh::Mesh& mesh) {
  const std::size_t n_bodies = mesh.bodies.size();
  std::vector<mesh::Point> low(n_bodies), high(n_bodies);
  for (std::size_t b = 0; b < n_bodies; ++b) low[b].fill(HUGE_VAL), high[b].fill(-HUGE_VAL);
  // The box of each body by the nodes of its elements on this process.
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (const Index node : block.nodes)
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = mesh.x[as_size(node)][i];
        const auto body = as_size(block.body);
        low[body][i] = std::min(low[body][i], x), high[body][i] = std::max(high[body][i], x);
      }
  std::vector<double> longest(n_bodies, 0.0);
  for (std::size_t b = 0; b < n_bodies; ++b)
    for (std::size_t i = 0; i < 3; ++i)
      longest[b] = std::max(longest[b], parallel::global_max(high[b][i]) + parallel::global_max(-low[b][i]));
  return longest;
}

}  // namespace solidus::criteria
