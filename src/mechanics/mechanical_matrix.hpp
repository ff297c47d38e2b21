/// The matrix of the mechanical phase and the solver of its linear systems, made for the bodies of a stage.
///
/// The strain is small, so geometry, sparsity and the map from element entries to matrix slots are computed
/// once for the bodies of a stage.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "linear/newton.hpp"
#include "mechanics/mechanical_bodies.hpp"

namespace solidus::mechanics {

class SaddleSolver;

class MechanicalMatrix {
 public:
  /// Keeps a reference; nothing is made yet.
  explicit MechanicalMatrix(MechanicalBodies& bodies);
  ~MechanicalMatrix();

  /// Makes matrix and solver for the bodies, constraints and pressure of now. Collective.
  void create();
  /// The same bodies and constraints have other fixed degrees of freedom. Without mixed elements.
  void set_fixed();
  /// Where nodes meet that did not before, the matrix gets another pattern. Collective.
  void follow_graph();
  /// With its fixed degrees of freedom and multi-point constraints (Loads).
  linear::BlockMatrix& matrix() { return *matrix_; }
  linear::TangentSolver& solver() { return *solver_; }
  /// The same where elements are mixed, else null.
  SaddleSolver* saddle() { return saddle_; }
  /// Components of each field of Newton's iteration.
  std::span<const int> fields() const { return fields_; }
  /// Wall time of all solvers so far [s].
  double seconds() const;
  std::size_t bytes() const;

 private:
  linear::NodeGraph graph() const;
  void bind();
  void create_matrix();
  void create_solver();

  MechanicalBodies& bodies_;
  std::unique_ptr<linear::BlockMatrix> matrix_;
  std::unique_ptr<linear::TangentSolver> solver_;
  SaddleSolver* saddle_ = nullptr;
  std::vector<int> fields_;
  double seconds_before_ = 0;  ///< of solvers that others have replaced
};

}  // namespace solidus::mechanics
