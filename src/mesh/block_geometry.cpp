#include "mesh/block_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace solidus::mesh {

namespace {

struct Jacobian {
  std::array<std::array<double, 3>, 3> inverse{};
  double determinant = 0;
};

// J_ij = ∂x_i/∂ξ_j in `dim` dimensions.
Jacobian invert(const std::array<std::array<double, 3>, 3>& j, int dim) {
  Jacobian r;
  if (dim == 2) {
    r.determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    const double s = 1 / r.determinant;
    r.inverse = {{{s * j[1][1], -s * j[0][1], 0}, {-s * j[1][0], s * j[0][0], 0}, {0, 0, 0}}};
    return r;
  }
  const auto cofactor = [&j](std::size_t a, std::size_t b) {
    const std::size_t a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
    return j[a1][b1] * j[a2][b2] - j[a1][b2] * j[a2][b1];
  };
  r.determinant = j[0][0] * cofactor(0, 0) + j[0][1] * cofactor(0, 1) + j[0][2] * cofactor(0, 2);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) r.inverse[b][a] = cofactor(a, b) / r.determinant;
  return r;
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

BlockGeometry::BlockGeometry(const Mesh& mesh, const Block& block, AnalysisKind kind, const Rule& rule)
    : shape(block.shape),
      n_nodes(node_count(block.shape)),
      dim(dimension(block.shape)),
      n_points(static_cast<int>(rule.size())),
      n_elements(block.size()),
      n_batches(batches(block.size())),
      n_counted(block.n_counted) {
  const auto nn = static_cast<std::size_t>(n_nodes), nd = static_cast<std::size_t>(dim),
             np = static_cast<std::size_t>(n_points), nb = static_cast<std::size_t>(n_batches);
  values.resize(np * nn);
  std::vector<double> reference(np * nn * nd);
  for (std::size_t p = 0; p < np; ++p) {
    basis_values(shape, rule[p].xi, std::span(values).subspan(p * nn, nn));
    basis_gradients(shape, rule[p].xi, std::span(reference).subspan(p * nn * nd, nn * nd));
  }

  const bool axisymmetric = kind == AnalysisKind::axisymmetric;
  gradients.resize(nb * np * nn * nd);
  weight.resize(nb * np);
  inverse_radius.resize(axisymmetric ? nb * np : 0);
  nodes.resize(nb * nn * k_lanes);
  counted.resize(nb);

  for (Index b = 0; b < n_batches; ++b)
    for (int lane = 0; lane < k_lanes; ++lane) {
      const Index e = element_of(b, lane, n_elements);
      const bool padding = b * k_lanes + lane >= n_elements;
      const auto bb = static_cast<std::size_t>(b);
      const Index* element = block.element(e);
      counted[bb].set(lane, !padding && e < n_counted ? 1.0 : 0.0);
      for (std::size_t a = 0; a < nn; ++a)
        nodes[(bb * nn + a) * k_lanes + static_cast<std::size_t>(lane)] = element[a];

      for (std::size_t p = 0; p < np; ++p) {
        const double* dn = reference.data() + p * nn * nd;
        std::array<std::array<double, 3>, 3> jacobian{};
        double radius = 0;
        for (std::size_t a = 0; a < nn; ++a) {
          const Point& x = mesh.x[static_cast<std::size_t>(element[a])];
          radius += values[p * nn + a] * x[0];
          for (std::size_t i = 0; i < nd; ++i)
            for (std::size_t j = 0; j < nd; ++j) jacobian[i][j] += x[i] * dn[a * nd + j];
        }
        const Jacobian j = invert(jacobian, dim);
        const std::size_t at = bb * np + p;
        weight[at].set(lane, padding ? 0.0 : rule[p].weight * j.determinant * revolution(kind, radius));
        if (axisymmetric) inverse_radius[at].set(lane, radius > 0 ? 1 / radius : 0.0);
        for (std::size_t a = 0; a < nn; ++a)
          for (std::size_t i = 0; i < nd; ++i) {
            double g = 0;
            for (std::size_t k = 0; k < nd; ++k) g += dn[a * nd + k] * j.inverse[k][i];
            gradients[(at * nn + a) * nd + i].set(lane, g);
          }
      }
    }
}

std::size_t BlockGeometry::bytes() const {
  return sizeof(double) * values.size() + sizeof(Index) * nodes.size() +
         sizeof(Lane) * (gradients.size() + weight.size() + inverse_radius.size() + counted.size());
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
void integrate_basis(const Mesh& mesh, const Block& block, AnalysisKind kind, const Rule& rule, Function f,
                     PackVector<Lane>& integral, PackVector<Lane>& volume) {
  constexpr Index k_chunk = 64 * k_lanes;
  const auto nn = static_cast<std::size_t>(node_count(block.shape));
  integral.assign(static_cast<std::size_t>(batches(block.size())) * nn, Lane(0.0));
  volume.assign(static_cast<std::size_t>(batches(block.size())), Lane(0.0));
  for (Index first = 0; first < block.size(); first += k_chunk) {
    const Index n = std::min(k_chunk, block.size() - first);
    Block part;
    part.shape = block.shape;
    part.nodes.assign(block.element(first), block.element(first) + n * node_count(block.shape));
    const BlockGeometry geometry(mesh, part, kind, rule);
    const auto from = static_cast<std::size_t>(first / k_lanes);
    for (std::size_t b = 0; b < static_cast<std::size_t>(geometry.n_batches); ++b)
      for (std::size_t p = 0; p < rule.size(); ++p) {
        const Lane w = geometry.weight[b * rule.size() + p];
        volume[from + b] += w;
        for (std::size_t a = 0; a < nn; ++a)
          integral[(from + b) * nn + a] += w * Lane(f(geometry.values[p * nn + a]));
      }
  }
}

}  // namespace

PackVector<Lane> basis_integrals(const Mesh& mesh, const Block& block, AnalysisKind kind) {
  PackVector<Lane> integral, volume;
  integrate_basis(
      mesh, block, kind, weighting_rule(block.shape, false), [](double n) { return n; }, integral, volume);
  return integral;
}

PackVector<Lane> nodal_weights(const Mesh& mesh, const Block& block, AnalysisKind kind) {
  if (order(block.shape) == 1) return basis_integrals(mesh, block, kind);
  PackVector<Lane> weights, volume;
  integrate_basis(
      mesh, block, kind, weighting_rule(block.shape, true), [](double n) { return n * n; }, weights, volume);
  const auto nn = static_cast<std::size_t>(node_count(block.shape));
  for (std::size_t b = 0; b < volume.size(); ++b) {
    Lane scale(0.0);
    for (std::size_t a = 0; a < nn; ++a) scale += weights[b * nn + a];
    for (int lane = 0; lane < k_lanes; ++lane)  // padding lanes have no volume
      scale.set(lane, scale[lane] > 0 ? volume[b][lane] / scale[lane] : 0.0);
    for (std::size_t a = 0; a < nn; ++a) weights[b * nn + a] *= scale;
  }
  return weights;
}

FaceGeometry::FaceGeometry(const Mesh& mesh, const Block& faces, AnalysisKind kind, const Rule& rule)
    : n_nodes(node_count(faces.shape)),
      n_points(static_cast<int>(rule.size())),
      n_faces(faces.size()),
      n_counted(faces.n_counted) {
  const auto nn = static_cast<std::size_t>(n_nodes), np = static_cast<std::size_t>(n_points);
  const auto nd = static_cast<std::size_t>(dimension(faces.shape));
  assert(nd == 1 || nd == 2);
  values.resize(np * nn);
  std::vector<double> reference(np * nn * nd);
  for (std::size_t p = 0; p < np; ++p) {
    basis_values(faces.shape, rule[p].xi, std::span(values).subspan(p * nn, nn));
    basis_gradients(faces.shape, rule[p].xi, std::span(reference).subspan(p * nn * nd, nn * nd));
  }
  weight.reserve(static_cast<std::size_t>(n_faces) * np);
  normal.reserve(static_cast<std::size_t>(n_faces) * np);
  for (Index f = 0; f < n_faces; ++f)
    for (std::size_t p = 0; p < np; ++p) {
      Point s{}, t{};
      double radius = 0;
      for (std::size_t a = 0; a < nn; ++a) {
        const Point& x = mesh.x[static_cast<std::size_t>(faces.element(f)[a])];
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
      weight.push_back(rule[p].weight * area * revolution(kind, radius));
      normal.push_back({n[0] / area, n[1] / area, n[2] / area});
    }
}

}  // namespace solidus::mesh
