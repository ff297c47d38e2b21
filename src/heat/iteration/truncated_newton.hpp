/// One step of the thermal phase where the nodes hold the heat: truncated nonsmooth Newton's method.
///
///   F_i = (H_i − H*_i)/Δt + r_i(Θ) = 0                                                          [W]
///
/// H_i(Θ_i) rises, and is vertical where a change is isothermal. In the unknown v of nodal_potential.hpp
/// conduction is linear, r = A v − b, with A symmetric and positive semi-definite, so F = 0 says that v
/// minimises the strictly convex functional
///
///   E(v) = Σ_i ∫ H_i/Δt dv_i + ½ vᵀA v − (b + H*/Δt)ᵀ v
///
/// One iteration is
///   1. a nonlinear sweep of Gauss and Seidel's method over the nodes, there and back: each node takes the
///      H_i that balances its own equation, so it may come to lie on a plateau, or leave it. It is swept on
///      over the nodes where F is concentrated then, those at the front (local_sweeps.hpp): they find out
///      among themselves which of them freeze. F is evaluated again; where it is small enough now, the
///      iteration ends;
///   2. a step of Newton's method (D + A) δ = −F, D_i = 1/(Δt dv_i/dH_i), for the nodes that do not lie on a
///      plateau: the others are held (truncated). The linear solver goes as far as the step is good for;
///   3. a line search for the least E along δ, which cuts off what is wrong with the step of a node that
///      passes a plateau, where H_i jumps, or a bend of its curve. Where it would cut nearly all, or where
///      some node has passed a plateau with all its neighbours since the last iteration (plateau_watch.hpp),
///      the tangents say nothing of what lies behind the plateau. The step is then found with the slopes of
///      chords, D_i = (H_i(v_i + δ_i) − H_i)/(Δt δ_i), by a few repetitions that begin without plateaus: a
///      node that passes one takes up its latent heat in the linear system, and the front of an isothermal
///      change moves by as many layers of nodes as the heat allows. For the kink of E that a plateau is, that
///      is iteratively reweighted least squares (I. Daubechies, R. DeVore, M. Fornasier and C. S. Güntürk,
///      Comm. Pure Appl. Math. 63 (2010) 1). Where chords have just been used without gain and a step of
///      tangents comes out shorter than 1e-3, it is found again with those nodes held that cut it short: they
///      lie next to a plateau and are driven on to it.
/// No part lets E rise, and the sweeps alone converge, so the iteration converges from any start, for every
/// step and curve; near the solution it is Newton's method. The number of iterations hardly depends on the
/// mesh. C. Gräser and R. Kornhuber, J. Comput. Math. 27 (2009) 1; C. Gräser, U. Sack and O. Sander,
/// Truncated nonsmooth Newton multigrid methods for convex minimization problems, Domain Decomposition
/// Methods XVIII (Springer 2009), where one multigrid cycle stands for the linear solver.
///
/// Further terms of the residual (radiation, films and contributions that are nonlinear in v, materials of
/// different conductivity curves that share nodes) enter A by their derivatives. The argument above does not
/// cover them: the line search then uses F itself. Where the derivative is not symmetric, A is only close to
/// it (HeatSystem::assemble_symmetric), and Newton's method would converge by a factor an iteration; the step
/// is then improved to that of the derivative itself by generalised conjugate residuals, with A for their
/// preconditioner. With several processes each sweeps over its own nodes; the
/// magnitudes of couplings to other processes' nodes are added to the diagonal, with which E falls although
/// the neighbours move at the same time.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "heat/iteration/heat_solver.hpp"
#include "heat/iteration/heat_system.hpp"
#include "heat/iteration/node_curves.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "linear/forcing.hpp"
#include "linear/newton.hpp"

namespace solidus::heat {

struct TruncatedNewtonOptions {
  double tolerance = 1e-6;  ///< Σ|F_i| <= tolerance × heat moved per time
  int max_iterations = 50;
  double effort_tolerance = 1e-6;  ///< what linear::NewtonReport::effort counts down to
};

class TruncatedNewton {
 public:
  /// @param relaxed  the nodes that sweeps may change, [owned node]; empty: all. Not those where a
  ///                 contribution takes back what the node stores (consistent_heat.hpp)
  TruncatedNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage,
                  HeatSolver& solver, const parallel::GhostExchange& ghosts, TruncatedNewtonOptions options,
                  std::vector<char> relaxed = {});

  /// From the start values in `temperature` and `heat` ([local node]), a point of each node's graph;
  /// `old_heat` is H*. Where the temperature is prescribed, `temperature` already holds it. Collective.
  /// Conduction is limited as it was before the call; where the iteration has converged the limits are found
  /// again, and it goes on if that changes much. Not if `newton_steps` says when it ends.
  /// @param bounds        temperatures that conduction should not leave
  /// @param newton_steps  at most so many iterations; zero: the limit of the options
  linear::NewtonReport solve(std::span<const double> old_heat, double dt, std::span<double> temperature,
                             std::span<double> heat, const ConductionBounds& bounds = {},
                             int newton_steps = 0);
  /// Takes away F at the end of the last solve, [owned node] [W]: where the temperature is prescribed, the
  /// heat that holds it.
  std::vector<double> take_residual() { return std::move(work_.r); }
  /// Heat moved per time in the last residual, all processes [W].
  double moved() const { return sums_.moved; }

 private:
  static constexpr double k_short_step = 0.2;   ///< length below which a step is found again by chords
  static constexpr double k_stuck_step = 1e-3;  ///< or with those nodes held that cut it short

  /// The vectors of a solve live as long as it does: criteria and files need the memory in between.
  void allocate();
  void release();
  void evaluate();
  bool converged() const {
    return sums_.unbalanced <= options_.tolerance * sums_.moved || sums_.unbalanced <= sums_.round_off;
  }
  double forcing_term(linear::Forcing& forcing) const;
  void begin();
  linear::LinearReport step(double to, bool& by_chords, bool may_use_chords, linear::NewtonReport& report);
  void assemble();
  void relax_nodes(bool all);
  double look_up(Index node);
  double relax_locally();
  void sweep();
  void follow_other_processes();
  double relax(std::size_t i, double residual);
  /// @param chords  slopes that replace those of the tangents, [owned node]; empty: none
  linear::LinearReport correct(double forcing, std::span<const float> chords = {});
  int refine(std::span<const char> held, double forcing);
  void multiply_exactly(std::span<double> step, std::span<double> product, std::span<const char> held);
  void find_chords(std::span<float> chords) const;
  linear::LinearReport correct_by_chords(double forcing);
  linear::LinearReport correct_beside_kinks(double forcing);
  bool revise_limits(const ConductionBounds& bounds);
  bool search(double least);
  bool find_length(double least);
  double minimise(double start, double longest, double (TruncatedNewton::*slope_at)(double));
  double linear_slope(double alpha);
  double true_slope(double alpha);
  double true_slope_here();
  double slope_along_step() const;
  void move(double alpha);
  void take(double alpha);

  /// All are empty between solves, F when it has been taken away.
  struct Work {
    std::vector<double> r;            ///< F, during sweeps that of the linear A, [owned node]
    std::vector<double> diagonal;     ///< of A, with the magnitudes of couplings to other processes' nodes
    std::vector<double> step;         ///< change of v, [local node]
    std::vector<double> product;      ///< A times it; before that the right-hand side, [owned node]
    std::vector<double> potential;    ///< v of the heats, but for the trials of a search, [owned node]
    std::vector<double> curve_slope;  ///< dv/dH there, zero on a plateau
    std::vector<double> from_heat;    ///< H where a search begins, within it alone
  };
  /// What the step is given: H*, and the start values, which become the solution.
  struct OfStep {
    double dt = 1, rate = 1;  ///< Δt, 1/Δt
    std::span<const double> old_heat;
    std::span<double> heat, temperature;
  };
  /// Over all processes [W].
  struct Sums {
    double unbalanced = 0;   ///< Σ|F_i| where free
    double moved = 0;        ///< heat moved per time
    double round_off = 0;    ///< F that is rounding
    double conductance = 0;  ///< Σ|A_ii Θ_i|
  };
  struct Progress {
    bool looked_up = false;  ///< whether v and dv/dH are those of the heats
    bool linear = true;      ///< whether sweeps with A have brought F down, in this solve
    int idle = 0;            ///< revisions that have found nothing new
    int revisions = 0;       ///< of the limits of conduction, in this step
    double negligible = 0;   ///< |F_i| for which no node is relaxed
  };

  const mesh::Mesh& mesh_;
  HeatSystem& system_;
  const NodalEnthalpy& storage_;
  const NodeCurves curves_;
  HeatSolver& solver_;
  const parallel::GhostExchange& ghosts_;
  TruncatedNewtonOptions options_;
  std::vector<char> relaxed_;

  OfStep of_step_;
  Work work_;
  Sums sums_;
  Progress progress_;
};

}  // namespace solidus::heat
