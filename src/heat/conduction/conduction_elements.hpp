/// Conduction in the elements of all bodies, with their curves k(Θ): its potentials and its derivative.
///
///   r_i = ∫ ∇N_i · ∇u dV,   k ∇Θ = ∇u by Kirchhoff's transform (conduction_block.hpp)              [W]
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "heat/conduction/conduction_block.hpp"
#include "heat/conduction/edge_conduction.hpp"
#include "heat/conduction/kirchhoff_potential.hpp"
#include "heat/conduction/nodal_potential.hpp"
#include "linear/active_set.hpp"
#include "linear/block_matrix.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "system/pinned.hpp"

namespace solidus::heat {

class ConductionElements : Pinned {
 public:
  /// @param closed         quads and hexes are integrated at their nodes
  /// @param correct_edges  whether conduction next to re-entrant edges is corrected (edge_conduction.hpp)
  /// @param pattern_stays  the pattern of the matrix changes only where a body leaves: then the geometry of
  ///                       the elements, 183 bytes a node of tetrahedra, is not kept by add_unit()
  ConductionElements(const mesh::Mesh& mesh, AnalysisKind kind, bool closed, bool correct_edges,
                     bool pattern_stays, const std::vector<material::Material>& materials);

  /// Conduction of a body that comes back is computed again when it is asked for.
  void set_active(const linear::ActiveSet& active);
  const linear::ActiveSet& active() const { return active_; }
  /// From here on the elements of a mesh block conduct only a share of what their material does.
  /// @param share  [element of the block]
  void set_shares(std::size_t block, std::vector<double> share);
  /// The matrix has a new graph; it must outlive this object or the next call.
  void bind(linear::BlockMatrix& matrix);
  /// One per body.
  std::span<const KirchhoffPotential> potentials() const { return potentials_; }
  /// The unknown in which the matrix is symmetric.
  const NodalPotential& nodal() const { return *nodal_; }
  /// u of a body where its conductivity varies, else Θ itself; [local node], valid until the next call for
  /// this body or of release_work().
  const double* potential(std::size_t body, std::span<const double> temperature);
  /// Adds ∂r/∂Θ to the matrix, which is unsymmetric where a conductivity varies.
  void add_tangent(std::span<const double> temperature);
  /// Adds ∫∇N_a·∇N_b dV of a body to the matrix.
  void add_unit(int body);
  void release_work();
  std::size_t bytes() const;

 private:
  /// A quantity at the nodes of one body whose conductivity varies.
  struct Field {
    std::vector<Index> nodes;
    std::vector<double> value;  ///< u, or k while the matrix is assembled, [local node]
  };
  void find_field_nodes(std::size_t body);
  ConductionBlock& block(std::size_t number);

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  bool closed_, pattern_stays_;
  linear::ActiveSet active_;
  EdgeConduction edges_;
  linear::BlockMatrix* matrix_ = nullptr;
  /// One per mesh block; null until it is asked for, and of a body that left.
  std::vector<std::unique_ptr<ConductionBlock>> blocks_;
  std::vector<std::vector<double>> shares_;     ///< [mesh block][element]; empty: all
  std::vector<KirchhoffPotential> potentials_;  ///< one per body
  std::vector<Field> fields_;                   ///< one per body
  std::unique_ptr<NodalPotential> nodal_;
};

}  // namespace solidus::heat
