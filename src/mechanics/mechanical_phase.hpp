/// The mechanical phase: equilibrium, or the balance of momentum, at t_{n+1} with the temperature held
/// (monograph 4.46, 6.25), or with the entropy of every quadrature point held (4.40).
///
///   r(u) = ∫ B̄ᵀ σ dV − f(t) + contributions + inertia = 0
///
/// Where elements are mixed the nodal pressure is an unknown in addition to the displacement, and its
/// equation a residual in addition to that of the forces (nodal_pressure.hpp).
///
/// In time backward Euler, or the two-step method (material/time_integration.hpp).
///
/// The phase puts its parts together: the bodies with what acts on them, the matrix with its solver, and the
/// equations of a step. What concerns one part alone is asked of that part.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mechanics/mechanical_bodies.hpp"
#include "mechanics/mechanical_equations.hpp"
#include "mechanics/mechanical_matrix.hpp"
#include "mechanics/mechanics_options.hpp"
#include "mechanics/state/mechanical_state.hpp"
#include "mechanics/state/pass.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

class MechanicalPhase {
 public:
  /// @param materials            one per body of the mesh; kept by reference. Those of bodies that are absent
  ///                             from the start need no mechanical properties
  /// @param initial_temperature  Θ_0 of 2.51 [K], [local node]
  /// @param contributions        further terms in the displacement (contact); must outlive the phase
  /// Throws InputError for a condition that names no group of the mesh or contradicts another.
  MechanicalPhase(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
                  std::span<const double> initial_temperature, MechanicalConditions conditions,
                  MechanicsOptions options, std::vector<linear::Contribution*> contributions = {});

  /// The bodies, and what acts on them.
  const MechanicalBodies& bodies() const { return bodies_; }
  /// The matrix and its solver.
  MechanicalMatrix& system() { return system_; }
  /// The pieces of solve(), for an iteration that has further unknowns.
  MechanicalEquations& equations() { return equations_; }
  const mesh::Mesh& mesh() const { return bodies_.mesh; }
  /// From here on other conditions hold; the state goes on as it is. Not between the passes of a step. A
  /// matrix of this phase that others refer to may be made again (coupling/scheme.hpp). The stress of bodies
  /// that have gone is gone with the next step, in which what they held springs back; quasi-statics only.
  /// Collective.
  /// @param start  displacement that relative supports count from, [local node][component]; empty: zero
  /// Throws InputError as the constructor does, and std::invalid_argument for a body that comes back.
  void set_conditions(MechanicalConditions conditions, std::span<const double> start);
  /// Zero displacement, no inelastic strain. With inertia at t = 0: the velocities of the bodies and of the
  /// prescribed displacements, and the accelerations that the loads of that time cause. Collective.
  MechanicalState initial_state();

  /// Solves for t_{n+1} from the state at t_n. `trial` is written only on success; it may be the iterate.
  /// Throws EquilibriumRejected (on all processes) when Newton's iteration fails (mechanical_failure.hpp).
  MechanicalReport solve(const MechanicalState& old, MechanicalState& trial, const MechanicalPass& pass);
  /// The first pass.
  MechanicalReport solve(const MechanicalState& old, MechanicalState& trial,
                         std::span<const double> temperature, double time, double dt) {
    return solve(old, trial, {.time = time, .dt = dt, .temperature = temperature});
  }

  /// The solid fractions that the law works with in a pass, means of both ends of the step, [local
  /// node][field of the body], ghosts up to date; empty where nothing melts.
  std::vector<double> mean_solid_fraction(const MechanicalState& old, const MechanicalPass& pass) const {
    return bodies_.nodal_phases.mean_solid_fraction(fractions_before(old, pass), fraction_place(pass));
  }
  std::size_t bytes() const;

 private:
  void create_blocks(const std::vector<material::Material>& materials);
  std::unique_ptr<BlockKernel> make_block(std::size_t block);
  std::vector<double> initial_pressure();
  void remove_bodies(const linear::ActiveSet& active);
  /// Mass of the active bodies.
  std::vector<double> nodal_mass() const;
  void find_weight(const std::array<double, 3>& gravity);
  void create_pressure();
  void set_in_motion(MechanicalState& state);
  /// ‖r(x)‖ of the free unknowns: without prescribed ones, and with constraints summed.
  double unbalanced(std::span<const double> x);
  /// Tries the guess of the pass: takes it as the start if it is nearer to equilibrium. Returns whether it
  /// did.
  bool try_guess(const MechanicalPass& pass, std::vector<double>& x);

  MechanicalBodies bodies_;
  MechanicalMatrix system_;
  MechanicalEquations equations_;
};

}  // namespace solidus::mechanics
