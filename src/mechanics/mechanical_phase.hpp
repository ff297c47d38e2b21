/// The mechanical phase: equilibrium, or the balance of momentum, at t_{n+1} with the temperature held
/// (monograph 4.46, 6.25), or with the entropy of every quadrature point held (4.40).
///
///   r(u) = ∫ B̄ᵀ σ dV − f(t) + contributions + inertia = 0
///
/// Where elements are mixed the nodal pressure is an unknown in addition to the displacement, and its
/// equation a residual in addition to that of the forces (nodal_pressure.hpp).
///
/// Newton's criterion measures the residual against the forces that the bodies exchange with the world
/// (loads, supports, contact, inertia), or a millionth of the internal forces where there are none. In
/// time backward Euler, or the two-step method (material/time_integration.hpp). The strain is small, so
/// geometry, sparsity and the map from element entries to matrix slots are computed once, in the constructor.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linear/contribution.hpp"
#include "linear/newton.hpp"
#include "material/material.hpp"
#include "material/melt.hpp"
#include "material/time_integration.hpp"
#include "mechanics/elements/simplices.hpp"
#include "mechanics/loads/inertial_forces.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mechanics/solver/balance.hpp"
#include "mechanics/state/mechanical_state.hpp"
#include "mechanics/state/pass.hpp"
#include "mechanics/state/phase_fields.hpp"
#include "mesh/mesh.hpp"
#include "numbers/types.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

class BlockKernel;
class Loads;
class NodalPressure;
class SaddleSolver;
class StructuralPoints;
struct BlockWork;
struct FlowChange;
struct LawFailure;

enum class TimeIntegration { backward_euler, two_step };

struct MechanicsOptions {
  linear::NewtonOptions newton;
  /// Constant volumetric mode (Q1/P0, 6.2) in 4-node quads and 8-node hexes; other shapes use the standard
  /// operator.
  bool b_bar = true;
  Simplices simplices = Simplices::automatic;
  Stabilisation stabilisation = Stabilisation::automatic;
  TimeIntegration integration = TimeIntegration::backward_euler;
  Mapping mapping = Mapping::isothermal;
  linear::SolverKind solver = linear::SolverKind::automatic;
  double linear_tolerance = 1e-8;  ///< iterative solvers, relative
  /// False when a contribution's tangent is not symmetric (friction); a law's is found by itself
  /// (Armstrong–Frederick).
  bool symmetric = true;
  std::optional<DynamicsOptions> dynamics;  ///< absent: no inertia
  /// Stress of each block at the start, [block][element][6]: xx, yy, zz, xy, yz, xz [Pa]. A block without any
  /// has an empty list; all empty: no stress. Solid metal of the built-in laws, in quasi-statics.
  std::vector<std::vector<double>> initial_stress = {};
};

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
  ~MechanicalPhase();

  int components() const { return components_; }
  AnalysisKind kind() const { return kind_; }
  const material::Material& material(int body) const { return materials_[static_cast<std::size_t>(body)]; }
  Mapping mapping() const { return options_.mapping; }
  const MechanicsOptions& options() const { return options_; }
  /// From here on other conditions hold; the state goes on as it is. Not between the passes of a step. A
  /// matrix of this phase that others refer to may be made again (coupling/scheme.hpp). The stress of bodies
  /// that have gone is gone with the next step, in which what they held springs back; quasi-statics only.
  /// Collective.
  /// @param start  displacement that relative supports count from, [local node][component]; empty: zero
  /// Throws InputError as the constructor does, and std::invalid_argument for a body that comes back.
  void set_conditions(MechanicalConditions conditions, std::span<const double> start);
  /// Bodies and nodes that are active in the present stage.
  const linear::ActiveSet& active() const { return active_; }
  /// Zero displacement, no inelastic strain. With inertia at t = 0: the velocities of the bodies and of the
  /// prescribed displacements, and the accelerations that the loads of that time cause. Collective.
  MechanicalState initial_state();
  /// Whether the bodies have inertia.
  bool dynamic() const { return inertia_ != nullptr; }
  /// The share of t_{n+1} in the mean of the forces that a step works with in the balance of momentum.
  double force_share() const { return inertia_ ? inertia_->motion().force_share() : 1.0; }
  /// The share of t_{n+1} in the mean of the forces whose work a step does (Motion::work_share).
  double work_share() const { return inertia_ ? inertia_->motion().work_share : 1.0; }

  /// Solves for t_{n+1} from the state at t_n. `trial` is written only on success; it may be the iterate.
  /// Throws EquilibriumRejected (on all processes) when Newton's iteration fails; the place is the element
  /// whose law found no state, with its inputs, or the node of the largest residual.
  MechanicalReport solve(const MechanicalState& old, MechanicalState& trial, const MechanicalPass& pass);
  /// The first pass.
  MechanicalReport solve(const MechanicalState& old, MechanicalState& trial,
                         std::span<const double> temperature, double time, double dt) {
    return solve(old, trial, {.time = time, .dt = dt, .temperature = temperature});
  }

  /// The return mapping of the thermal phase (4.45, 4.49, 4.54): finds the flow of solid metal again at the
  /// temperatures of the step's end, from the internal variables at t_n, at the strain that solve() has
  /// found. Melt and mush keep the flow of that solve, of whose stress the work also stays; may be repeated.
  /// Throws StepRejected on all processes where a law finds no state. Collective.
  /// @param old, pass    those of the solve
  /// @param temperature  Θ_{n+1} [K], [local node], ghosts up to date
  /// @param trial        the state that the solve has found; its history and fields of elements are replaced
  /// @param deformation  that of the solve; replaced
  /// @return differences to the mechanical phase, over all processes
  FlowChange restart_flow(const MechanicalState& old, const MechanicalPass& pass,
                          std::span<const double> temperature, MechanicalState& trial,
                          StepDeformation& deformation);

  /// The deformation of bodies that stay as they are in `state`, for a thermal phase of its own.
  /// @param expands  they store the heat that free expansion would take up
  ///                 (StructuralPoints::expect_expansion)
  StepDeformation held_deformation(const MechanicalState& state, std::span<const double> temperature,
                                   std::span<const double> plateau_share = {}, bool expands = false);

  // The pieces of solve(), for an iteration that has further unknowns (coupling/simultaneous.hpp).
  /// Loads, state at t_n and properties at the temperature of the pass; `old` must live until conclude().
  void begin(const MechanicalState& old, const MechanicalPass& pass);
  /// Newton's start, with the prescribed displacements at the end of the pass: displacements [local
  /// node][component] and, where elements are mixed, pressures in their unit [local node][field].
  std::vector<double> start(const MechanicalState& old, const MechanicalPass& pass) const;
  /// Entries of the displacement in these unknowns, ghosts included.
  std::size_t n_displacements() const { return mesh_.x.size() * static_cast<std::size_t>(components_); }
  /// Residuals of the unknowns, which are on owned nodes.
  std::size_t n_residuals() const;
  /// The properties at another temperature of the iterate, after begin().
  void prepare(const MechanicalState& old, const MechanicalPass& pass);
  /// As linear::NonlinearSystem has them.
  double residual(std::span<const double> x, std::span<double> r);
  linear::BlockMatrix& tangent(std::span<const double> x);
  /// Size of a step relative to the displacement since t_n: BodyBalance::relative_step, of the unknowns x and
  /// of the step d that has led to them.
  double relative_step(const MechanicalState& old, std::span<const double> x,
                       std::span<const double> d) const;
  /// The matrix of the tangent, with its fixed degrees of freedom and multi-point constraints.
  linear::BlockMatrix& matrix() { return *matrix_; }
  /// Writes the history at x.
  /// @param stress    at the points at x, of the right size; null: not asked for
  /// @param at_work   of every block; null: not asked for
  /// @param elements  MechanicalState::elements; null: not asked for
  /// @param deformation  at x; null: not asked for
  BlockWork finish(const MechanicalState& old, std::span<const double> x, std::vector<BlockHistory>& history,
                   std::vector<BlockHistory>* stress = nullptr, std::vector<StressAtWork>* at_work = nullptr,
                   std::vector<SharedElementValues>* elements = nullptr,
                   StepDeformation* deformation = nullptr);
  /// finish() at the solution; the state and the report that follow from it, the latter without that of
  /// Newton's iteration.
  MechanicalReport conclude(const MechanicalState& old, const MechanicalPass& pass, std::vector<double> x,
                            MechanicalState& trial);
  /// Throws EquilibriumRejected on all processes, with the place that says most.
  /// @param failure  unless a law finds no state at x
  [[noreturn]] void reject(const std::string& reason, std::span<const double> x,
                           Failure failure = Failure::equilibrium);
  /// The nodal pressure and the solver with its matrix, which are made again with the conditions; null where
  /// no element is mixed.
  NodalPressure* pressure() { return pressure_.get(); }
  SaddleSolver* saddle() { return saddle_solver_; }
  /// A residual that is rounding [N].
  double round_off() const { return round_off_; }

  /// The solid fractions that the law works with in a pass, means of both ends of the step, [local
  /// node][field of the body], ghosts up to date; empty where nothing melts.
  std::vector<double> mean_solid_fraction(const MechanicalState& old, const MechanicalPass& pass) const;
  /// Those of a moment, of the same layout.
  std::vector<double> solid_fraction(std::span<const double> temperature,
                                     std::span<const double> plateau_share) const {
    return nodal_phases_.solid_fraction({temperature, plateau_share});
  }
  const NodalPhases& nodal_phases() const { return nodal_phases_; }

  /// True when a material can flow plastically: then there are plastic fields to show.
  bool plastic() const { return plastic_; }
  /// Fixed degrees of freedom, and multi-point constraints (Loads).
  const std::vector<char>& fixed() const { return matrix_->fixed(); }
  const linear::MultiPointConstraints& constraints() const { return matrix_->constraints(); }

  /// The block kernels, for StructuralHeat.
  std::span<const std::unique_ptr<BlockKernel>> blocks() const { return blocks_; }
  /// Stiffness of the melt of every body whose material does not give its viscosity, [body].
  std::span<const material::MeltModulus> melt() const { return melt_; }
  /// Drops what the linear solver carried over from earlier steps.
  void forget() { solver_->forget(); }
  const mesh::Mesh& mesh() const { return mesh_; }
  std::size_t bytes() const;
  double seconds_assembly() const { return seconds_assembly_; }  ///< tangents
  double seconds_residual() const { return seconds_residual_; }  ///< forces and the constitutive update
  double seconds_solver() const;

 private:
  linear::NodeGraph graph() const;
  void create_blocks(const std::vector<material::Material>& materials);
  std::unique_ptr<BlockKernel> make_block(std::size_t block);
  std::vector<double> initial_pressure();
  void remove_bodies(const linear::ActiveSet& active);
  /// Mass of the active bodies.
  std::vector<double> nodal_mass() const;
  void find_weight(const std::array<double, 3>& gravity);
  void create_matrix();
  void bind();
  void create_solver();
  void create_pressure();
  void set_body_force(double time);
  /// Entries of the displacement in the residuals, which are on owned nodes.
  std::size_t n_forces() const {
    return static_cast<std::size_t>(mesh_.n_owned_nodes) * static_cast<std::size_t>(components_);
  }
  std::size_t n_unknowns() const;
  void set_in_motion(MechanicalState& state);
  void add_residual_to_balance(std::span<const double> r);
  /// ‖r(x)‖ of the free unknowns: without prescribed ones, and with constraints summed.
  double unbalanced(std::span<const double> x);
  /// Tries the guess of the pass: takes it as the start if it is nearer to equilibrium. Returns whether it
  /// did.
  bool try_guess(const MechanicalPass& pass, std::vector<double>& x);
  LawFailure law_failure(std::span<const double> x) const;
  std::vector<double> flowing_shares(std::span<const double> x) const;
  std::string worst_place(std::span<const double> x);
  material::TimeStep time_step(const MechanicalState& old, const MechanicalPass& pass) const;
  static FractionPlace fraction_place(const MechanicalPass& pass) {
    return {pass.phase_temperature.empty() ? pass.temperature : pass.phase_temperature, pass.plateau_share};
  }
  static std::span<const double> fractions_before(const MechanicalState& old, const MechanicalPass& pass) {
    return pass.at_rest ? std::span<const double>{} : std::span<const double>(old.solid_fraction);
  }
  MechanicalReport measure(const MechanicalState& old, const MechanicalPass& pass, std::span<const double> x,
                           const BlockWork& sums, MechanicalState& next);

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  const std::vector<material::Material>& materials_;
  int components_;
  MechanicsOptions options_;
  std::vector<linear::Contribution*> contributions_;
  linear::ActiveSet active_;
  bool plastic_ = false;
  std::vector<std::unique_ptr<BlockKernel>> blocks_;
  std::unique_ptr<Loads> loads_;
  std::vector<double> weight_;               ///< of the bodies, [local node][component] [N]
  std::vector<material::MeltModulus> melt_;  ///< [body]
  std::unique_ptr<linear::BlockMatrix> matrix_;
  std::unique_ptr<NodalPressure> pressure_;  ///< null without mixed elements
  std::vector<int> fields_;                  ///< of Newton's iteration: components of each
  std::unique_ptr<linear::TangentSolver> solver_;
  SaddleSolver* saddle_solver_ = nullptr;    ///< the same where elements are mixed
  std::unique_ptr<InertialForces> inertia_;  ///< null in quasi-statics
  parallel::GhostExchange ghosts_;
  BodyBalance balance_;
  std::vector<double> initial_temperature_;
  NodalPhases nodal_phases_;
  std::vector<BlockHistory> start_;  ///< z* of the two-step method, one per block
  double round_off_ = 0;             ///< residual that is rounding [N]
  std::vector<double> x_;            ///< unknowns of the last residual
  std::vector<double> residual_;     ///< there
  bool residual_is_known_ = false;   ///< for the arguments of the last prepare()
  std::vector<double> forces_;       ///< internal forces, [local node][component]; ghost rows are scrap
  std::vector<double> external_;     ///< loads at t_{n+1}, [owned node][component]
  std::vector<double> inertial_;     ///< J at the last residual, [owned node][component]; with inertia
  double seconds_assembly_ = 0, seconds_residual_ = 0;
  double seconds_before_ = 0;  ///< of solvers that others have replaced
};

}  // namespace solidus::mechanics
