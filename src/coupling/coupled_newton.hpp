/// Newton's method for displacement and temperature at once: one implicit stage of the simultaneous scheme
/// (monograph 4.1.1).
///
///   r_u(u, Θ) = ∫ B̄ᵀ σ(ε(u), Θ) dV − f + contact + inertia = 0                               [N]
///   r_Θ(u, Θ) = (H(Θ) − H_n)/Δt + conduction − sources + contact(u) + structural heat(u, Θ) = 0  [W]
///
/// Where elements are mixed the nodal pressure p is a third unknown. The forces then have the deviator of the
/// law and p, the structural heat depends on p as well, and p has its equation
/// (mechanics/solver/nodal_pressure.hpp):
///
///   r_p(u, p, Θ) = ∫ N (div u − e_v(p, Θ)) dV − S p = 0                                          [m³]
///
/// In what follows u stands for both, and r_u for both residuals, in the monotone form. All residuals
/// are those of the phases, evaluated at the iterate: properties at Θ, with solid fraction and
/// straining of phase changes held at Θ_n (4.81); the conductance of contacts at the gap of u, slip and the
/// interface's temperature as the solution of 5.40 at u and Θ. The tangent is exact, the slopes of the
/// conductivity, of the conductance in the gap and of friction in the temperature included; only radiation
/// across a gap has the symmetric slope of HeatTerm.
///
/// Full steps first, halved only where a law finds no state or a temperature falls below zero: where contact
/// opens or closes, metal yields or a node freezes, the residual rises for an iteration and falls at once
/// after it. From the fifth on, once an iteration gains less than a digit, every iterate is brought to
/// equilibrium at its temperature by the mechanical phase, whose line search follows an energy: perfectly
/// plastic metal near its freezing point sends plain Newton steps back and forth. The displacement is then
/// eliminated, and the heat alone is iterated on. From the sixteenth on a step is halved until the residual
/// is below the largest of the last five (nonmonotone, Grippo, Lampariello, Lucidi 1986).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupling/phases.hpp"
#include "heat/thermal_iteration.hpp"
#include "linear/coupled_solver.hpp"
#include "linear/forcing.hpp"
#include "mechanics/elements/coupled_kernel.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

/// Both residual norms, relative to the references of their phases.
struct CoupledResidual {
  double force = 0;  ///< ‖r_u‖ over its reference, pressures included
  double heat = 0;   ///< Σ|r_Θ| over the heat moved
  double size() const;
};

struct CoupledReport {
  int iterations = 0, linear_iterations = 0;
  double shortest_step = 1;                ///< of the line search
  std::vector<CoupledResidual> residuals;  ///< before each iteration and at the end
};

class CoupledNewton {
 public:
  /// Both phases must outlive this object; the mechanical one is built for Mapping::simultaneous. Collective.
  CoupledNewton(const Phases& phases, linear::CoupledSolverKind solver);

  /// Solves one stage; where the iteration finds no solution, it sets out once more with a tangent that
  /// leaves out how heat follows the displacements. Thermal start and unknowns are those of `thermal`, which
  /// has begun; `x` holds the unknowns of the mechanical phase at the start (MechanicalBodies::start) and, at
  /// the end, at the solution.
  /// @param old   t_n of the mechanical phase, or u*, z* of a second stage
  /// @param pass  time, step and Θ_n
  /// Throws StepRejected on all processes.
  CoupledReport solve(const mechanics::MechanicalState& old, mechanics::MechanicalPass& pass,
                      std::vector<double>& x);

  heat::ThermalIteration& thermal() { return *thermal_; }
  std::span<mechanics::CoupledKernel* const> kernels() const { return kernels_; }
  void forget() { solver_->forget(); }
  double seconds_solver() const { return solver_->seconds(); }

  // The parts of the iteration, for tests of the tangent.
  /// Residuals at x and the temperature of thermal(), [owned node][component] [N] and, with pressures, [owned
  /// node][field] [N] behind them, [owned node] [W]; the force is zero where prescribed and summed where
  /// tied.
  CoupledResidual evaluate(const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
                           std::span<const double> x);
  std::span<const double> force() const { return force_; }
  /// The tangent at the last evaluation.
  linear::CoupledMatrix& assemble(const mechanics::MechanicalState& old, std::span<const double> x,
                                  int iteration);
  /// Lets go of the deformation of the last evaluation, whose storage the next pass may then take.
  void release_deformation();
  /// The tangent of assemble() times a direction, which is local as x and Θ are; on owned entries as the
  /// residuals are, forces that are prescribed or tied as they come.
  void multiply(std::span<const double> x, std::span<const double> temperature, std::span<double> force,
                std::span<double> heat);

 private:
  /// Derivatives that the tangent holds.
  enum class Tangent {
    whole,
    /// All but ∂r_Θ/∂u: a step is one of heat at fixed displacements, and of the displacements after it. It
    /// converges linearly, as the iteration between two phases does, but a contact that opens and closes by
    /// its own heat does not throw it to and fro. Its equilibria hold the points of contact more firmly.
    without_heat_of_motion
  };
  /// The iteration from x and the temperatures of thermal(). Throws StepRejected on all processes.
  CoupledReport iterate(const mechanics::MechanicalState& old, mechanics::MechanicalPass& pass,
                        std::vector<double>& x);
  /// Passes the temperatures of thermal() to the contact pairs.
  void set_contact_temperatures();
  /// Residuals of the last evaluation.
  CoupledResidual present() const;
  bool balanced() const;  ///< both residuals are within their tolerances, or rounding
  /// Whether the heat out of balance is rounding of the displacements: forces are in balance, the steps move
  /// nothing any more, and yet heat does not fall. Gaps and pressures of contact then vary from iteration to
  /// iteration by rounding, and a conductance that follows them does too.
  bool heat_is_rounding() const;
  bool converged() const;  ///< and the next step would be a small one (linear::NewtonOptions)
  double goal() const;     ///< ‖r_u‖ that ends the iteration [N]
  /// The reciprocals of the heat out of balance and of the forces that the temperatures which balance it
  /// would cause: measured by the forces that bodies exchange, thermal stress would drown the heat.
  linear::FieldWeights weights();
  /// δu and δΘ from the tangent; false when the linear solver fails, which `failure` names.
  bool find_direction(linear::Forcing& forcing, CoupledReport& report, std::string& failure);
  /// Tolerance of the linear solver: the residual at which the phase that is further from convergence would
  /// end the iteration.
  double forcing_term(linear::Forcing& forcing, const linear::FieldWeights& weights) const;
  /// Moves along the direction, with a line search.
  double move(const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
              std::vector<double>& x, const CoupledReport& report);
  CoupledResidual evaluate_at(double alpha, const mechanics::MechanicalState& old,
                              const mechanics::MechanicalPass& pass, std::vector<double>& x);
  /// heat = K_Θu x + K_Θp p, with the displacements and pressures of a local direction.
  void multiply_heat(std::span<const double> x, std::span<double> heat);
  /// Displacements and pressures on local nodes from those on owned ones.
  void spread(std::span<const double> owned, std::span<double> x) const;
  std::size_t n_owned_displacements() const;
  /// The displacement in equilibrium with the temperature of now, from x; false where none is found, and x
  /// stays.
  bool equilibrate(const mechanics::MechanicalState& old, mechanics::MechanicalPass pass,
                   std::vector<double>& x);

  struct Work {
    std::vector<double> owned_step;       ///< of displacement and pressure, on owned nodes
    std::vector<double> step_u, start_u;  ///< the same on local nodes
    std::vector<double> step_t, further;  ///< [local node], [owned node]
    std::vector<double> scratch;
  };
  struct Progress {
    double norm = 0, reference = 0;  ///< of r_u
    double next_step = 0;            ///< its estimated size, MechanicalEquations::relative_step
    double shifted_heat = 0;  ///< Σ|K_Θu δu| of the last step, where it set out from forces in balance [W]
    bool in_equilibrium = false;  ///< every iterate is brought there
    int lost = 0;                 ///< iterates for which no equilibrium was found
  };

  Phases phases_;
  mechanics::MechanicalPhase& mechanics_;
  std::unique_ptr<heat::ThermalIteration> thermal_;
  std::vector<mechanics::CoupledKernel*> kernels_;
  linear::CoupledMatrix matrix_;
  parallel::GhostExchange ghosts_;
  std::unique_ptr<linear::CoupledTangentSolver> solver_;
  // At the last evaluation: scratch, and what the heat of deformation there follows from.
  std::vector<mechanics::BlockHistory> history_;
  mechanics::StepDeformation deformation_;
  std::vector<double> force_;  ///< r_u and −unit × r_p, on owned nodes
  Work work_;
  Tangent tangent_ = Tangent::whole;
  Progress progress_;
};

}  // namespace solidus::coupling
