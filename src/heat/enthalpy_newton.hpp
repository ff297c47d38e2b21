/// Semismooth Newton's method for one step of the closed rule, with the nodal enthalpy as unknown.
///
///   F_i(H) = (H_i − H_i^n)/Δt + r_i(Θ(H)) = 0                                                  [W]
///
/// Θ_i(H) is continuous, rises, and is flat on a plateau. Each iteration solves, symmetric,
///
///   (D + J) δΘ = −F,   D_i = 1/(Δt dΘ_i/dH)  or  δΘ_i = 0 on a plateau,   J = ∂r/∂Θ
///   δH_i = δΘ_i / (dΘ_i/dH)  or  −Δt (F + J δΘ)_i on a plateau
///
/// Why it converges for every step: with J = A symmetric positive semi-definite and constant, F = 0 is the
/// minimum of the strongly convex functional
///
///   E(H) = Σ_i ∫Θ_i dH + Δt/2 |(H − H^n)/Δt − b|²_{A⁻¹},   ∇E = Θ(H) − B,   A B = b − (H − H^n)/Δt,
///
/// whose gradient is Lipschitz continuous: Newton's method with a line search that lowers E converges from
/// any start, and ends after finitely many iterations where Θ_i(H) is piecewise linear. B is the temperature
/// that the heat balance asks for; a full step makes it Θ + δΘ, so the slope of E along δH costs no solve:
/// the search only evaluates Θ_i(H), node by node. With a conductivity that varies, B holds to the order of
/// that variation.
///
/// How it is fast: full steps need one to four solves when the front passes a few nodes. A held node hides
/// what lies behind it, so an isothermal front moves about one node per iteration. When a step moves it
/// further, plateaus are tilted for some iterations, Θ_i(H) + (H − H_i^n) tilt/latent heat, by 1 K, then 0.1
/// K, …: the front runs at once to about where it belongs, and the last iterations are exact again. The
/// search guards what is left after 40 full steps.
#pragma once

#include <span>
#include <vector>

#include "algebra/newton.hpp"
#include "heat/heat_solver.hpp"
#include "heat/heat_system.hpp"
#include "heat/nodal_enthalpy.hpp"

namespace solidus::heat {

struct EnthalpyNewtonOptions {
  double tolerance = 1e-9;  ///< Σ|F_i| <= tolerance × heat moved per time
  int max_iterations = 50;
  bool exact_conductivity = false;
  /// A contribution stores heat by another rule (consistent_heat.hpp), of which E below knows nothing: every
  /// step is halved while the residual exceeds the largest of the last few.
  bool halving = false;
};

class EnthalpyNewton {
 public:
  EnthalpyNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage, HeatSolver& solver,
                 const algebra::GhostExchange& ghosts, EnthalpyNewtonOptions options);

  /// To be called when bodies have left the storage.
  void storage_changed();
  /// From the start values in `temperature` and `heat` ([local node]); `old_heat` is H^n. Where the
  /// temperature is prescribed, `temperature` already holds it and `heat` a value of the node's graph.
  /// Collective.
  /// @param newton_steps  at most so many; zero: the limit of the options
  algebra::NewtonReport solve(std::span<const double> old_heat, double dt, std::span<double> temperature,
                              std::span<double> heat, int newton_steps = 0);
  // The pieces of solve(), for an iteration that has further unknowns (thermal_iteration.hpp).
  /// Starts from `heat`, which is kept and moved on.
  void begin(std::span<const double> old_heat, double dt, std::span<double> heat);
  /// F at the temperatures of the heats of now.
  void evaluate(std::span<const double> temperature);
  /// Tilts the plateaus, or less, or no more, when it is time; then F is that of now. `iteration` counts from
  /// zero.
  void adapt_tilt(int iteration, std::span<double> temperature);
  bool converged() const;
  /// D + J in the matrix of the system, nodes on a plateau held, and the right-hand side.
  void assemble(std::span<const double> temperature, bool exact_conductivity);
  std::span<const double> right_hand_side() const { return b_; }
  /// Makes δΘ [owned node] zero where it is none.
  void hold(std::span<double> step_t) const;
  /// Sets out along the δH that follows from δΘ with its ghosts.
  /// @param further  change of F by the further unknowns [W], [owned node]; may be empty
  void enthalpy_step(std::span<const double> step_t, std::span<const double> further);
  /// Moves heats and temperatures [owned node] from `start` by α δH; prescribed ones stay.
  void move(std::span<const double> start, double alpha, std::span<double> temperature);
  double unbalanced() const { return norm_; }  ///< Σ|F_i| at the last evaluate(), all processes [W]

  /// F at the end of the last solve, [owned node] [W]: where the temperature is prescribed, the heat that
  /// holds it.
  std::span<const double> residual() const { return r_; }
  double moved() const { return moved_; }  ///< heat moved per time in the last residual, all processes [W]

 private:
  double slope(double alpha, std::span<const double> temperature) const;
  double tilt(std::size_t i) const { return tilt_ * per_latent_[i]; }
  double temperature_of(std::size_t i, double heat) const;
  void set_tilt(double tilt, std::span<double> temperature);
  double search(std::span<const double> temperature) const;
  /// Moves by a step that is halved until the residual over the heat moved falls.
  void move_and_halve(std::span<const double> residuals, std::span<double> temperature);

  HeatSystem& system_;
  const NodalEnthalpy& storage_;
  HeatSolver& solver_;
  const algebra::GhostExchange& ghosts_;
  EnthalpyNewtonOptions options_;

  double dt_ = 1;
  std::span<const double> old_heat_;
  std::span<double> heat_;
  std::vector<double> r_, b_, step_h_;  ///< [owned node]
  std::vector<double> inverse_;         ///< dΘ/dH, [owned node] [K/J]
  std::vector<double> balance_;         ///< B, [owned node] [K]
  std::vector<double> start_;           ///< of a step that may be halved, [owned node] [J]
  std::vector<double> step_t_;          ///< δΘ, [local node]
  std::vector<double> per_latent_;      ///< 1/latent heat, zero without, [owned node] [1/J]
  int tilted_ = 0;                      ///< iterations with the tilt of now
  double tilt_ = 0;                     ///< temperature difference over the latent heat now [K]
  bool has_plateaus_ = false;           ///< on any process
  double norm_ = 0, moved_ = 0, round_off_ = 0, conductance_ = 0;
};

}  // namespace solidus::heat
