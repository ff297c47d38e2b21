#include "coupling/longest_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

namespace {

/// Share of the mesh's diagonal that a node goes at most in an iteration.
constexpr double k_longest_way = 0.05;

/// The diagonal of the mesh's bounding box [m]. Collective.
double diagonal(const mesh::Mesh& mesh) {
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : mesh.x) low = std::min(low, x[i]), high = std::max(high, x[i]);
    const double size = parallel::global_max(high) - parallel::global_min(low);
    squares += size * size;
  }
  return std::sqrt(squares);
}

/// The longest way of a node [m]. Collective.
/// @param step  [local node][component]
double longest(std::span<const double> step, int components) {
  const auto n = as_size(components);
  double squares = 0;
  for (std::size_t i = 0; i + n <= step.size(); i += n) {
    double of_node = 0;
    for (std::size_t c = 0; c < n; ++c) of_node += step[i + c] * step[i + c];
    squares = std::max(squares, of_node);
  }
  return std::sqrt(parallel::global_max(squares));
}

}  // namespace

double factor_of_longest_way(const mesh::Mesh& mesh, std::span<const double> step, int components) {
  const double way = longest(step, components);
  const double most = k_longest_way * diagonal(mesh);
  return way > most ? most / way : 1;
}

}  // namespace solidus::coupling
