/// The mass matrix: M_ab = ∫ ρ N_a N_b dV for every component alike, so one number for a pair of nodes. The
/// mesh does not change in the analysis (infinitesimal strain), so it is assembled once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

enum class MassKind {
  consistent,  ///< of the shape functions
  lumped       ///< diagonal: row sums of linear shapes, diagonal scaling of quadratic ones (Hinton, Rock,
               ///< Zienkiewicz 1976), whose row sums can be negative
};

/// Rows of the owned nodes. Axisymmetric: of the whole revolution; plane strain: per metre of thickness.
class MassMatrix {
 public:
  /// @param density of each body [kg/m³]
  MassMatrix(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const double> density, MassKind mass);

  /// Looks up slots; the matrix must couple the nodes of each element.
  void bind(const linear::BlockMatrix& matrix);
  /// y = M x: x [local node][component] with ghosts up to date, y [owned node][component].
  void multiply(std::span<const double> x, int components, std::span<double> y) const;
  /// matrix += factor M.
  void add_to(linear::BlockMatrix& matrix, double factor) const;
  std::size_t bytes() const;

 private:
  void add_consistent(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
                      double density);
  void add_lumped(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind, double density);
  /// Place of an owned row's pair in values_.
  std::size_t place(Index row, Index column) const;

  std::vector<std::int64_t> row_start_;  ///< [owned node]
  std::vector<Index> columns_;           ///< rising within a row
  std::vector<double> values_;           ///< [kg]
  std::vector<linear::BlockMatrix::Slot> slots_;
};

}  // namespace solidus::mechanics
