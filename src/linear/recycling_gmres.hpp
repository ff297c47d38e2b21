/// Flexible GMRES that keeps the directions that converge slowly, from cycle to cycle and from one linear
/// system to the next, and removes them from every later one: GCRO-DR of Parks, de Sturler, Mackey, Johnson
/// and Maiti (SIAM J. Sci. Comput. 28 (2006) 1651) in the flexible form of Carvalho, Gratton, Lago and
/// Vasseur (SIAM J. Matrix Anal. Appl. 32 (2011) 1203).
///
/// The systems of Newton's method on a casting with a melt inside its shell have a few such directions, one
/// or two for each pool: a pressure that is constant in the pool and that only the shell resists. The
/// preconditioner takes the pool for soft there. These directions change little between iterations and steps.
///
/// With C = A Z orthonormal, a cycle works with the residual and the products orthogonal to C; from
/// A [Z Z_m] = [C V_m+1] G the harmonic Ritz vectors of smallest absolute value make the next Z.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "linear/linear_solver.hpp"

namespace solidus::linear {

struct RecyclingOptions {
  int directions = 60;       ///< of a cycle, besides those that are kept
  int kept = 40;             ///< at most, from one system to the next
  int worthwhile = 25;       ///< iterations of a cycle from which on the recycled space is chosen again
  int max_iterations = 500;  ///< of a solve
};

class RecyclingGmres {
 public:
  /// y = A x, or z ≈ A⁻¹ r, on the unknowns of this process. Collective.
  using Map = std::function<void(std::span<const double> x, std::span<double> y)>;

  explicit RecyclingGmres(RecyclingOptions options = {});
  ~RecyclingGmres();

  /// Sets the operator and its preconditioner. Both are called during solve() only. The recycled directions
  /// are kept.
  void set(Map op, Map preconditioner);
  /// The values of the operator are other ones at the next solve.
  void operator_changed();
  /// Nothing of the past counts (checkpoints, other unknowns).
  void forget();
  /// Solves to ‖b − A x‖ <= relative ‖b‖ from x = 0. Collective. Throws Interrupted where the run is asked to
  /// stop (interruption.hpp).
  LinearReport solve(std::span<const double> b, std::span<double> x, double relative);
  std::size_t bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::linear
