/// The unknowns of a saddle point (saddle_matrix.hpp): its degrees of freedom without those that are
/// prescribed, that follow another one (multi_point_constraints.hpp) or whose node has no pressure.
///
/// A linear solver works on these alone, so nodes of bodies that only conduct heat have no rows.
#pragma once

#include <span>
#include <vector>

#include "linear/saddle_matrix.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

/// Displacements and pressures on owned nodes follow one another in what is called the whole.
class SaddleUnknowns {
 public:
  /// @param no_pressure  [local node][field], ghosts included: nodes without a pressure of this field
  /// The constraints and prescribed displacements are those of A as they are now. Collective.
  SaddleUnknowns(const mesh::Mesh& mesh, const SaddleMatrix& matrix, std::span<const char> no_pressure,
                 const parallel::GhostExchange& ghosts);

  /// Unknowns of this process, and of all processes.
  std::size_t size() const { return entries_.size(); }
  GlobalIndex n_global() const { return n_global_; }
  /// From unknowns to the whole: zero where prescribed, the leader's value where tied. Collective with
  /// constraints.
  void expand(std::span<const double> unknowns, std::span<double> whole) const;
  /// From forces on the whole to those on the unknowns: the sum where tied. Collective with constraints.
  void restrict_to(std::span<const double> whole, std::span<double> unknowns) const;

  /// The number over all processes, −1 where there is no unknown; of a local node.
  PetscInt of_displacement(Index node, int component) const {
    return displacements_[as_size(node * components_ + component)];
  }
  PetscInt of_pressure(Index node, int field) const { return pressures_[as_size(node * fields_ + field)]; }

 private:
  int components_, fields_;
  const MultiPointConstraints& constraints_;
  std::size_t n_displacements_;  ///< of the whole
  GlobalIndex n_global_ = 0;
  std::vector<std::size_t> entries_;  ///< of the whole, [unknown]
  std::vector<PetscInt> displacements_, pressures_;
};

/// Calls f(i, j, value) for all entries of the matrix of unknowns, with their numbers over all processes, −1
/// where a degree of freedom is no unknown; always in the same order.
/// @param numbers  has of_displacement(node, component) and of_pressure(node, field)
template <class Numbers, class F>
void each_saddle_entry(Index n_owned_nodes, const SaddleMatrix& matrix, const Numbers& numbers, const F& f) {
  const BlockMatrix& a = matrix.displacement();
  const int dim = matrix.components(), fields = matrix.fields();
  const bool half = a.storage() == BlockMatrix::Storage::upper;
  for (Index row = 0; row < n_owned_nodes; ++row)
    for (std::int64_t s = a.row_start()[as_size(row)]; s < a.row_start()[as_size(row) + 1]; ++s) {
      const Index column = a.columns()[as_size(s)];
      const bool mirrored = half && column != row && column < n_owned_nodes;
      const auto entry = [&](PetscInt i, PetscInt j, double value) {
        f(i, j, value);
        if (mirrored) f(j, i, value);
      };
      const double *const block = a.block(s), *const border = matrix.border(s);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          entry(numbers.of_displacement(row, i), numbers.of_displacement(column, j), block[i * dim + j]);
      for (int i = 0; i < dim; ++i)
        for (int field = 0; field < fields; ++field)
          entry(numbers.of_displacement(row, i), numbers.of_pressure(column, field),
                border[i * fields + field]);
      for (int field = 0; field < fields; ++field)
        for (int i = 0; i < dim; ++i)
          entry(numbers.of_pressure(row, field), numbers.of_displacement(column, i),
                border[dim * fields + field * dim + i]);
      for (int field = 0; field < fields; ++field)
        for (int other = 0; other < fields; ++other)
          entry(numbers.of_pressure(row, field), numbers.of_pressure(column, other),
                border[2 * dim * fields + field * fields + other]);
    }
}

/// The saddle point of the unknowns in PETSc's format, for factorisations.
class SaddleCopy {
 public:
  /// Copies the values of now. Collective.
  Mat copy(const mesh::Mesh& mesh, const SaddleMatrix& matrix, const SaddleUnknowns& unknowns);
  /// The next copy has another pattern.
  void reset() { matrix_.reset(); }

 private:
  void create(const mesh::Mesh& mesh, const SaddleMatrix& matrix, const SaddleUnknowns& unknowns);

  petsc::MatHandle matrix_;
  std::vector<double> values_;
};

}  // namespace solidus::linear
