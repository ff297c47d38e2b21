/// Integrals of a load over the elements of a body or the faces of a surface, by elements that are divided
/// until what is left does not matter, however much smaller than an element the load is.
///
/// An element whose values at nodes and centroid differ by what could matter in the total is divided into 2^d
/// parts, each again, as long as Gauss' rule on the parts and on the whole differ by more than 1e-5 of the
/// total. The total is that of all processes, known better after every round: where the tail of a narrow load
/// is all that was seen at first, the parts with the larger values lead to it. Elements are halved first
/// until no two coordinates at which the load is known to jump lie in one part (`x > 0.03`), so that nothing
/// between them is missed, and a part with such a coordinate counts as wrong by a quarter of what it holds.
/// Where the load is known to be concentrated at a place, parts there are divided until they are no larger
/// than its radius.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "heat/loads/load_mean.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

class CellIntegrals {
 public:
  /// Elements or faces of one shape.
  struct Cells {
    mesh::Shape shape = mesh::Shape::quad4;
    std::vector<Index> nodes;  ///< local, [cell][node]
    Index n_counted = 0;       ///< the first ones, which this process counts in sums over all
  };
  /// @param x      positions
  /// @param fixed  they are points()
  using Evaluate = std::function<void(std::span<const Position> x, bool fixed, std::span<LoadValues> values)>;
  /// Coordinates at which the load is known to jump, rising, by component, and the least distance of two of
  /// them; places that the load is concentrated at.
  struct Breaks {
    std::array<std::vector<double>, 3> at;
    std::array<double, 3> apart{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::vector<PlaceSpot> spots;
  };
  /// A point of integration of a counted cell.
  struct Sample {
    Position x{};
    mesh::Point xi{};
    double weight = 0;  ///< [m²], [m³]
    LoadValues value{};
  };
  struct Result {
    std::vector<LoadValues> of_points;  ///< values at points()
    std::vector<LoadValues> of_nodes;   ///< ∫ W_a v, [local node]; right for owned nodes
    std::vector<LoadValues> of_cells;   ///< ∫ v, [cell]
    std::vector<Sample> samples;        ///< where they are asked for
    LoadValues total{};                 ///< over all processes
    double uncertain = 0;               ///< the share of the total that may be wrong
  };

  /// @param mesh  must outlive this object
  CellIntegrals(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<Cells> blocks);
  /// The nodes of the cells, then their centroids.
  std::span<const Position> points() const { return points_; }
  /// The number of a node's point; −1: it belongs to no cell.
  Index point_of_node(Index node) const { return point_of_node_[as_size(node)]; }
  /// ∫ W_a, [local node]; right for owned nodes. W_a are the basis functions of linear shapes, of quadratic
  /// ones N_a²/Σ N_b²: not negative, and their sum is one.
  std::span<const double> of_nodes() const { return node_measure_; }
  double of_cell(Index cell) const { return measure_[as_size(cell)]; }
  /// Collective. Throws, on every process, what the function throws.
  Result integrate(const Evaluate& evaluate, const Breaks& breaks, bool with_samples = false) const;
  std::size_t bytes() const;

 private:
  struct Part;
  class Division;
  std::size_t block_of(Index cell) const;
  const Index* nodes_of(Index cell) const;
  bool counted(Index cell) const;

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  std::vector<Cells> blocks_;
  std::vector<Index> first_;  ///< number of the first cell of each block, and of all cells
  std::vector<Position> points_;
  std::vector<Index> point_of_node_, used_nodes_;
  std::vector<double> node_measure_, measure_;  ///< [local node], [cell]
  std::vector<double> shares_;                  ///< ∫ W_a of a cell, [cell][node]
  std::vector<std::size_t> first_share_;        ///< [block]
};

}  // namespace solidus::heat
