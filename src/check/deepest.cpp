/// Places inside a casting by their distance from the cooled skin, thinned out to a few.
#include "check/deepest.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "check/cooled_skin.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/skin_measures.hpp"
#include "system/processes.hpp"

namespace solidus::check {

namespace {

double squared(const mesh::Point& a, const mesh::Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// Returns at most three of the places: the first, the one nearest to the middle of all, and the one furthest
/// from the first.
std::vector<mesh::Point> few_of(const std::vector<mesh::Point>& places) {
  if (places.size() < 2) return places;
  mesh::Point middle{};
  for (const mesh::Point& place : places)
    for (std::size_t d = 0; d < 3; ++d) middle[d] += place[d] / static_cast<double>(places.size());
  const auto by_distance = [](const mesh::Point& from) {
    return [from](const mesh::Point& place) { return squared(place, from); };
  };
  std::vector<mesh::Point> few{places.front(), *std::ranges::min_element(places, {}, by_distance(middle)),
                               *std::ranges::max_element(places, {}, by_distance(places.front()))};
  if (few[1] == few[0]) few.erase(few.begin() + 1);
  return few;
}

}  // namespace

Deepest deepest_below(const mesh::Mesh& mesh, std::size_t body, const std::vector<mesh::Point>& cloud) {
  constexpr std::size_t k_most_nodes = 20000, k_most_points = 50000;
  constexpr double k_as_deep = 0.9;
  // Candidates are the owned nodes of the body, and the cloud is that of all processes, so that no
  // distance needs a message.
  const std::vector<char> of_body = nodes_of(mesh, body);
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < as_size(mesh.n_owned_nodes); ++i)
    if (of_body[i] != 0) nodes.push_back(i);
  // Both are thinned to a fixed number, which bounds the time of a check by the product of the two.
  const std::size_t every = 1 + nodes.size() / k_most_nodes, stride = 1 + cloud.size() / k_most_points;
  double deepest = 0;    // squared, as all of these
  std::size_t hint = 0;  // the point that was near the node before
  std::vector<std::pair<double, std::size_t>> deep;
  // The hint makes the first distance small already, since consecutive nodes are neighbours, and
  // the search ends early for most.
  for (std::size_t n = 0; n < nodes.size() && !cloud.empty(); n += every) {
    const mesh::Point& x = mesh.x[nodes[n]];
    const double least = k_as_deep * k_as_deep * deepest;
    double nearest = squared(x, cloud[hint]);
    // A node that is much nearer than the deepest so far is not deep.
    for (std::size_t i = 0; i < cloud.size() && nearest > least; i += stride)
      if (const double here = squared(x, cloud[i]); here < nearest) nearest = here, hint = i;
    deepest = std::max(deepest, nearest);
    if (nearest > least) deep.emplace_back(nearest, nodes[n]);
  }
  // Then the depth of all processes decides which of the deep ones remain.
  deepest = parallel::global_max(deepest);
  std::erase_if(deep, [&](const auto& one) { return one.first < k_as_deep * k_as_deep * deepest; });
  // Places and depths are gathered in the same order, so that they belong together by their index.
  std::vector<mesh::Point> mine;
  std::vector<double> depths;
  for (const auto& [depth, node] : deep) mine.push_back(mesh.x[node]), depths.push_back(depth);
  const std::vector<mesh::Point> all = setup::gather(mine);
  depths = processes::gather(depths);
  // The deepest first, in an order that does not depend on the processes.
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::tie(depths[b], all[a]) < std::tie(depths[a], all[b]);
  });
  std::vector<mesh::Point> places;
  for (const std::size_t i : order) places.push_back(all[i]);
  return {std::sqrt(deepest), few_of(places)};
}

}  // namespace solidus::check
