/// Each group is assessed by itself: how many elements, how large, how far from regular, and where the
/// worst one is.
#include "mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

bool is_simplex(Shape shape) {
  return vertex_count(shape) == dimension(shape) + 1;
}

/// The inverse of the regular element's Jacobian: the identity for quads and hexes.
Matrix inverse_of_regular(Shape shape) {
  const double s3 = std::numbers::sqrt3, s6 = std::sqrt(6.0);
  if (!is_simplex(shape)) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  // columns of the Jacobian: the edges (1, 0, 0), (1/2, √3/2, 0), (1/2, √3/6, √6/3)
  return {{{1, -1 / s3, -1 / s6}, {0, 2 / s3, -1 / s6}, {0, 0, 3 / s6}}};
}

/// ∂x_i/∂ξ_k at a reference point.
Matrix jacobian(const RawMesh& mesh, Shape shape, const Index* nodes, const Point& xi) {
  std::array<double, 60> slope{};
  basis_gradients(shape, xi, slope);
  const auto dim = as_size(dimension(shape));
  Matrix j{};
  for (std::size_t a = 0; a < as_size(node_count(shape)); ++a)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < dim; ++k) j[i][k] += mesh.x[as_size(nodes[a])][i] * slope[a * dim + k];
  return j;
}

double determinant(const Matrix& j, std::size_t dim) {
  if (dim == 2) return j[0][0] * j[1][1] - j[0][1] * j[1][0];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

double mean_ratio(const Matrix& j, const Matrix& inverse_regular, std::size_t dim) {
  Matrix t{};
  double squared = 0;
  for (std::size_t i = 0; i < dim; ++i)
    for (std::size_t k = 0; k < dim; ++k) {
      for (std::size_t l = 0; l < dim; ++l) t[i][k] += j[i][l] * inverse_regular[l][k];
      squared += t[i][k] * t[i][k];
    }
  if (!(squared > 0)) return 0;
  const double det = determinant(t, dim), d = static_cast<double>(dim);
  return std::copysign(d * std::pow(std::abs(det), 2 / d) / squared, det);
}

/// √det(JᵀJ): the length, area or volume per reference unit.
double stretch(const Matrix& j, std::size_t dim) {
  const auto dot = [&j](std::size_t k, std::size_t l) {
    return j[0][k] * j[0][l] + j[1][k] * j[1][l] + j[2][k] * j[2][l];
  };
  if (dim == 1) return std::sqrt(dot(0, 0));
  if (dim == 2) return std::sqrt(std::max(0.0, dot(0, 0) * dot(1, 1) - dot(0, 1) * dot(0, 1)));
  return std::abs(determinant(j, 3));
}

double distance(const RawMesh& mesh, Index a, Index b) {
  const Point &p = mesh.x[as_size(a)], &q = mesh.x[as_size(b)];
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Calls f with the length of every edge; in solids each edge comes twice, once for each face it bounds.
template <class Function>
void for_each_edge(const RawMesh& mesh, Shape shape, const Index* nodes, Function f) {
  if (dimension(shape) == 1) {
    f(distance(mesh, nodes[0], nodes[1]));
    return;
  }
  for (int face = 0; face < face_count(shape); ++face) {
    const auto local = face_nodes(shape, face);
    const int n = vertex_count(face_shape(shape));
    for (int a = 0; a < (n == 2 ? 1 : n); ++a)
      f(distance(mesh, nodes[local[as_size(a)]], nodes[local[as_size((a + 1) % n)]]));
  }
}

Point centre(const RawMesh& mesh, Shape shape, const Index* nodes) {
  Point c{};
  for (int a = 0; a < vertex_count(shape); ++a)
    for (std::size_t i = 0; i < 3; ++i) c[i] += mesh.x[as_size(nodes[a])][i] / vertex_count(shape);
  return c;
}

/// Keeps the `n` elements of least quality, worst first.
void keep_worst(std::vector<ElementReport>& worst, ElementReport element, std::size_t n) {
  if (n == 0 || (worst.size() == n && worst.back().quality <= element.quality)) return;
  const auto place =
      std::upper_bound(worst.begin(), worst.end(), element.quality,
                       [](double quality, const ElementReport& other) { return quality < other.quality; });
  worst.insert(place, std::move(element));
  if (worst.size() > n) worst.pop_back();
}

GroupReport assess_group(const RawMesh& mesh, const std::string& name, const RawGroup& group,
                         std::size_t n_worst, std::vector<ElementReport>& worst) {
  // One way over the elements of a group gives sizes, edges and quality. Quality is that of bodies alone.
  GroupReport report;
  report.name = name;
  report.dimension = group.dimension;
  const bool body = group.dimension == mesh.dimension;
  std::vector<char> used(mesh.x.size(), 0);
  double quality_sum = 0, edge_sum = 0;
  std::size_t n_edges = 0, n_elements = 0;
  double shortest = std::numeric_limits<double>::infinity();
  for (const RawBlock& block : group.blocks) {
    const auto nn = as_size(node_count(block.shape));
    const std::size_t n = block.nodes.size() / nn;
    report.shapes.push_back({block.shape, n});
    n_elements += n;
    for (const Index i : block.nodes) used[as_size(i)] = 1;
    if (group.dimension == 0) continue;
    const Rule rule = stiffness_rule(block.shape);
    for (std::size_t e = 0; e < n; ++e) {
      const Index* nodes = block.nodes.data() + e * nn;
      // The measure is the integral of the stretch of the map: length, area or volume.
      for (const QuadraturePoint& p : rule)
        report.measure +=
            p.weight * stretch(jacobian(mesh, block.shape, nodes, p.xi), as_size(group.dimension));
      for_each_edge(mesh, block.shape, nodes, [&](double length) {
        shortest = std::min(shortest, length);
        report.longest_edge = std::max(report.longest_edge, length);
        edge_sum += length;
        ++n_edges;
      });
      if (!body) continue;
      const double quality = element_quality(mesh, block.shape, nodes);
      quality_sum += quality;
      report.worst_quality = std::min(report.worst_quality, quality);
      if (quality < k_poor_quality) ++report.n_poor;
      // The worst elements of all groups are kept in one list of bounded length.
      keep_worst(worst,
                 {name, block.shape, block.input_element.empty() ? 0 : block.input_element[e], quality,
                  centre(mesh, block.shape, nodes)},
                 n_worst);
    }
  }
  // Sums become means.
  report.n_nodes = as_size(std::count(used.begin(), used.end(), 1));
  if (n_edges > 0) {
    report.shortest_edge = shortest;
    report.mean_edge = edge_sum / static_cast<double>(n_edges);
  }
  if (body && n_elements > 0) report.mean_quality = quality_sum / static_cast<double>(n_elements);
  return report;
}

std::string shapes_text(const GroupReport& group) {
  std::string text;
  for (const ShapeReport& s : group.shapes)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", s.n_elements, name(s.shape));
  return text;
}

std::string kind_text(int dimension, int of_mesh) {
  if (dimension == of_mesh) return "body";
  if (dimension == of_mesh - 1) return "surface";
  return dimension == 0 ? "points" : "line";
}

std::string measure_text(const GroupReport& group) {
  if (group.dimension == 0) return {};
  constexpr const char* units[] = {"", "mm", "mm2", "mm3"};
  return fmt::format("{:.6g} {}", group.measure * std::pow(1000.0, group.dimension), units[group.dimension]);
}

}  // namespace

double element_quality(const RawMesh& mesh, Shape shape, const Index* nodes) {
  const auto dim = as_size(dimension(shape));
  const Matrix inverse_regular = inverse_of_regular(shape);
  const Rule at = nodal_rule(shape);
  // The Jacobian of a linear simplex is the same everywhere.
  const int n = is_simplex(shape) && order(shape) == 1 ? 1 : vertex_count(shape);
  double least = 1;
  for (int a = 0; a < n; ++a) {
    const Matrix j = jacobian(mesh, shape, nodes, at[as_size(a)].xi);
    least = std::min(least, mean_ratio(j, inverse_regular, dim));
  }
  return least;
}

QualityReport assess(const RawMesh& mesh, std::size_t n_worst) {
  // Groups are reported from the highest dimension down. Nodes and bytes are counted over all of them.
  QualityReport report;
  report.dimension = mesh.dimension;
  report.n_nodes = mesh.x.size();
  report.bytes = mesh.x.size() * (sizeof(Point) + sizeof(GlobalIndex));
  for (int d = mesh.dimension; d >= 0; --d)
    for (const auto& [name, group] : mesh.groups)
      if (group.dimension == d)
        report.groups.push_back(assess_group(mesh, name, group, n_worst, report.worst));

  // The extent is that of nodes which a body uses; others are counted.
  std::vector<char> used(mesh.x.size(), 0);
  for (const auto& [name, group] : mesh.groups)
    for (const RawBlock& block : group.blocks) {
      report.bytes += block.nodes.size() * sizeof(Index) + block.input_element.bytes();
      if (group.dimension == mesh.dimension)
        for (const Index i : block.nodes) used[as_size(i)] = 1;
    }
  constexpr double far = std::numeric_limits<double>::infinity();
  Point low{far, far, far}, high{-far, -far, -far};
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) {
      ++report.n_unused_nodes;
      continue;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], mesh.x[i][d]);
      high[d] = std::max(high[d], mesh.x[i][d]);
    }
  }
  if (report.n_unused_nodes < used.size()) {
    report.lowest = low;
    report.highest = high;
  }
  return report;
}

std::string to_text(const QualityReport& report) {
  // The report as text: extent, a table of the groups, and the worst elements. Lengths are in mm.
  std::string text =
      fmt::format("{} dimensions, {} nodes{}, {:.1f} MB\n", report.dimension, report.n_nodes,
                  report.n_unused_nodes > 0 ? fmt::format(" ({} in no body)", report.n_unused_nodes) : "",
                  static_cast<double>(report.bytes) / 1e6);
  text += "extent [mm]:";
  for (std::size_t d = 0; d < as_size(report.dimension); ++d)
    text += fmt::format("{} {} {:.6g} to {:.6g}", d == 0 ? "" : ",", "xyz"[d], 1000 * report.lowest[d],
                        1000 * report.highest[d]);
  text += fmt::format("\n\n{:<20} {:<8} {:>8}  {:<24} {:>16}  {:>26}  {:>16}\n", "group", "kind", "nodes",
                      "elements", "size", "edges least/mean/most [mm]", "quality least/mean");
  for (const GroupReport& g : report.groups) {
    const std::string edges = g.dimension == 0
                                  ? ""
                                  : fmt::format("{:.4g} / {:.4g} / {:.4g}", 1000 * g.shortest_edge,
                                                1000 * g.mean_edge, 1000 * g.longest_edge);
    const std::string quality = g.dimension == report.dimension
                                    ? fmt::format("{:.3f} / {:.3f}", g.worst_quality, g.mean_quality)
                                    : "";
    std::string line = fmt::format("{:<20} {:<8} {:>8}  {:<24} {:>16}  {:>26}  {:>16}", g.name,
                                   kind_text(g.dimension, report.dimension), g.n_nodes, shapes_text(g),
                                   measure_text(g), edges, quality);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  if (!report.worst.empty()) text += "\nworst elements (1 is regular, 0 is flat):\n";
  for (const ElementReport& e : report.worst) {
    text += fmt::format("  {:.3f}  element {} ({}) of '{}' at (", e.quality, e.input_element, name(e.shape),
                        e.group);
    for (std::size_t d = 0; d < as_size(report.dimension); ++d)
      text += fmt::format("{}{:.5g}", d == 0 ? "" : ", ", 1000 * e.centre[d]);
    text += ") mm\n";
  }
  std::size_t poor = 0;
  for (const GroupReport& g : report.groups) poor += g.n_poor;
  if (poor > 0) text += fmt::format("{} elements are poor (quality below {})\n", poor, k_poor_quality);
  return text;
}

}  // namespace solidus::mesh
