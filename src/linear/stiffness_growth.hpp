/// Measures how much stiffer a matrix has become since a preconditioner was made for it.
///
/// A multigrid hierarchy that was made for a softer matrix damps nothing where the new one is stiff: where
/// metal has frozen by a factor of 1e4 since then, the eigenvalues of the preconditioned matrix reach 1e4,
/// and Krylov's method takes hundreds of iterations. That is seen at once in the diagonal.
#pragma once

#include <vector>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

class StiffnessGrowth {
 public:
  /// The preconditioner is made for the matrix as it is now.
  void remember(BlockMatrix& a);
  /// The largest ratio, over all nodes and processes, of the trace of a diagonal block to what it was then;
  /// infinite where nothing is remembered. Collective.
  double since(BlockMatrix& a) const;
  std::size_t bytes() const { return trace_.capacity() * sizeof(float); }

 private:
  std::vector<float> trace_;  ///< [owned node]
};

}  // namespace solidus::linear
