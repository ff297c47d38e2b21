/// Multigrid (multigrid/multigrid.hpp) of a BlockMatrix.
#pragma once

#include <optional>

#include "linear/block_matrix.hpp"
#include "linear/near_null_space.hpp"
#include "multigrid/compact_rows.hpp"

namespace solidus::linear {

class BlockMultigrid : public multigrid::Multigrid {
 public:
  /// rigid_body_modes or constants. It is called in every set-up: the modes take as much memory as a dozen
  /// vectors.
  using Modes = multigrid::NearNullSpace (*)(const mesh::Mesh& mesh, int components);
  /// @param symmetric  whether the matrices are, which halves the memory that a cycle reads
  BlockMultigrid(const mesh::Mesh& mesh, int components, Modes modes, bool symmetric,
                 GlobalIndex coarsest = k_coarsest);
  /// Makes the hierarchy for the blocks of now, fixed rows included; constraints are left out. Collective.
  void set_up(BlockMatrix& a);
  /// z ≈ A⁻¹ r on owned degrees of freedom. Collective.
  void apply(std::span<const double> r, std::span<double> z);
  std::size_t bytes() const;

 private:
  const mesh::Mesh& mesh_;
  int components_;
  Modes modes_;
  /// The rows with unknowns, where many have none; its values go once the hierarchy is made.
  std::optional<multigrid::CompactRows> compact_;
  std::vector<double> right_, solution_;  ///< of these rows
};

}  // namespace solidus::linear
