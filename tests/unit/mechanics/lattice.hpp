/// Structured meshes of every shape, mapped and distorted at will, with named sides: small bodies for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::test {

/// Cells nx × ny (× nz) of the unit square or cube, split into the shape, mapped to the body.
struct Lattice {
  mesh::Shape shape = mesh::Shape::quad4;
  std::array<int, 3> cells{2, 2, 2};
  std::array<double, 3> size{1, 1, 1};  ///< of the box before mapping [m]
  double distortion = 0;                ///< of interior vertices, in parts of a cell
  std::function<mesh::Point(const mesh::Point&)> map = [](const mesh::Point& x) { return x; };
};

namespace detail {

using Site = std::array<int, 3>;  // even numbers are vertices, odd ones midpoints

inline std::vector<std::vector<Site>> corner_sites(const Lattice& lattice) {
  using mesh::Shape;
  const bool solid = mesh::dimension(lattice.shape) == 3;
  std::vector<std::vector<Site>> elements;
  for (int k = 0; k < (solid ? lattice.cells[2] : 1); ++k)
    for (int j = 0; j < lattice.cells[1]; ++j)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const auto v = [&](int a, int b, int c) { return Site{2 * (i + a), 2 * (j + b), 2 * (k + c)}; };
        const Site p[8] = {v(0, 0, 0), v(1, 0, 0), v(1, 1, 0), v(0, 1, 0),
                           v(0, 0, 1), v(1, 0, 1), v(1, 1, 1), v(0, 1, 1)};
        switch (lattice.shape) {
          case Shape::tri3:
          case Shape::tri6:
            elements.push_back({p[0], p[1], p[2]});
            elements.push_back({p[0], p[2], p[3]});
            break;
          case Shape::quad4:
          case Shape::quad8:
            elements.push_back({p[0], p[1], p[2], p[3]});
            break;
          case Shape::tet4:
          case Shape::tet10: {
            // six tetrahedra around the diagonal 0–6 (Kuhn), conforming between cells
            const int paths[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
            for (const auto& path : paths) elements.push_back({p[0], p[path[0]], p[path[1]], p[6]});
            break;
          }
          default:
            elements.push_back({p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
        }
      }
  return elements;
}

/// Gmsh's order of the edges that carry midpoints.
inline std::vector<std::array<std::size_t, 2>> mid_edges(mesh::Shape shape) {
  using mesh::Shape;
  switch (shape) {
    case Shape::tri6:
      return {{0, 1}, {1, 2}, {2, 0}};
    case Shape::quad8:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    case Shape::tet10:
      return {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}};
    case Shape::hex20:
      return {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
    default:
      return {};
  }
}

}  // namespace detail

/// Groups: "body" and the sides "left", "right" (x), "bottom", "top" (y), "back", "front" (z), of the box
/// before mapping.
inline mesh::RawMesh make_raw(const Lattice& lattice) {
  const int dim = mesh::dimension(lattice.shape);
  mesh::RawMesh raw;
  raw.dimension = dim;
  std::map<detail::Site, Index> numbers;
  std::vector<detail::Site> sites;
  const auto vertex = [&](const detail::Site& s) {  // of the distorted box
    mesh::Point x{};
    bool inside = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i) {
      x[i] = 0.5 * s[i] / lattice.cells[i] * lattice.size[i];
      inside = inside && s[i] > 0 && s[i] < 2 * lattice.cells[i];
    }
    for (std::size_t i = 0; inside && i < static_cast<std::size_t>(dim); ++i)
      x[i] += lattice.distortion * lattice.size[i] / lattice.cells[i] *
              std::sin(1.7 * s[0] + 2.3 * s[1] + 0.9 * s[2] + static_cast<double>(i));
    return x;
  };
  const auto node = [&](const detail::Site& s, const mesh::Point& x) {
    const auto [found, fresh] = numbers.try_emplace(s, static_cast<Index>(sites.size()));
    if (fresh) {
      sites.push_back(s);
      raw.x.push_back(lattice.map(x));
      raw.input_node.push_back(static_cast<GlobalIndex>(sites.size()));
    }
    return found->second;
  };

  mesh::RawBlock body{lattice.shape, {}, {}};
  for (const auto& corners : detail::corner_sites(lattice)) {
    for (const auto& s : corners) body.nodes.push_back(node(s, vertex(s)));
    for (const auto& [a, b] : detail::mid_edges(lattice.shape)) {
      detail::Site s;
      mesh::Point x{};
      const mesh::Point xa = vertex(corners[a]), xb = vertex(corners[b]);
      for (std::size_t i = 0; i < 3; ++i) {
        s[i] = (corners[a][i] + corners[b][i]) / 2;
        x[i] = 0.5 * (xa[i] + xb[i]);
      }
      body.nodes.push_back(node(s, x));
    }
    body.input_element.push_back(static_cast<GlobalIndex>(body.input_element.size() + 1));
  }

  const char* names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
  const mesh::Shape face_shape = mesh::face_shape(lattice.shape);
  const auto n = static_cast<std::size_t>(mesh::node_count(lattice.shape));
  GlobalIndex number = static_cast<GlobalIndex>(body.input_element.size());
  for (int axis = 0; axis < dim; ++axis)
    for (int end = 0; end < 2; ++end) {
      mesh::RawBlock faces{face_shape, {}, {}};
      const int where = end * 2 * lattice.cells[static_cast<std::size_t>(axis)];
      for (std::size_t e = 0; e < body.input_element.size(); ++e)
        for (int f = 0; f < mesh::face_count(lattice.shape); ++f) {
          const auto local = mesh::face_nodes(lattice.shape, f);
          const auto of_element = [&](int a) { return body.nodes[e * n + static_cast<std::size_t>(a)]; };
          if (!std::all_of(local.begin(), local.end(), [&](int a) {
                return sites[static_cast<std::size_t>(of_element(a))][static_cast<std::size_t>(axis)] ==
                       where;
              }))
            continue;
          for (int a : local) faces.nodes.push_back(of_element(a));
          faces.input_element.push_back(++number);
        }
      raw.groups[names[axis][end]] = {dim - 1, {faces}};
    }
  raw.groups["body"] = {dim, {body}};
  return raw;
}

/// Distributed over the processes, and a node set "node N" for every node N of the input.
inline mesh::Mesh distributed(mesh::RawMesh raw) {
  const auto n = static_cast<GlobalIndex>(raw.x.size());
  mesh::validate_and_orient(raw, "lattice");
  mesh::Mesh mesh = mesh::distribute(raw, {"body"}, {});
  for (GlobalIndex node = 1; node <= n; ++node) mesh.node_sets["node " + std::to_string(node)];
  for (Index i = 0; i < mesh.n_nodes(); ++i)
    mesh.node_sets["node " + std::to_string(mesh.input_node[static_cast<std::size_t>(i)])].push_back(i);
  return mesh;
}

inline mesh::Mesh make_mesh(const Lattice& lattice) {
  return distributed(make_raw(lattice));
}

}  // namespace solidus::test
