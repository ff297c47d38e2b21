/// Heat of deformation in the heat balance: structural heating and mechanical dissipation (monograph 2.123a,
/// 2.127b).
///
/// With S = −(W_Θ + M_Θ + K_Θ) the structural entropy and E = W + M + K + Θ S the structural energy per
/// volume (K: what hardening stores), the thermal phase (at the deformation that it is given) receives,
/// weighted with each node's basis function,
///
///   entropy form:  Θ_{n+1} [S(ε_{n+1}, Θ_{n+1}) − S(ε_n, Θ_n)]/Δt − D_mech          (4.43a, 4.48a)
///   energy form:   [E(ε_{n+1}, Θ_{n+1}) − E(ε_n, Θ_n) − σ_{n+1} : Δε]/Δt
///
/// and, after an isothermal mechanical phase only,
///
///   literal:       {Θ_{n+1} [S(ε_{n+1}, Θ_{n+1}) − S̄] + H^ep Δt}/Δt − D_mech,  S̄ = S(ε_{n+1}, Θ_n)
///   (4.48a, 4.50) temperature:   {(C − C_v) (Θ_{n+1} − Θ_n) + H^ep Δt}/Δt − D_mech,  C − C_v at t_{n+1}
///   (4.53a) H^ep Δt = Θ_{n+1} (∂S/∂ε^E : Δε^E + ∂S/∂ξ Δξ + ∂S/∂ζ : Δζ) at t_{n+1} (2.127b)
///
/// H^ep is first order: what it heats is second order away from the difference of entropies. 4.53a does not
/// see the jump of S where a table of the moduli or of the expansion bends.
///
/// σ, D_mech and the internal variables being those of the mechanical phase, isothermal or isentropic;
/// both including the capacity products of 2.127a. They differ at second order in the step; the energy form
/// closes the first law to the residuals. Solid fraction and straining of phase changes are held at their
/// values in the mechanical phase within a step (4.81). Where they are brought up to date, and with them the
/// lines of the tables, E_n and S_n stay those that the last step ended with: the energy of a transformation
/// free of stress is the latent heat, and the work p Δe^pc under stress is exchanged with the heat of the
/// point. (With the specific heat at constant strain E_n and S_n are evaluated again: the latent heat is then
/// that at fixed strain.) In the mushy zone the deviatoric elastic energy (s:s f_S/4G, about 1e-7 of the
/// latent heat) is left out.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linear/contribution.hpp"
#include "linear/lane_slots.hpp"
#include "mechanics/state/pass.hpp"
#include "mechanics/state/structural_change.hpp"
#include "mechanics/state/structural_lead.hpp"
#include "numbers/simd.hpp"

namespace solidus::mechanics {

class MechanicalPhase;

/// Adds to the thermal residual in watts (heat stored is positive). The tangent is that of the capacity of
/// the body, to which it is added: lumped to the diagonal where nodes store the heat, so that the thermal
/// matrix stays symmetric and of non-negative type, and ∫N_a N_b where Gauss points store it (open rule). C_v
/// is less than C_p: a lumped difference of the two, which at the corners of quadratic elements even has the
/// other sign, is as large as the small eigenvalues of a consistent capacity.
class StructuralHeat : public linear::Contribution {
 public:
  /// @param phase   must outlive this object; from now on its reports have the deformation, not before
  /// @param closed  the thermal phase stores heat by the closed rule; bodies with isothermal changes do
  ///                anyway
  StructuralHeat(const MechanicalPhase& phase, StructuralForm form, bool closed = true);

  ~StructuralHeat() override;

  /// The deformation whose heat is added from here on, in one stage that is as long as its pass until
  /// begin_stage() says otherwise.
  void set_deformation(StepDeformation deformation);
  /// No deformation from here on, and no heat of it: a mechanical pass that follows may take the storage.
  void release() { set_deformation({}); }

  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix&) override { slots_.clear(); }
  void add_residual(std::span<const double> temperature, std::span<double> r) override;
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) override;
  bool stores() const override { return true; }
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> temperature) override;
  /// The tangent is another's affair: the simultaneous scheme has the exact one (coupled_kernel.hpp).
  void leave_tangent() { has_tangent_ = false; }
  StructuralForm form() const { return form_; }

 private:
  struct Stages;

  const MechanicalPhase& phase_;
  StructuralForm form_;
  std::vector<char> at_nodes_;  ///< whether the nodes store the heat of a block, [block]
  bool has_tangent_ = true;
  StepDeformation deformation_;
  std::unique_ptr<Stages> stages_;                       ///< [block]
  std::vector<double> work_;                             ///< [local node]; ghost rows are scrap
  std::vector<std::optional<linear::LaneSlots>> slots_;  ///< of the blocks that need them; empty: none yet
};

/// What a held deformation expects to take up as it expands, at the temperature to which heat has brought it
/// (MechanicalPhase::held_deformation).
StructuralLead expected_expansion(const StepDeformation& held, std::span<const double> temperature);

/// The change over a step, with the temperature at its end [local node]; over all processes. Collective.
StructuralChange structural_change(const StepDeformation& deformation, std::span<const double> temperature);
/// The change up to the end of the mechanical pass, where points have temperatures of their own
/// (StructuralPoints::mechanical_change). Collective.
StructuralChange mechanical_change(const StepDeformation& deformation);
/// The work of the stresses at the end of a mechanical pass (backward Euler) beyond that of the stresses on
/// the way there,
///
///   ∫ [σ_{n+1} : Δε − ΔE + ∫Θ dS − D_mech Δt] dV,   ∫Θ dS = ½ (Θ_n + Θ_{n+1}) ΔS
///
/// [J]: ½ Δσ : Δε along a straight elastic path, of first order over a run. The temperatures are those of the
/// pass: Θ_{n+1} = Θ_n in an isothermal one, and Θ̄ in an isentropic one, where the entropy term is what the
/// sensible heat of the points takes. p Δe^pc is in it, the work of a phase change against the pressure.
/// Collective.
double excess_work(const StepDeformation& deformation);
/// The structural energy E of a state, computed from its fields [J]: free of stress and without hardening it
/// is zero at constant pressure. Of a phase with structural heat; the phase takes the state's deformation as
/// MechanicalPhase::held_deformation does. Collective.
double structural_energy(MechanicalPhase& phase, const MechanicalState& state,
                         std::span<const double> temperature, std::span<const double> plateau_share);

}  // namespace solidus::mechanics
