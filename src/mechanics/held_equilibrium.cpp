/// A tangent whose diagonals keep a share of the largest stiffness that they have had, and a solver that
/// bounds the way of every node: both slow what has just lost its contact, and neither changes the
/// equilibrium.
#include "mechanics/held_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/mechanical_phase.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::mechanics {
namespace {

/// Equilibrium with such a tangent. Keeps references.
class HeldEquilibrium final : public linear::NonlinearSystem {
 public:
  HeldEquilibrium(MechanicalPhase& phase, const MechanicalState& old, double share)
      : phase_(phase), old_(old), share_(share) {}
  double residual(std::span<const double> x, std::span<double> r) override {
    return phase_.equations().residual(x, r);
  }
  linear::BlockMatrix& tangent(std::span<const double> x) override;
  double relative_step(std::span<const double> x, std::span<const double> d) override {
    return phase_.equations().relative_step(old_, x, d);
  }
  void accept(std::span<const double> x, std::span<const double> d, double alpha) override;

 private:
  /// Where the line search takes less than this of a step, s is too small.
  static constexpr double k_shortened = 0.25;
  static constexpr double k_fall = 0.1, k_rise = 100;

  MechanicalPhase& phase_;
  const MechanicalState& old_;
  double share_;
  std::vector<double> largest_;  ///< max K_ii, [owned node][component] [N/m]
};

linear::BlockMatrix& HeldEquilibrium::tangent(std::span<const double> x) {
  linear::BlockMatrix& matrix = phase_.equations().tangent(x);
  const auto n = as_size(matrix.block_size());
  const auto n_owned = as_size(phase_.mesh().n_owned_nodes);
  largest_.resize(n_owned * n, 0.0);
  // Diagonals keep a share of the largest value that they have had, which slows what has just lost its
  // stiffness.
  for (std::size_t node = 0; node < n_owned; ++node) {
    double* const block = matrix.diagonal_block(as_index(node));
    for (std::size_t c = 0; c < n; ++c) {
      double& largest = largest_[node * n + c];
      largest = std::max(largest, block[c * n + c]);
      block[c * n + c] += share_ * (largest - block[c * n + c]);
    }
  }
  if (phase_.system().saddle() != nullptr) phase_.system().saddle()->assemble();
  return matrix;
}

void HeldEquilibrium::accept(std::span<const double>, std::span<const double>, double alpha) {
  share_ = alpha < k_shortened ? std::min(1.0, k_rise * share_) : k_fall * share_;
}

/// A solver whose steps take no node farther than a given way. Keeps references.
class ShortSteps final : public linear::TangentSolver {
 public:
  /// @param displacements  leading entries of a step that are displacements, [owned node][component]
  /// @param longest        way of a node [m]
  ShortSteps(linear::TangentSolver& solver, std::size_t displacements, int components, double longest)
      : solver_(solver), n_(displacements), components_(components), longest_(longest) {}
  linear::LinearReport solve(linear::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                             double forcing) override {
    return shorten(solver_.solve(a, b, x, forcing), x);
  }
  linear::LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing) override {
    return shorten(solver_.solve_again(b, x, forcing), x);
  }
  void forget() override { solver_.forget(); }
  void reset() override { solver_.reset(); }
  linear::SolverSeconds seconds() const override { return solver_.seconds(); }

 private:
  linear::LinearReport shorten(linear::LinearReport report, std::span<double> x) const {
    const auto n = as_size(components_);
    // No node moves farther than allowed; the direction stays.
    double squares = 0;
    for (std::size_t i = 0; i + n <= n_; i += n) {
      double of_node = 0;
      for (std::size_t c = 0; c < n; ++c) of_node += x[i + c] * x[i + c];
      squares = std::max(squares, of_node);
    }
    const double way = std::sqrt(parallel::global_max(squares));
    if (way > longest_)
      for (double& value : x) value *= longest_ / way;
    return report;
  }

  linear::TangentSolver& solver_;
  std::size_t n_;
  int components_;
  double longest_;
};

}  // namespace

linear::NewtonReport attempt_again(MechanicalPhase& phase, const MechanicalState& old,
                                   linear::TangentSolver& solver, const parallel::GhostExchange& ghosts,
                                   std::span<const int> fields, std::vector<double>& x,
                                   linear::NewtonOptions options, double share) {
  // No node may go farther in an iteration than a hundredth of the mesh's diagonal.
  constexpr double k_longest_way = 0.01;
  double diagonal = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& p : phase.mesh().x) low = std::min(low, p[i]), high = std::max(high, p[i]);
    diagonal = std::hypot(diagonal, parallel::global_max(high) - parallel::global_min(low));
  }
  // The second attempt has twice as many iterations, may go downhill, and holds open points by a share that
  // falls from step to step.
  options.max_iterations *= 2;
  options.descends = true;
  HeldEquilibrium held(phase, old, share);
  const auto n = as_size(phase.mesh().n_owned_nodes * phase.bodies().components);
  ShortSteps short_steps(solver, n, phase.bodies().components, k_longest_way * diagonal);
  return linear::newton(held, short_steps, ghosts, fields, x, options);
}

}  // namespace solidus::mechanics
