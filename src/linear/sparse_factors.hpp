/// LU factors of an unsymmetric matrix of one process, for many right-hand sides: where one matrix serves
/// more solves than a Krylov method pays for.
#pragma once

#include <memory>
#include <span>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

class SparseFactors {
 public:
  /// An entry that is added to those of the matrix, at a place that its pattern has.
  struct Entry {
    Index row, column;
    double value;
  };
  SparseFactors();
  ~SparseFactors();

  /// Factorises a matrix of blocks of one, whole or half, of nodes that are all owned. The ordering of an
  /// earlier matrix serves as long as the pattern is the same.
  /// @param held  [node]: one where x is zero, whatever the matrix says; its row and column are left out
  /// Returns whether the matrix is regular.
  bool factorise(const BlockMatrix& a, std::span<const Entry> further, std::span<const char> held);
  /// x = A⁻¹ b, zero where held.
  void solve(std::span<const double> b, std::span<double> x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::linear
