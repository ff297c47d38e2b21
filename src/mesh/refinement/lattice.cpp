/// Children are images of the reference element; where their nodes fall together is one point.
#include "mesh/refinement/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/quadrature.hpp"
#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

using Quarters = std::array<int, 3>;

constexpr std::array<int, 8> k_bits{0, 1, 3, 2, 4, 5, 7, 6};

/// Reference coordinates from 0 to 1, in quarters.
Quarters quarters_of(bool simplex, int dim, const Point& xi) {
  Quarters q{};
  for (std::size_t i = 0; i < as_size(dim); ++i)
    q[i] = static_cast<int>(std::lround(simplex ? 4 * xi[i] : 2 * (xi[i] + 1)));
  return q;
}

Point place_of(bool simplex, int dim, const Quarters& q) {
  Point xi{};
  for (std::size_t i = 0; i < as_size(dim); ++i) xi[i] = simplex ? q[i] / 4.0 : q[i] / 2.0 - 1;
  return xi;
}

/// Vertices and weights of a point of a simplex: its barycentric coordinates that are not zero.
void locate_in_simplex(int dim, LatticePoint& point) {
  Quarters q = point.quarters;
  const int first = 4 - q[0] - q[1] - q[2];
  for (int v = 0; v <= dim; ++v)
    if (const int weight = v == 0 ? first : q[as_size(v - 1)]; weight > 0) {
      point.vertices.push_back(v);
      point.weights.push_back(static_cast<std::uint8_t>(weight));
    }
}

/// The same in a cube, of as many dimensions as the edge or face has that the point lies within: on an edge
/// weights sum to 4, on a face to 16, whatever the element is.
void locate_in_cube(int dim, LatticePoint& point) {
  for (int v = 0; v < 1 << dim; ++v) {
    int weight = 1;
    for (int i = 0; i < dim; ++i) {
      const int q = point.quarters[as_size(i)];
      const bool upper = (corner_bits(v) >> i & 1) != 0;
      if (q == 0 || q == 4)
        weight *= upper == (q == 4) ? 1 : 0;
      else
        weight *= upper ? q : 4 - q;
    }
    if (weight == 0) continue;
    point.vertices.push_back(v);
    point.weights.push_back(static_cast<std::uint8_t>(weight));
  }
}

class Maker {
 public:
  explicit Maker(Shape shape)
      : shape_(shape),
        simplex_(row_of(shape).reference == Reference::simplex),
        dim_(dimension(shape)),
        nodes_(nodal_rule(shape)) {
    // The parent's own nodes come first, in their order.
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      point_at(quarters_of(simplex_, dim_, nodes_[a].xi));
      lattice_.points[a].old = static_cast<int>(a);
    }
  }

  Lattice make() {
    if (simplex_)
      divide_simplex();
    else
      divide_cube();
    for (LatticePoint& point : lattice_.points) {
      std::vector<double>& values = lattice_.basis.emplace_back(nodes_.size());
      basis_values(shape_, point.xi, values);
    }
    return std::move(lattice_);
  }

 private:
  int point_at(const Quarters& q) {
    const auto [found, is_new] = place_.emplace(q, static_cast<int>(lattice_.points.size()));
    if (is_new) {
      LatticePoint& point = lattice_.points.emplace_back();
      point.quarters = q;
      point.xi = place_of(simplex_, dim_, q);
      if (simplex_)
        locate_in_simplex(dim_, point);
      else
        locate_in_cube(dim_, point);
    }
    return found->second;
  }

  void divide_cube() {
    // A child of each corner: half of the parent's coordinates, from its corner on.
    Children children;
    for (int c = 0; c < 1 << dim_; ++c) {
      std::vector<int>& child = children.emplace_back();
      for (const QuadraturePoint& node : nodes_) {
        Point xi{};
        for (int i = 0; i < dim_; ++i)
          xi[as_size(i)] = (node.xi[as_size(i)] + ((corner_bits(c) >> i & 1) != 0 ? 1 : -1)) / 2;
        child.push_back(point_at(quarters_of(false, dim_, xi)));
      }
    }
    lattice_.choices.push_back(std::move(children));
  }

  /// The image of the parent with its vertices at some points, given in quarters.
  std::vector<int> image(std::vector<Quarters> vertices) {
    // Of a negative orientation two vertices are exchanged.
    if (dim_ == 3) {
      std::array<Quarters, 3> d{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i) d[k][i] = vertices[k + 1][i] - vertices[0][i];
      const int det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                      d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                      d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
      if (det < 0) std::swap(vertices[2], vertices[3]);
    }
    std::vector<int> child;
    for (const QuadraturePoint& node : nodes_) {
      Point xi{};
      for (std::size_t i = 0; i < as_size(dim_); ++i) {
        double first = 1;
        for (std::size_t k = 0; k < as_size(dim_); ++k) first -= node.xi[k];
        xi[i] = first * vertices[0][i];
        for (std::size_t k = 0; k < as_size(dim_); ++k) xi[i] += node.xi[k] * vertices[k + 1][i];
        xi[i] /= 4;
      }
      child.push_back(point_at(quarters_of(true, dim_, xi)));
    }
    return child;
  }

  Quarters vertex(int v) const {
    Quarters q{};
    if (v > 0) q[as_size(v - 1)] = 4;
    return q;
  }
  Quarters middle(int v, int w) const {
    Quarters q{};
    for (std::size_t i = 0; i < 3; ++i) q[i] = (vertex(v)[i] + vertex(w)[i]) / 2;
    return q;
  }

  void divide_simplex() {
    // A child at each vertex, with the middles of the edges from there as its other vertices.
    Children corners;
    for (int v = 0; v <= dim_; ++v) {
      std::vector<Quarters> vertices;
      for (int w = 0; w <= dim_; ++w) vertices.push_back(v == w ? vertex(v) : middle(v, w));
      corners.push_back(image(vertices));
    }
    if (dim_ == 2) {
      corners.push_back(image({middle(0, 1), middle(1, 2), middle(0, 2)}));
      lattice_.choices.push_back(std::move(corners));
      return;
    }
    // What is left of a tetrahedron is an octahedron of the six middles. Along one of its three diagonals,
    // between middles of opposite edges, it falls into four.
    for (int w = 1; w <= 3; ++w) {
      const int u = w == 1 ? 2 : 1, v = w == 3 ? 2 : 3;
      const Quarters one = middle(0, w), other = middle(u, v);
      const std::array<Quarters, 4> around{middle(0, u), middle(w, u), middle(w, v), middle(0, v)};
      Children children = corners;
      for (std::size_t k = 0; k < 4; ++k)
        children.push_back(image({one, other, around[k], around[(k + 1) % 4]}));
      lattice_.choices.push_back(std::move(children));
      lattice_.diagonals.push_back({point_at(one), point_at(other)});
    }
  }

  Shape shape_;
  bool simplex_;
  int dim_;
  Rule nodes_;
  std::map<Quarters, int> place_;
  Lattice lattice_;
};

}  // namespace

int corner_bits(int vertex) {
  return k_bits[as_size(vertex)];
}

int vertex_at(int bits) {
  return k_bits[as_size(bits)];  // the exchange of two pairs is its own reverse
}

const Lattice& lattice_of(Shape shape) {
  static const std::vector<Lattice> all = [] {
    std::vector<Lattice> made;
    for (const ShapeRow& row : k_shape_rows)
      made.push_back(row.reference == Reference::point || row.reference == Reference::split
                         ? Lattice{}
                         : Maker(row.shape).make());
    return made;
  }();
  return all[static_cast<std::size_t>(shape)];
}

}  // namespace solidus::mesh
