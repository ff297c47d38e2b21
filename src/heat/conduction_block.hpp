/// Conduction in one mesh block behind an interface: one virtual call per block, none per element.
///
///   r_a += ∫ ∇N_a · k(Θ) ∇Θ dV       K_ab += ∫ k ∇N_a · ∇N_b dV  (+ ∫ k'(Θ) N_b ∇N_a · ∇Θ dV, if exact)
///
/// Closed rule, linear shapes: simplices take the mean of the nodal conductivities; quads and hexes are
/// integrated at their nodes, which makes the matrix of non-negative type on rectangles and boxes (6.34).
/// Their nodal gradients are shifted by a constant so that the mean gradient is the exact one: a linear field
/// is then reproduced on distorted elements too, and nothing changes on rectangles. Otherwise Gauss points
/// with k at the point's own temperature.
#pragma once

#include <memory>
#include <span>

#include "algebra/block_matrix.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

/// Conductivity at the nodes of a body and its derivative, [local node]; used by closed linear shapes only.
struct NodalConductivity {
  std::span<const double> value;  ///< [W/(m K)]
  std::span<const double> slope;  ///< dk/dΘ, read for the exact tangent only
};

class ConductionBlock {
 public:
  virtual ~ConductionBlock() = default;
  virtual void bind(const algebra::BlockMatrix& matrix) = 0;
  /// heat += heat flow out of the nodes into the element [W], [local node]; ghost rows are scrap.
  virtual void add_heat(std::span<const double> temperature, const NodalConductivity& k,
                        std::span<double> heat) const = 0;
  virtual void add_tangent(std::span<const double> temperature, const NodalConductivity& k, bool exact,
                           algebra::BlockMatrix& matrix) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// @param material kept by reference
std::unique_ptr<ConductionBlock> make_conduction_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                                       AnalysisKind kind, const material::Material& material,
                                                       bool closed);

}  // namespace solidus::heat
