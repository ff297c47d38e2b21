/// The saddle point of mixed elements (mixed_solver.hpp) as an operator on those degrees of freedom that are
/// not prescribed, from the blocks as they stand: neither a copy in PETSc's format nor rows of bodies that
/// take no part.
#pragma once

#include <span>
#include <vector>

#include "algebra/coupled_matrix.hpp"
#include "algebra/parallel.hpp"
#include "mechanics/pressure_equation.hpp"

namespace solidus::mechanics {

class SaddleOperator {
 public:
  /// @param matrix  without ties; what is passed by reference must outlive this object
  SaddleOperator(const mesh::Mesh& mesh, algebra::CoupledMatrix& matrix, PressureEquation& pressure,
                 const algebra::GhostExchange& ghosts);

  /// Owned degrees of freedom that are not prescribed, displacements before pressures.
  std::size_t n_free() const { return free_.size(); }
  /// The whole is displacements and then pressures on owned nodes; zero where prescribed.
  void expand(std::span<const double> free, std::span<double> whole) const;
  void restrict_to_free(std::span<const double> whole, std::span<double> free) const;

  /// y = K x of the whole; x is zero where prescribed, and y is scrap there. Collective.
  void multiply(std::span<const double> x, std::span<double> y);
  /// pull = B p: of the displacements' rows. Collective.
  void multiply_pressure(std::span<const double> p, std::span<double> pull);

 private:
  std::size_t n_displacements() const;

  const mesh::Mesh& mesh_;
  algebra::CoupledMatrix& matrix_;
  PressureEquation& pressure_;
  const algebra::GhostExchange& ghosts_;
  std::vector<std::size_t> free_;     ///< entries of the whole
  std::vector<double> u_, p_, pull_;  ///< scratch, [local node][component]
  std::vector<double> part_;          ///< scratch, owned
};

}  // namespace solidus::mechanics
