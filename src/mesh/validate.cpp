/// Jacobians at the points of integration: elements that are mirrored are turned, those that are crossed
/// are refused with their place.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "mesh/quadrature.hpp"
#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

// det ∂x/∂ξ of an element at a reference point.
double jacobian(const RawMesh& mesh, Shape shape, const Index* element, const Point& xi) {
  std::array<double, 60> g{};
  basis_gradients(shape, xi, g);
  const auto dim = as_size(dimension(shape));
  std::array<std::array<double, 3>, 3> j{};
  for (std::size_t a = 0; a < as_size(node_count(shape)); ++a)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < dim; ++k) j[i][k] += mesh.x[as_size(element[a])][i] * g[a * dim + k];
  if (dim == 2) return j[0][0] * j[1][1] - j[0][1] * j[1][0];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

// The length that makes a Jacobian small or not: the longest distance between vertices.
double extent(const RawMesh& mesh, Shape shape, const Index* element) {
  double longest = 0;
  for (int a = 0; a < vertex_count(shape); ++a)
    for (int b = 0; b < a; ++b) {
      const Point &p = mesh.x[as_size(element[a])], &q = mesh.x[as_size(element[b])];
      longest = std::max(longest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
  return longest;
}

// Returns the order of the nodes in an element of the opposite orientation: a mirror image of the reference
// shape.
std::vector<int> mirrored(Shape shape) {
  switch (shape) {
    case Shape::tri3:
      return {0, 2, 1};
    case Shape::tri6:
      return {0, 2, 1, 5, 4, 3};
    case Shape::quad4:
      return {0, 3, 2, 1};
    case Shape::quad8:
      return {0, 3, 2, 1, 7, 6, 5, 4};
    case Shape::tet4:
      return {0, 2, 1, 3};
    case Shape::tet10:
      return {0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
    case Shape::hex8:
      return {4, 5, 6, 7, 0, 1, 2, 3};
    case Shape::hex20:
      return {4, 5, 6, 7, 0, 1, 2, 3, 16, 17, 10, 18, 12, 19, 14, 15, 8, 9, 11, 13};
    default:
      return {};
  }
}

std::string place(const RawMesh& mesh, Shape shape, const Index* element) {
  Point c{};
  for (int a = 0; a < vertex_count(shape); ++a)
    for (std::size_t i = 0; i < 3; ++i) c[i] += mesh.x[as_size(element[a])][i] / vertex_count(shape);
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", c[0], c[1], c[2]);
  return text;
}

void check_block(RawMesh& mesh, const std::string& group, RawBlock& block, const std::string& path) {
  const int nn = node_count(block.shape);
  // The Jacobian of a linear simplex is the same everywhere.
  const bool affine = order(block.shape) == 1 && vertex_count(block.shape) == dimension(block.shape) + 1;
  const Rule interior = stiffness_rule(block.shape), nodes = affine ? Rule{} : nodal_rule(block.shape);
  const std::vector<int> mirror = mirrored(block.shape);
  for (std::size_t e = 0; e * as_size(nn) < block.nodes.size(); ++e) {
    // The sign of the volume tells the orientation; a mirrored element is turned.
    Index* element = block.nodes.data() + e * as_size(nn);
    double sum = 0;
    for (const QuadraturePoint& p : interior) sum += p.weight * jacobian(mesh, block.shape, element, p.xi);
    if (sum < 0) {
      const std::vector<Index> old(element, element + nn);
      for (int a = 0; a < nn; ++a) element[a] = old[as_size(mirror[as_size(a)])];
    }
    // Everywhere inside the Jacobian must be positive, relative to the size of the element.
    double least = std::abs(sum);
    if (!affine)
      for (const QuadraturePoint& p : interior)
        least = std::min(least, jacobian(mesh, block.shape, element, p.xi));
    const double size = std::pow(extent(mesh, block.shape, element), dimension(block.shape));
    // A vertex may be flat (a quad collapsed to a triangle works), but not folded.
    for (std::size_t a = 0; a < nodes.size() && a < as_size(vertex_count(block.shape)); ++a)
      if (const double j = jacobian(mesh, block.shape, element, nodes[a].xi); j < -1e-10 * size)
        least = std::min(least, j);
    if (!(least > 1e-10 * size)) {
      const auto number =
          block.input_element.empty() ? static_cast<GlobalIndex>(e + 1) : block.input_element[e];
      throw InputError({path},
                       std::string(least > -1e-10 * size ? "degenerate" : "inverted") + " element " +
                           std::to_string(number) + " (" + std::string(name(block.shape)) + ") of '" + group +
                           "' at " + place(mesh, block.shape, element),
                       "elements with a positive volume and no edge folded inside");
    }
  }
}

}  // namespace

void validate_and_orient(RawMesh& mesh, const std::string& path) {
  // Places are finite, in the plane for two dimensions; there is a body, and each block is sound.
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    for (const double c : mesh.x[i])
      if (!std::isfinite(c) || std::abs(c) > 1e9)
        throw InputError({path}, "node " + std::to_string(mesh.input_node[i]) + " lies at no usable place",
                         "finite coordinates below 1e9 m");
  if (mesh.dimension == 2)
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      if (std::abs(mesh.x[i][2]) > 1e-9 * (std::abs(mesh.x[i][0]) + std::abs(mesh.x[i][1]) + 1e-6))
        throw InputError({path}, "a two-dimensional mesh must lie in the plane z = 0, but node " +
                                     std::to_string(mesh.input_node[i]) + " does not");
  bool any_body = false;
  for (auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    any_body = true;
    for (RawBlock& block : group.blocks) check_block(mesh, name, block, path);
  }
  if (!any_body)
    throw InputError(
        {path},
        "the mesh has no body: no group of " + std::to_string(mesh.dimension) + "-dimensional elements",
        "physical groups for bodies and surfaces (in Gmsh: Physical Volume(\"part\") = {…};)");
}

}  // namespace solidus::mesh
