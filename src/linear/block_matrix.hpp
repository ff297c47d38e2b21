/// Block-CSR accumulation of element entries and their hand-over to PETSc.
///
/// Rows are the owned nodes, columns the local nodes, blocks block_size × block_size, row-major. A symmetric
/// matrix may be kept by half: its blocks on and above the diagonal, and all of ghost columns. Element
/// kernels add through slots that were looked up once; `matrix()` writes the blocks into PETSc's own arrays,
/// whose order is known. (MatSetValuesCOO would serve too, at 16 more bytes an entry and a sort of all
/// entries at the start.)
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "linear/multi_point_constraints.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/petsc_types.hpp"

namespace solidus::multigrid {
struct MatrixView;
}

namespace solidus::linear {

/// Sparsity pattern of a block matrix as a graph: two nodes are neighbours if they couple. It is filled once,
/// by the elements and by contributions from outside (contact pairs).
class NodeGraph {
 public:
  explicit NodeGraph(const mesh::Mesh& mesh);
  /// All nodes of each clique of `n` nodes couple with each other.
  void add_cliques(std::span<const Index> nodes, int n);
  /// These nodes, [local node], have no unknowns: they couple with nothing, and what is added to their pairs
  /// is lost. Before the first clique.
  void leave_out(std::vector<char> nodes) { left_out_ = std::move(nodes); }
  const std::vector<char>& left_out() const { return left_out_; }
  /// Sorted unique columns of every owned row, without those left of the diagonal where asked; call once,
  /// after all cliques.
  void compress(std::vector<std::int64_t>& row_start, std::vector<Index>& columns, bool upper = false);

 private:
  const mesh::Mesh& mesh_;
  std::vector<std::vector<Index>> rows_;
  std::vector<char> left_out_;  ///< empty: none
};

class BlockMatrix {
 public:
  using Slot = std::int64_t;
  /// The row belongs to another process, a node has no unknowns, the mirror image is kept, or the lane is
  /// padding. Its block is a scrap block that may be added to and is never read, so kernels scatter without a
  /// branch.
  static constexpr Slot k_no_slot = -1;
  enum class Storage {
    whole,
    upper  ///< symmetric; without constraints
  };

  BlockMatrix(const mesh::Mesh& mesh, int block_size, NodeGraph graph, Storage storage = Storage::whole);
  ~BlockMatrix();
  BlockMatrix(const BlockMatrix&) = delete;
  BlockMatrix& operator=(const BlockMatrix&) = delete;

  /// Another pattern, all zero: slots and PETSc's matrix are void, what is prescribed and tied stays.
  /// Collective.
  void set_graph(NodeGraph graph);
  /// Number of the present sparsity pattern, by which code that stores slots notices a new one.
  int pattern() const { return pattern_; }

  int block_size() const { return block_size_; }
  Storage storage() const { return storage_; }
  /// The slot of a pair of local nodes, k_no_slot where the row is not owned, a node is left out or the
  /// mirror image is kept. Any other pair must be in the graph (assert).
  Slot slot(Index row, Index column) const;
  /// Slots of all pairs of the nodes of each element: input [element][n], output [element][a][b].
  std::vector<Slot> clique_slots(std::span<const Index> nodes, int n) const;

  void set_zero();
  /// The block of a slot: block_size² doubles to add to.
  double* block(Slot s) { return values_.data() + (s + 1) * block_size_ * block_size_; }
  const double* block(Slot s) const { return values_.data() + (s + 1) * block_size_ * block_size_; }
  /// The pattern: where the slots of each owned row begin and, last, how many there are; the column (a local
  /// node) of each slot.
  std::span<const std::int64_t> row_start() const { return row_start_; }
  std::span<const Index> columns() const { return columns_; }
  double* diagonal_block(Index owned_node) { return block(diagonal_slot(owned_node)); }

  /// Rows and columns of these degrees of freedom become those of the identity times the mean diagonal;
  /// [local node][component], ghosts included and already exchanged. Set again only when the set changes.
  void set_fixed(std::vector<char> fixed);
  const std::vector<char>& fixed() const { return fixed_; }
  /// The degrees of freedom of each group get one common value: matrix() is then Tᵀ A T of
  /// multi_point_constraints.hpp, with the mean diagonal where an entry is no unknown. Once, before the first
  /// matrix(); no member may be fixed. Collective.
  void constrain(std::vector<std::vector<Index>> groups);
  const MultiPointConstraints& constraints() const { return constraints_; }

  /// Passes the values on and returns the PETSc matrix, which is made at the first call; owned by this
  /// object.
  Mat matrix();
  /// Calls `read` while the blocks are those of the matrix with its fixed rows and columns; no constraints.
  /// Collective.
  void constrained(const std::function<void()>& read);
  /// y = A x for local x (ghosts up to date), y on owned nodes; ignores set_fixed and constrain.
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// The same with fixed rows and columns, whose diagonal is one; sets x to zero there. No constraints.
  void multiply_free(std::span<double> x, std::span<double> y) const;
  std::size_t bytes() const;

 private:
  /// A row of half a matrix begins with its diagonal.
  Slot diagonal_slot(Index owned_node) const {
    const auto row = as_size(owned_node);
    return storage_ == Storage::upper ? row_start_[row] : diagonal_[row];
  }
  void order_ghost_columns();
  void mask(double diagonal);
  void unmask();
  void create_petsc_matrix();
  void create_tied_matrix();
  void create_matrix_of_size();
  void copy_to_petsc();
  multigrid::MatrixView view() const;
  double mean_diagonal() const;

  const mesh::Mesh& mesh_;
  int block_size_;
  Storage storage_;
  int pattern_ = 0;
  std::vector<std::int64_t> row_start_;
  std::vector<Index> columns_;
  std::vector<Slot> diagonal_;             ///< of each owned row where the matrix is whole
  std::vector<char> left_out_;             ///< as of the graph
  std::vector<std::int64_t> ghost_start_;  ///< [owned node], into ghost_slots_
  std::vector<Slot> ghost_slots_;          ///< slots of ghost columns in global order
  std::vector<double> values_;             ///< the scrap block, then a block per slot; upper: and a few more
  mutable std::vector<double> scratch_;    ///< of products
  std::vector<char> fixed_;
  bool any_fixed_ = false;                   ///< on any process
  std::vector<std::size_t> masked_;          ///< entries of values_ in fixed rows or columns
  std::vector<std::size_t> fixed_diagonal_;  ///< diagonal entries of fixed owned degrees of freedom
  std::vector<double> saved_;                ///< the masked values while PETSc sees zeros
  MultiPointConstraints constraints_;  ///< values_ then ends with one more diagonal entry for each follower
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::linear
