/// Conduction in one mesh block behind an interface: one virtual call per block, none per element.
///
///   r_a += ∫ ∇N_a · ∇u dV,   u = Σ_b N_b u(Θ_b)       ∂r_a/∂Θ_b = k(Θ_b) ∫ ∇N_a · ∇N_b dV
///
/// r = K u, where K is the matrix of the second formula without k; HeatSystem stores it.
///
/// with Kirchhoff's potential u = ∫ k dΘ at the nodes (kirchhoff_potential.hpp), interpolated as the
/// temperature is: the flux k ∇Θ to the order of the element, exact in one dimension, and linear in the nodal
/// potentials for every k(Θ).
///
/// Quadrature at the nodes (closed rule): quads and hexes are integrated at their nodes, which makes the
/// matrix of non-negative type on rectangles and boxes (6.34). Their nodal gradients are shifted by a
/// constant so that the mean gradient is the exact one: a linear field is then reproduced on distorted
/// elements too, and nothing changes on rectangles. Otherwise Gauss points.
#pragma once

#include <memory>
#include <span>

#include "heat/conduction/edge_conduction.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class ConductionBlock {
 public:
  virtual ~ConductionBlock() = default;
  /// Finds the positions of the entries in a matrix with a new graph.
  virtual void bind(const linear::BlockMatrix& matrix) = 0;
  /// matrix_ab += factor ∫ ∇N_a · ∇N_b dV columns_b.
  /// @param columns  [local node]; empty: one
  virtual void add_tangent(double factor, std::span<const double> columns,
                           linear::BlockMatrix& matrix) const = 0;
  /// The same with one for all columns, slower: nothing is stored for the next call, which saves 180 bytes
  /// per node of tetrahedra.
  virtual void add_tangent_once(double factor, linear::BlockMatrix& matrix) const = 0;
  /// From now on the conductivity of each element is multiplied by a factor.
  /// @param share  [element]
  virtual void set_shares(std::span<const double> share) = 0;
  virtual std::size_t bytes() const = 0;
};

/// @param edges  factors of the elements at re-entrant edges
std::unique_ptr<ConductionBlock> make_conduction_block(const mesh::Mesh& mesh,
                                                       const mesh::ElementBlock& block, AnalysisKind kind,
                                                       bool closed, const EdgeConduction& edges = {});

}  // namespace solidus::heat
