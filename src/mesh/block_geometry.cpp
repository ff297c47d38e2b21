/// Gradients of a batch are computed when a kernel asks for them, from the corners of eight elements at
/// once, with one instance of the loops for each shape.
#include "mesh/block_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/block_part.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// The determinant and the inverse of J_ij = ∂x_i/∂ξ_j.
template <std::size_t dim>
struct Jacobian {
  std::array<std::array<Lane, dim>, dim> inverse;
  Lane determinant;
};

template <std::size_t dim>
Jacobian<dim> invert(const std::array<std::array<Lane, dim>, dim>& j) {
  Jacobian<dim> r;
  if constexpr (dim == 2) {
    r.determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    const Lane s = Lane(1.0) / r.determinant;
    r.inverse = {{{s * j[1][1], -s * j[0][1]}, {-s * j[1][0], s * j[0][0]}}};
  } else {
    // The inverse is the transpose of the cofactors over the determinant.
    const auto cofactor = [&j](std::size_t a, std::size_t b) {
      const std::size_t a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
      return j[a1][b1] * j[a2][b2] - j[a1][b2] * j[a2][b1];
    };
    r.determinant = j[0][0] * cofactor(0, 0) + j[0][1] * cofactor(0, 1) + j[0][2] * cofactor(0, 2);
    const Lane s = Lane(1.0) / r.determinant;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) r.inverse[b][a] = s * cofactor(a, b);
  }
  return r;
}

/// @param nodes      [node][lane]
/// @param reference  ∂N_a/∂ξ_j, [point][node][dim]
template <std::size_t n_nodes, std::size_t dim>
void gradients_of(const std::vector<Point>& x, const Index* nodes, const double* reference, int n_points,
                  Lane* gradients, Lane* determinants) {
  // Coordinates of the corners are gathered once for the batch, turned from lanes of nodes to nodes
  // of lanes.
  std::array<std::array<Lane, dim>, n_nodes> corner;
  for (std::size_t a = 0; a < n_nodes; ++a) {
    alignas(sizeof(Lane)) double values[dim][k_lanes];
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
      const Point& of_node = x[as_size(nodes[a * k_lanes + lane])];
      for (std::size_t i = 0; i < dim; ++i) values[i][lane] = of_node[i];
    }
    for (std::size_t i = 0; i < dim; ++i) corner[a][i] = Lane::load(values[i]);
  }
  // At each point the Jacobian from all nodes, its inverse, and the gradients of all functions in
  // space.
  for (int point = 0; point < n_points; ++point) {
    std::array<std::array<Lane, dim>, dim> jacobian{};
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) jacobian[i][j] += corner[a][i] * Lane(reference[a * dim + j]);
    const Jacobian<dim> j = invert<dim>(jacobian);
    *determinants++ = j.determinant;
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) {
        Lane g = Lane(reference[a * dim]) * j.inverse[0][i];
        for (std::size_t k = 1; k < dim; ++k) g += Lane(reference[a * dim + k]) * j.inverse[k][i];
        *gradients++ = g;
      }
    reference += n_nodes * dim;
  }
}

double revolution(AnalysisKind kind, double radius) {
  return kind == AnalysisKind::axisymmetric ? 2 * std::numbers::pi * radius : 1.0;
}

Index batches(Index elements) {
  return (elements + k_lanes - 1) / k_lanes;
}

// The element of a lane: padding lanes repeat the last one.
Index element_of(Index batch, int lane, Index n_elements) {
  return std::min(batch * k_lanes + lane, n_elements - 1);
}

}  // namespace

BlockGeometry::BlockGeometry(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind, const Rule& rule)
    : shape(block.shape),
      n_nodes(node_count(block.shape)),
      dim(dimension(block.shape)),
      n_points(static_cast<int>(rule.size())),
      n_elements(block.size()),
      n_batches(batches(block.size())),
      n_counted(block.n_counted),
      mesh_(&mesh) {
  // Shape functions and their reference gradients are the same for all elements, so they are evaluated once
  // for each point of the rule.
  const auto nn = as_size(n_nodes), nd = as_size(dim), np = as_size(n_points), nb = as_size(n_batches);
  values.resize(np * nn);
  reference_.resize(np * nn * nd);
  for (std::size_t p = 0; p < np; ++p) {
    basis_values(shape, rule[p].xi, std::span(values).subspan(p * nn, nn));
    basis_gradients(shape, rule[p].xi, std::span(reference_).subspan(p * nn * nd, nn * nd));
  }
  held_gradients_.resize(np * nn * nd);
  held_determinants_.resize(np);

  // Weights and radii of every point are kept; gradients are made batch by batch, when a kernel asks for
  // them.
  const bool axisymmetric = kind == AnalysisKind::axisymmetric;
  weight.resize(nb * np);
  inverse_radius.resize(axisymmetric ? nb * np : 0);
  nodes.resize(nb * nn * k_lanes);
  counted.resize(nb);

  // A batch holds as many elements as a lane has numbers. The last batch is filled up with copies of its last
  // element, whose weight is zero.
  for (std::size_t b = 0; b < nb; ++b) {
    for (int lane = 0; lane < k_lanes; ++lane) {
      const Index e = element_of(as_index(b), lane, n_elements);
      const bool padding = as_index(b) * k_lanes + lane >= n_elements;
      counted[b].set(lane, !padding && e < n_counted ? 1.0 : 0.0);
      for (std::size_t a = 0; a < nn; ++a)
        nodes[(b * nn + a) * k_lanes + as_size(lane)] = block.element(e)[a];
    }
    // The weight of a point is that of the rule times the determinant, and 2πr about the axis.
    hold_gradients(as_index(b));
    for (int lane = 0; lane < k_lanes; ++lane) {
      const bool padding = as_index(b) * k_lanes + lane >= n_elements;
      const Index* element = block.element(element_of(as_index(b), lane, n_elements));
      for (std::size_t p = 0; p < np; ++p) {
        double radius = 0;
        for (std::size_t a = 0; a < nn; ++a) radius += values[p * nn + a] * mesh.x[as_size(element[a])][0];
        const std::size_t at = b * np + p;
        weight[at].set(
            lane, padding ? 0.0 : rule[p].weight * held_determinants_[p][lane] * revolution(kind, radius));
        if (axisymmetric) inverse_radius[at].set(lane, radius > 0 ? 1 / radius : 0.0);
      }
    }
  }
}

void BlockGeometry::hold_gradients(Index batch) const {
  // The shape is a number at run time and a constant at compile time in the kernel: each shape has its own
  // instance, with loops of known length.
  const auto find = [&]<std::size_t nn, std::size_t nd>() {
    gradients_of<nn, nd>(mesh_->x, nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes,
                         reference_.data(), n_points, held_gradients_.data(), held_determinants_.data());
  };
  switch (shape) {
    case Shape::tri3:
      find.operator()<3, 2>();
      break;
    case Shape::tri6:
      find.operator()<6, 2>();
      break;
    case Shape::quad4:
      find.operator()<4, 2>();
      break;
    case Shape::quad8:
      find.operator()<8, 2>();
      break;
    case Shape::tet4:
      find.operator()<4, 3>();
      break;
    case Shape::tet10:
      find.operator()<10, 3>();
      break;
    case Shape::hex8:
      find.operator()<8, 3>();
      break;
    case Shape::hex20:
      find.operator()<20, 3>();
      break;
    default:
      throw std::invalid_argument("no element of a body has this shape");
  }
  // The batch that is held is remembered, so that a kernel may ask again. Deformed geometry gets its shift
  // added.
  held_batch_ = batch;
  if (shift_.empty()) return;
  const auto stride = as_size(n_nodes * dim);
  const Lane* const of_batch = shift_.data() + as_size(batch) * stride;
  for (std::size_t i = 0; i < held_gradients_.size(); ++i) held_gradients_[i] += of_batch[i % stride];
}

std::size_t BlockGeometry::bytes() const {
  return sizeof(double) * values.size() + sizeof(Index) * nodes.size() +
         sizeof(Lane) * (shift_.size() + weight.size() + inverse_radius.size() + counted.size());
}

namespace {

// A rule that integrates N (or N²) × det J × r exactly on affine shapes, and as well as the geometry deserves
// on curved ones.
Rule weighting_rule(Shape shape, bool squared) {
  const bool simplex = vertex_count(shape) == dimension(shape) + 1;
  if (order(shape) == 2) return gauss_rule(shape, simplex ? (squared ? 5 : 4) : (squared ? 6 : 5));
  return gauss_rule(shape, simplex ? 2 : 3);
}

// ∫ f(N_a) dV and ∫ dV of every element. Gradients are of no interest here, so the geometry is made for a few
// batches at a time.
template <class Function>
void integrate_basis(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind, const Rule& rule,
                     Function f, PackVector<Lane>& integral, PackVector<Lane>& volume) {
  const auto nn = as_size(node_count(block.shape));
  integral.assign(as_size(batches(block.size())) * nn, Lane(0.0));
  volume.assign(as_size(batches(block.size())), Lane(0.0));
  for_parts(block, [&](const ElementBlock& part, Index first) {
    const BlockGeometry geometry(mesh, part, kind, rule);
    const auto from = as_size(first / k_lanes);
    for (std::size_t b = 0; b < as_size(geometry.n_batches); ++b)
      for (std::size_t p = 0; p < rule.size(); ++p) {
        const Lane w = geometry.weight[b * rule.size() + p];
        volume[from + b] += w;
        for (std::size_t a = 0; a < nn; ++a)
          integral[(from + b) * nn + a] += w * Lane(f(geometry.values[p * nn + a]));
      }
  });
}

}  // namespace

PackVector<Lane> basis_integrals(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind) {
  PackVector<Lane> integral, volume;
  integrate_basis(
      mesh, block, kind, weighting_rule(block.shape, false), [](double n) { return n; }, integral, volume);
  return integral;
}

PackVector<Lane> nodal_weights(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind) {
  if (order(block.shape) == 1) return basis_integrals(mesh, block, kind);
  PackVector<Lane> weights, volume;
  integrate_basis(
      mesh, block, kind, weighting_rule(block.shape, true), [](double n) { return n * n; }, weights, volume);
  const auto nn = as_size(node_count(block.shape));
  for (std::size_t b = 0; b < volume.size(); ++b) {
    Lane scale(0.0);
    for (std::size_t a = 0; a < nn; ++a) scale += weights[b * nn + a];
    for (int lane = 0; lane < k_lanes; ++lane)  // padding lanes have no volume
      scale.set(lane, scale[lane] > 0 ? volume[b][lane] / scale[lane] : 0.0);
    for (std::size_t a = 0; a < nn; ++a) weights[b * nn + a] *= scale;
  }
  return weights;
}

FaceGeometry::FaceGeometry(const Mesh& mesh, const ElementBlock& faces, AnalysisKind kind, const Rule& rule)
    : n_nodes(node_count(faces.shape)),
      n_points(static_cast<int>(rule.size())),
      n_faces(faces.size()),
      n_counted(faces.n_counted) {
  const auto nn = as_size(n_nodes), np = as_size(n_points);
  const auto nd = as_size(dimension(faces.shape));
  assert(nd == 1 || nd == 2);
  // Values and reference gradients are the same for all faces of the shape.
  values.resize(np * nn);
  std::vector<double> reference(np * nn * nd);
  for (std::size_t p = 0; p < np; ++p) {
    basis_values(faces.shape, rule[p].xi, std::span(values).subspan(p * nn, nn));
    basis_gradients(faces.shape, rule[p].xi, std::span(reference).subspan(p * nn * nd, nn * nd));
  }
  weight.reserve(as_size(n_faces) * np);
  normal.reserve(as_size(n_faces) * np);
  for (Index f = 0; f < n_faces; ++f)
    for (std::size_t p = 0; p < np; ++p) {
      Point s{}, t{};
      double radius = 0;
      for (std::size_t a = 0; a < nn; ++a) {
        const Point& x = mesh.x[as_size(faces.element(f)[a])];
        radius += values[p * nn + a] * x[0];
        for (std::size_t i = 0; i < 3; ++i) {
          s[i] += reference[(p * nn + a) * nd] * x[i];
          if (nd == 2) t[i] += reference[(p * nn + a) * nd + 1] * x[i];
        }
      }
      // A line runs counter-clockwise around its element, so its outward normal is the tangent turned
      // clockwise.
      if (nd == 1) t = {0, 0, 1};
      const Point n{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
      const double area = std::hypot(n[0], n[1], n[2]);
      // The length of the normal is the area that the point stands for, with the weight of the
      // rule.
      weight.push_back(rule[p].weight * area * revolution(kind, radius));
      normal.push_back({n[0] / area, n[1] / area, n[2] / area});
    }
}

}  // namespace solidus::mesh
