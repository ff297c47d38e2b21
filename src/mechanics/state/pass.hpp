/// One pass of the mechanical phase: what it gets besides the state and its conditions, and what it returns.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/newton.hpp"
#include "mechanics/state/mechanical_state.hpp"
#include "mechanics/state/structural_lead.hpp"

namespace solidus::mechanics {

class StructuralPoints;

/// Thermal variable that is held fixed in the mechanical phase.
enum class Mapping {
  isothermal,    ///< Θ = Θ_n
  simultaneous,  ///< Θ is an unknown as well: only for coupling/simultaneous.hpp
  isentropic  ///< elastic entropy S^E = S^E(ε_n, z_n, Θ_n), at an intermediate temperature Θ̄ (4.72–4.124)
};

/// Work and heat of a solved step over all processes [J] (axisymmetric: of the whole revolution; plane
/// strain: per metre of thickness). Forces are those at t_{n+1}, times the displacement increment, so that by
/// equilibrium internal_work = external_work + support_work + the work of contributions, to the residual.
/// With inertia they are means over the step (Motion::work_share), and kinetic + numerical are on the left.
struct MechanicalWork {
  double external_work = 0;        ///< of pressures, tractions and gravity
  double support_work = 0;         ///< of the reactions at prescribed displacements
  double residual_work = 0;        ///< of the forces that Newton's iteration left unbalanced
  double internal_work = 0;        ///< ∫ σ_{n+1} : Δε dV
  double dissipation = 0;          ///< Δt ∫ D_mech dV, viscous and plastic (2.113)
  double plastic_dissipation = 0;  ///< the plastic part of it (2.117)
  double plastic_work = 0;  ///< Δt ∫ s : ε̇^vp dV: plastic dissipation and energy stored by hardening
  double inelastic_entropy = 0;  ///< change of ∫ S^I dV (4.43b) [J/K]
  /// The least and the largest D_mech at any point and zero [W/m³]; the least is negative by rounding at
  /// most.
  double least_dissipation = 0, largest_dissipation = 0;
  double kinetic = 0;  ///< change of the kinetic energy
  /// Energy that the time integration of inertia dissipates, and work of the pressure of mixed elements on
  /// the volume of their sub-scales.
  double numerical = 0;
};

/// The deformation of a pass at the points, one per block of the mesh, null where there is none: what the
/// heat of deformation and the audit follow from (structural_heat.hpp). Later passes leave it as it is; while
/// it is kept, they take new storage. Valid until set_conditions().
using StepDeformation = std::vector<std::shared_ptr<const StructuralPoints>>;

/// Result of a pass, besides the state.
struct MechanicalReport {
  linear::NewtonReport newton;
  MechanicalWork work;
  std::vector<double> reactions;  ///< support forces [owned node][component] [N], zero where free
  std::vector<double> applied;    ///< forces of loads and contact [owned node][component] [N]
  ForcesAtWork at_work;           ///< those at the end of the pass, if it is asked for them
  StepDeformation deformation;
};

/// Input of one pass of the mechanical phase. The fields of an iterate belong to schemes that solve the phase
/// several times a step; empty, the pass is the first one.
struct MechanicalPass {
  double time = 0, dt = 0;              ///< t_{n+1} and the step [s]
  bool from_extrapolation = false;      ///< the old state is a combination of states (TimeStep::extrapolated)
  std::span<const double> temperature;  ///< Θ_n [K], [local node], ghosts up to date
  /// Temperatures of solid fraction and straining of phase changes [K], [local node], ghosts up to date.
  /// Empty: Θ_n (4.81); a scheme that iterates gives those of its iterate, so that it ends with Θ_{n+1}.
  std::span<const double> phase_temperature{};
  /// The bodies have been at these temperatures for long (a steady state): the solid fraction is theirs, not
  /// the mean of a step that leads to them.
  bool at_rest = false;
  /// heat::ThermalPhase::plateau_share at the moment of those temperatures, [local node], ghosts up to date:
  /// how much of an isothermal change is done at nodes that have its temperature. Empty: none of it, there is
  /// melt.
  std::span<const double> plateau_share{};
  /// Θ of the iterate: held in its place, or the one at which the entropy is held.
  std::span<const double> iterate_temperature{};
  /// Energy and entropy with which points begin besides those of the state at `temperature`; null: none.
  const StructuralLead* lead = nullptr;
  /// Displacement and history of the iterate: Newton's start, and whose entropy is held.
  const MechanicalState* iterate = nullptr;
  /// Times the stabilisation of contact that its tangents hold (contact::MechanicsTerm::Stabilisation).
  double contact_hold = 1;
  int newton_steps = 0;  ///< at most; the pass may end with them before equilibrium. Zero: until equilibrium
  /// The forces whose product with the increment is the work of the pass; null: those at its end. Both passes
  /// of a step in two halves work with the stress in the middle, which is in equilibrium
  /// (coupling/double_pass.hpp).
  const ForcesAtWork* at_work = nullptr;
  bool returns_at_work = false;  ///< the report is to have those at the end of this pass, for a later one
  /// Whether the stress at the points is to be written to MechanicalState::stress, as it is with inertia.
  bool stores_stress = false;
  std::span<const double> start{};  ///< of Newton's iteration, instead of the iterate's displacement
  /// Another start value, used if its residual is smaller.
  std::span<const double> guess{};
  std::span<const double> guessed_pressure{};  ///< that goes with it [Pa], [local node][field]
};

}  // namespace solidus::mechanics
