/// The nonlinear thermal phase: temperature and latent heat at t_{n+1} with the configuration held
/// (monograph 2.123a, 2.150, 4.149, 6.3).
///
///   (H(Θ_{n+1}) − H(Θ_n))/Δt + conduction − surfaces − sources + contributions = 0
///
/// Heat is stored as an exact enthalpy difference, so the residual at convergence is the only defect of the
/// heat balance. In time backward Euler, or SDIRK2 of Alexander (1977), of second order and L-stable: two
/// such solves over γ Δt,
///
///   H¹ = H_n + γ Δt f(t_n + γ Δt, H¹),   H_{n+1} = H* + γ Δt f(t_{n+1}, H_{n+1}),   γ = 1 − 1/√2
///   H* = H_n + (1 − γ)/γ (H¹ − H_n) = H_n + (1 − γ) Δt f(t_n + γ Δt, H¹)
///
/// so plateaus and both rules are as with backward Euler, and the heat of the step is
/// Δt [(1 − γ) f¹ + γ f_{n+1}]. Contributions that store follow by linear::RungeKuttaStage.
///
/// H* is an extrapolation. Where with the closed rule a node's Θ(H*) leaves the range of the temperatures at
/// t_n and around, or where it makes heat flow back next to nodes that have frozen or melted in the step
/// (extrapolation_guard.hpp), the second stage is backward Euler over (1 − γ) Δt from H¹ instead: the step is
/// then of first order, balanced as exactly, and no temperature leaves that range (docs/decisions/0016).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "heat/loads/thermal_conditions.hpp"
#include "heat/loads/thermal_state.hpp"
#include "heat/loads/time_error.hpp"
#include "heat/storage/sensible_form.hpp"
#include "heat/thermal_states.hpp"
#include "linear/active_set.hpp"
#include "linear/contribution.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "numbers/load_window.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

class NodalEnthalpy;
class ThermalIteration;
struct ThermalParts;

enum class HeatIntegration {
  closed,  ///< heat content at the nodes, conduction of quads and hexes too: no over- or undershoot
  /// Heat content at Gauss points; at the nodes of bodies whose material has an isothermal change, because a
  /// temperature at a point does not tell how much of it is solid.
  open
};

enum class ThermalStepping { backward_euler, sdirk2 };

/// Default tolerances. Nodes that hold heat take up the residual of the iteration (ThermalPhase::book), so
/// that theirs is one of accuracy; in the open rule and in a steady state the residual is heat lost or gained
/// (docs/decisions/0013).
inline constexpr double k_nodal_tolerance = 1e-6, k_point_tolerance = 1e-9;

struct HeatOptions {
  HeatIntegration integration = HeatIntegration::closed;
  int open_degree = 0;  ///< polynomial degree of the open rule; 0: by element
  /// Tolerance of the sum of the nodal residuals, as a share of the heat moved in the step; zero:
  /// k_nodal_tolerance where the nodes hold the heat, else k_point_tolerance.
  double tolerance = 0;
  int max_iterations = 50;
  linear::SolverKind solver = linear::SolverKind::automatic;
  double linear_tolerance = 1e-11;  ///< iterative solvers, relative
  /// Limits conduction where the mesh would let temperatures leave the range of those around them
  /// (conduction_limiter.hpp); closed rule only.
  bool bounds = true;
  /// Corrects conduction of linear simplices next to re-entrant edges (edge_conduction.hpp).
  bool edges = true;
  bool symmetric = true;  ///< false when a contribution's tangent is not
  /// No scheme makes its tangent part of a larger, unsymmetric one: half of a symmetric matrix will do.
  bool alone = false;
  /// Time stepping of schemes that solve the phase once a step; absent: backward Euler.
  std::optional<ThermalStepping> stepping;
  /// All forms but the enthalpy lose heat and need backward Euler; the lost heat is in the balance as its
  /// defect.
  SensibleForm sensible = SensibleForm::enthalpy;
};

/// Where metal is, after some of it has moved.
struct MovedMetal {
  std::span<const char> moves;     ///< [body]: whether its metal moves
  std::span<const double> held;    ///< metal over that which was poured, [owned node]; one: none has moved
  std::span<const double> filled;  ///< share of the room that is not emptied, [local node], ghosts up to date
};

/// Heat of bodies that leave and of bodies that come at a change of conditions, counted from 20 °C [J].
struct CarriedHeat {
  double away = 0, along = 0;
};

/// Input of one pass of the thermal phase. The further fields belong to schemes that solve the phase several
/// times a step; empty, the pass is the first one.
struct ThermalPass {
  double time = 0, dt = 0;                ///< t_{n+1} and the step [s]
  const ThermalState* iterate = nullptr;  ///< Newton's start; absent: the state at t_n
  int newton_steps = 0;  ///< at most; the pass may end with them before its tolerance. Zero: until then
  ThermalStepping stepping = ThermalStepping::backward_euler;
  /// Nothing flows: temperatures follow what the contributions that store take up (coupling/double_pass.hpp).
  bool adiabatic = false;
  /// With two stages: where the extrapolation between them overshoots, the step is of first order
  /// (extrapolation_guard.hpp; closed rule).
  bool within_range = true;
  /// Conduction is limited as the pass before has left it, unless a temperature leaves the range. The limits
  /// of a pass follow from its start, and change from pass to pass as long as an iteration between the phases
  /// goes round; a pass of backward Euler in the same step comes before.
  bool keeps_limits = false;
  /// The part of the step over which loads are averaged in one stage; absent: the whole step, or its parts
  /// where the phase takes two stages.
  std::optional<LoadWindow> loads = {};

  LoadWindow window() const { return loads.value_or(LoadWindow::backward_euler(time - dt, time)); }
};

class ThermalPhase {
 public:
  /// @param materials      one per body of the mesh; copied
  /// @param contributions  further terms in the temperature (heat through contact, structural heating); must
  ///                       outlive the phase
  /// Throws InputError for a condition that names no group of the mesh.
  ThermalPhase(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
               const ThermalConditions& conditions, HeatOptions options = {},
               std::vector<linear::Contribution*> contributions = {});
  ~ThermalPhase();

  /// From here on other conditions hold; the state goes on as it is, but for the heat of bodies that leave or
  /// come back. Not between the passes of a step. Throws InputError as the constructor does,
  /// std::invalid_argument for a body that comes back where its heat is not given. Collective.
  /// @param state  loses what bodies that leave carry away, and gets what bodies that come bring along; null
  ///               where it has been changed before
  /// @param fresh  h(node, body) [J/m³] of bodies that come back, as of initial_state_of()
  CarriedHeat set_conditions(const ThermalConditions& conditions, ThermalState* state = nullptr,
                             const std::function<double(Index node, int body)>& fresh = {});
  /// The mesh has got elements that were not there before: all that is made of it is made again. With the
  /// closed rule and enthalpies alone; std::invalid_argument otherwise. Collective.
  /// @param state  gets the heat of what is new; null where it has it already
  /// @param fresh  h(node, body) [J/m³] of what is new, as of initial_state_of()
  /// Returns that heat, counted from 20 °C [J].
  double grow(const ThermalConditions& conditions, const std::function<double(Index node, int body)>& fresh,
              ThermalState* state);
  /// Metal has moved between nodes and takes its heat along: nodes that have lost metal keep their
  /// temperature, those that have got some get the mean heat of what moved, all of it together. Emptied
  /// places conduct, and store next to nothing, as gas (docs/decisions/0093). With the closed rule and
  /// enthalpies, without bodies that come or leave. Collective.
  /// @param state  gets the heat; null: it has it already
  void move_metal(const MovedMetal& metal, ThermalState* state);

  /// Solves for t_{n+1} from the state at t_n. `trial` is written only on success; it may be `old` or the
  /// iterate. Prescribed temperatures hold at t_{n+1}; at the temperature of an isothermal change such a node
  /// keeps as much of its old heat as that temperature allows. Throws StepRejected (on all processes) when
  /// the iteration fails; the place is the node of the largest residual. The same where a temperature is not
  /// above 0 K; the place is the coldest node.
  ThermalReport solve(const ThermalState& old, ThermalState& trial, const ThermalPass& pass);
  /// The first pass.
  ThermalReport solve(const ThermalState& old, ThermalState& trial, double time, double dt) {
    return solve(old, trial, {.time = time, .dt = dt});
  }
  /// The steady state for the conditions at `time`, started from `start`; balance in watts. Something must
  /// hold the temperature of every body (prescribed, film, radiation, contact).
  ThermalReport solve_steady(const ThermalState& start, ThermalState& trial, double time);

  const mesh::Mesh& mesh() const;
  /// How states begin, and what they tell.
  const ThermalStates& states() const { return states_; }
  /// The parts of the phase.
  ThermalParts& parts() const { return *parts_; }
  /// Heat content of the nodes; with the open rule too, of bodies that store at Gauss points for what it says
  /// of fractions and volumes.
  const NodalEnthalpy& storage() const;

 private:
  friend class ThermalIteration;
  friend class StepSensitivity;
  /// Throws StepRejected like require() unless `newton_steps` limits the iteration.
  /// @param residual  at the solution, [owned node] [W]
  linear::NewtonReport solve_temperature(std::span<double> temperature, std::span<double> residual,
                                         int newton_steps = 0);
  /// Heat through conditions and contributions.
  /// @param residual  at the solution, [owned node] [W]: where the temperature is prescribed, what holds it
  HeatBalance measure(std::span<const double> temperature, std::span<const double> residual, double dt) const;
  ThermalReport solve_stage(const ThermalState& old, const ThermalState& before,
                            const linear::RungeKuttaStage& stage, const ThermalPass& pass,
                            ThermalState& next);
  std::vector<double> solve_balance(const std::vector<double>& from, double dt, const ThermalState& before,
                                    const ThermalState& old, const ThermalPass& pass, ThermalState& next,
                                    ThermalReport& report);
  linear::NewtonReport solve_steady_balance(std::span<double> temperature, std::span<double> residual);
  [[noreturn]] void reject_exchange(double tolerance, double tolerance_of_fluid);
  std::vector<ChannelReading> channel_readings(double dt) const;
  void book_exchange(std::span<const double> changed, double dt, std::span<double> heat,
                     std::span<double> residual) const;
  ThermalReport solve_two_stages(const ThermalState& old, const ThermalPass& pass, ThermalState& next);
  void start_from(std::span<const double> heat, ThermalState& next) const;
  static ThermalState stage_start(const ThermalState& old, const ThermalState& before,
                                  const linear::RungeKuttaStage& stage);
  /// Into the nodes in a stage that has just been solved, from H* of `from`: for StageFlows.
  std::vector<double> flow(const ThermalState& from, const ThermalState& next,
                           const linear::RungeKuttaStage& stage) const;
  /// Tells the contributions that store.
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before);
  ConductionBounds limit_conduction(const ThermalState& before, const ThermalState& old, bool keep = false);
  void set_latent(HeatBalance& balance, const ThermalState& old, const ThermalState& next) const;
  /// Measures a solved step, whose last residual is given.
  HeatBalance balance(const ThermalState& old, const ThermalState& next, std::span<const double> residual,
                      double moved, double dt) const;
  /// Adds the residual of the iteration, F of the free nodes, to their heats: H_i = H*_i − Δt r_i then holds
  /// to rounding, and the heat balance is exact for every tolerance. The temperatures stay those for which
  /// the fluxes r are; the next step begins from these heats. Updates the ghosts.
  void book(std::span<const double> residual, double dt, std::span<double> heat) const;
  /// The start of a step: prescribed temperatures hold, and heats are those of their temperatures.
  /// @param all  false: of the prescribed ones alone
  ThermalState start(const ThermalState& old, const LoadWindow& loads, bool all = true);
  /// A pass of so many Newton steps has taken them.
  static bool may_end(const linear::NewtonReport& report, int newton_steps) {
    return newton_steps > 0 && report.out_of_iterations;
  }
  double take_out(const linear::ActiveSet& active, ThermalState& state) const;
  double put_in(const linear::ActiveSet& before, const std::function<double(Index, int)>& fresh,
                ThermalState& state) const;
  void change_bodies(const linear::ActiveSet& before);
  std::vector<double> at_least_gas(const MovedMetal& metal) const;
  bool carry_heat(std::span<const char> moves, std::span<const double> held, ThermalState& state) const;
  void share_conduction(const MovedMetal& metal);
  /// Throws StepRejected on all processes unless the report is of a converged iteration.
  void require(const linear::NewtonReport& report, std::span<const double> residual,
               std::span<const double> temperature) const;
  /// Throws StepRejected on all processes where a temperature is not above zero.
  void require_positive(std::span<const double> temperature) const;

  std::unique_ptr<ThermalParts> parts_;
  ThermalStates states_;
};

/// HeatOptions::stepping.
ThermalStepping stepping(const ThermalPhase& phase);
/// Bodies and nodes that are active in the present stage.
const linear::ActiveSet& active(const ThermalPhase& phase);
/// The longest time from `from` on, up to `to`, after which every load that moves overlaps with three
/// fifths of itself (placed_load.hpp); infinite where none moves that far. Collective.
double lasting_loads(const ThermalPhase& phase, double from, double to);
/// Gives bodies that burn the power of the step that begins (heat/loads/exothermic.hpp), constant in all
/// its passes.
/// @param state  at the start of the step; empty: nothing burns
void begin_burning(ThermalPhase& phase, const BurningState& state, double begin, double end);
/// The burning state at the end of that step, from the temperatures at its ends; empty if `state` is.
BurningState burnt(const ThermalPhase& phase, const BurningState& state, const ThermalState& before,
                   const ThermalState& after, double begin, double end);
/// The temperatures around the bodies at a time, prescribed, of films and of radiation, beyond which
/// nothing is heated or cooled; without end where fluxes, sources or contributions can. Collective.
/// @param with_contributions  false: the caller knows whether contributions heat
TemperatureRange ambient_range(const ThermalPhase& phase, double time, bool with_contributions = true);
/// The same with contributions that heat, whose nodes count with these temperatures, [local node]: friction
/// makes nothing hotter than what rubs. Collective.
TemperatureRange range_around(const ThermalPhase& phase, double time, std::span<const double> temperature);
/// The flow into the nodes at the end of a step, from its known flows, [local node], ghosts up to date [W]:
/// what time_error() of the next step asks for. Collective.
std::vector<double> flow_at_end(const ThermalPhase& phase, const StageFlows& flows);
/// The error in time of the step that ended in `now`, whose flows must be known: the heat of
/// heat::time_error(), spread for as long as its last stage is, through contributions as they are.
/// [local node] [K]. Collective.
/// @param flow_before  flow_at_end() of the step before
std::vector<double> time_error(ThermalPhase& phase, const ThermalState& now, const StageFlows& flows,
                               std::span<const double> flow_before);
/// (H_b − H_a)/C, without latent heat in C: what the change of heat comes to in kelvin, [local node],
/// ghosts up to date. Where nodes hold the heat. Collective.
std::vector<double> change_in_kelvin(const ThermalPhase& phase, const ThermalState& a, const ThermalState& b);
/// Drops what the linear solver carried over from earlier steps.
void forget(ThermalPhase& phase);
/// Memory of the phase.
std::size_t bytes(const ThermalPhase& phase);

}  // namespace solidus::heat
