#include "heat/channels/line_excess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "heat/conduction/conduction_block.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/body_faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

/// Layers of nodes around those that give heat in which the discrete field is computed. The interpolated
/// logarithm beyond them is off by the square of one over their number.
constexpr int k_layers = 4;
constexpr int k_most_iterations = 2000;
constexpr double k_tolerance = 1e-10;

/// What a node is in the patch: far away, prescribed at its rim, or solved for.
enum class Part : char { outside, rim, inner };

/// Unit conduction of one body, as rows of owned nodes.
class UnitConduction {
 public:
  UnitConduction(const mesh::Mesh& mesh, AnalysisKind kind, int body, bool closed)
      : matrix_(mesh, 1, graph(mesh, body)) {
    matrix_.set_zero();
    for (const mesh::ElementBlock& block : mesh.blocks) {
      if (block.body != body) continue;
      const auto conduction = make_conduction_block(mesh, block, kind, closed);
      conduction->bind(matrix_);
      conduction->add_tangent_once(1.0, matrix_);
    }
  }
  /// Calls visit(column, value) for the entries of a row.
  template <class Visit>
  void row(Index node, const Visit& visit) const {
    const auto start = matrix_.row_start();
    for (std::int64_t s = start[as_size(node)]; s < start[as_size(node) + 1]; ++s)
      visit(matrix_.columns()[as_size(s)], *matrix_.block(s));
  }

 private:
  static linear::NodeGraph graph(const mesh::Mesh& mesh, int body) {
    linear::NodeGraph graph(mesh);
    for (const mesh::ElementBlock& block : mesh.blocks)
      if (block.body == body) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    return graph;
  }
  linear::BlockMatrix matrix_;
};

/// Nodes on the skin of the body, [local node].
std::vector<char> skin_nodes(const mesh::Mesh& mesh, int body, const parallel::GhostExchange& ghosts) {
  std::vector<double> on_skin(mesh.x.size(), 0.0);
  mesh::each_body_face_at_owned(mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace>) {
    if (face.body != body) return;
    for (const Index node : face.all_nodes())
      if (node < mesh.n_owned_nodes) on_skin[as_size(node)] = 1;
  });
  ghosts.update(on_skin, 1);
  std::vector<char> flags(on_skin.size());
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = on_skin[i] != 0 ? 1 : 0;
  return flags;
}

/// The parts of the patch: layer after layer of neighbours around the nodes that give heat.
std::vector<Part> parts_of_patch(const mesh::Mesh& mesh, const UnitConduction& conduction,
                                 std::span<const double> taken, const std::vector<char>& skin,
                                 const parallel::GhostExchange& ghosts) {
  std::vector<double> reached(mesh.x.size(), 0.0);
  for (std::size_t i = 0; i < taken.size(); ++i) reached[i] = taken[i] != 0 ? 1 : 0;
  ghosts.update(reached, 1);
  std::vector<double> inner = reached;
  for (int layer = 0; layer <= k_layers; ++layer) {
    std::vector<double> next = reached;
    for (Index i = 0; i < mesh.n_owned_nodes; ++i)
      conduction.row(i, [&](Index column, double) {
        if (reached[as_size(column)] != 0) next[as_size(i)] = 1;
      });
    ghosts.update(next, 1);
    if (layer == k_layers) {
      inner = std::exchange(reached, std::move(next));
    } else {
      reached = std::move(next);
    }
  }
  // Of the nodes reached those of the last layer are the rim, and those of the skin that give nothing: there
  // the body ends, through whose skin the logarithm goes on.
  std::vector<Part> parts(mesh.x.size(), Part::outside);
  std::vector<double> gives(mesh.x.size(), 0.0);
  for (std::size_t i = 0; i < taken.size(); ++i) gives[i] = taken[i];
  ghosts.update(gives, 1);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (reached[i] != 0)
      parts[i] = inner[i] != 0 && (skin[i] == 0 || gives[i] != 0) ? Part::inner : Part::rim;
  return parts;
}

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

/// K x at the inner owned nodes, zero at others; x is exchanged.
void multiply(const UnitConduction& conduction, std::span<const Part> parts,
              const parallel::GhostExchange& ghosts, std::span<double> x, std::span<double> y) {
  ghosts.update(x, 1);
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = 0;
    if (parts[i] != Part::inner) continue;
    conduction.row(as_index(i), [&](Index column, double value) { y[i] += value * x[as_size(column)]; });
  }
}

}  // namespace

std::vector<double> line_excess(const mesh::Mesh& mesh, AnalysisKind kind, int body, bool closed,
                                std::span<const double> taken,
                                const std::function<double(const mesh::Point&)>& far) {
  const parallel::GhostExchange ghosts(mesh);
  const UnitConduction conduction(mesh, kind, body, closed);
  const std::vector<Part> parts =
      parts_of_patch(mesh, conduction, taken, skin_nodes(mesh, body, ghosts), ghosts);
  // The start has the logarithm everywhere, which is near to the solution but where heat is taken.
  const std::size_t n = taken.size();
  std::vector<double> u(mesh.x.size(), 0.0), r(n), z(n), p(mesh.x.size(), 0.0), q(n), diagonal(n, 1.0);
  for (std::size_t i = 0; i < u.size(); ++i)
    if (parts[i] != Part::outside) u[i] = far(mesh.x[i]);
  for (std::size_t i = 0; i < n; ++i)
    if (parts[i] == Part::inner)
      conduction.row(as_index(i), [&](Index column, double value) {
        if (as_size(column) == i) diagonal[i] = value;
      });
  // Conjugate gradients with the diagonal as preconditioner, on the inner nodes.
  multiply(conduction, parts, ghosts, u, q);
  for (std::size_t i = 0; i < n; ++i) r[i] = parts[i] == Part::inner ? -taken[i] - q[i] : 0.0;
  double before = 0;
  const double enough = k_tolerance * std::sqrt(product(taken, taken));
  for (int k = 0; k < k_most_iterations; ++k) {
    if (!(std::sqrt(product(r, r)) > enough)) break;
    for (std::size_t i = 0; i < n; ++i) z[i] = r[i] / diagonal[i];
    const double now = product(r, z);
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + (before > 0 ? now / before : 0.0) * p[i];
    before = now;
    multiply(conduction, parts, ghosts, p, q);
    const double alpha = now / product(std::span(p).first(n), q);
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
  }
  ghosts.update(u, 1);
  return u;
}

}  // namespace solidus::heat
