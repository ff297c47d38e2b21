/// Measures, nodal shares and the points of all cells are found once; an object of its own (Division) then
/// integrates, on parts of cells where that is needed.
#include "heat/loads/cell_integrals.hpp"

#include "heat/loads/cell_division.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"

namespace solidus::heat {

CellIntegrals::CellIntegrals(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<Cells> blocks)
    : mesh_(mesh), kind_(kind), blocks_(std::move(blocks)), point_of_node_(mesh.x.size(), -1) {
  // For each cell its measure (volume, area or length, with 2πr around the axis) and the shares of it that
  // its nodes have are integrated once. Functions of place are later evaluated at nodes and centroids.
  node_measure_.resize(mesh.x.size());
  std::vector<Position> centroids;
  first_.push_back(0);
  std::array<double, k_most_nodes> w{};
  for (const Cells& block : blocks_) {
    const auto n = as_size(mesh::node_count(block.shape));
    const auto n_cells = as_index(block.nodes.size() / n);
    // The rule is exact for the product of shape functions and the Jacobian of a straight cell.
    const mesh::Rule rule = mesh::gauss_rule(block.shape, 2 * mesh::order(block.shape) + 1);
    const Point middle = is_box(block.shape)                 ? Point{}
                         : mesh::dimension(block.shape) == 2 ? Point{1.0 / 3, 1.0 / 3, 0}
                                                             : Point{0.25, 0.25, 0.25};
    first_share_.push_back(shares_.size());
    for (Index e = 0; e < n_cells; ++e) {
      const Index* nodes = block.nodes.data() + as_size(e) * n;
      const std::size_t first = shares_.size();
      shares_.resize(first + n);
      double measure = 0;
      for (const mesh::QuadraturePoint& q : rule) {
        const double size = map(mesh, kind, block.shape, nodes, q.xi).second * q.weight;
        shares_at(block.shape, q.xi, std::span(w).first(n));
        measure += size;
        for (std::size_t a = 0; a < n; ++a) shares_[first + a] += w[a] * size;
      }
      // Each node that a cell uses becomes a point of evaluation once, whichever cell finds it first.
      for (std::size_t a = 0; a < n; ++a) {
        node_measure_[as_size(nodes[a])] += shares_[first + a];
        Index& point = point_of_node_[as_size(nodes[a])];
        if (point >= 0) continue;
        point = as_index(used_nodes_.size());
        used_nodes_.push_back(nodes[a]);
        points_.push_back(mesh.x[as_size(nodes[a])]);
      }
      measure_.push_back(measure);
      centroids.push_back(map(mesh, kind, block.shape, nodes, middle).first);
    }
    first_.push_back(first_.back() + n_cells);
  }
  // Centroids follow behind the nodes, so that one list holds all points.
  points_.insert(points_.end(), centroids.begin(), centroids.end());
}

std::size_t CellIntegrals::block_of(Index cell) const {
  std::size_t b = 0;
  while (first_[b + 1] <= cell) ++b;
  return b;
}

const Index* CellIntegrals::nodes_of(Index cell) const {
  const std::size_t b = block_of(cell);
  return blocks_[b].nodes.data() + as_size(cell - first_[b]) * as_size(mesh::node_count(blocks_[b].shape));
}

bool CellIntegrals::counted(Index cell) const {
  const std::size_t b = block_of(cell);
  return cell - first_[b] < blocks_[b].n_counted;
}

CellIntegrals::Result CellIntegrals::integrate(const Evaluate& evaluate, const Breaks& breaks,
                                               bool with_samples) const {
  return Division(*this, evaluate, breaks, with_samples).run();
}

std::size_t CellIntegrals::bytes() const {
  return points_.capacity() * sizeof(Position) + shares_.capacity() * sizeof(double) +
         (node_measure_.capacity() + measure_.capacity()) * sizeof(double);
}

}  // namespace solidus::heat
