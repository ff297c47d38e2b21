/// Interface by which a running simulation reports to the parts that write results or show progress.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/pair.hpp"
#include "coupling/restart_data.hpp"
#include "heat/loads/thermal_state.hpp"
#include "heat/loads/time_error.hpp"

namespace solidus::coupling {

struct State;

/// Effort of one phase in a step: iterations, residual and time.
struct PhaseEffort {
  int iterations = 0;         ///< Newton iterations (linear solves)
  int linear_iterations = 0;  ///< iterations of the linear solver, summed
  double residual = 0;        ///< final relative residual
  double seconds = 0;
  int hardest = 0;  ///< as `iterations`, of two stages of a pass only the harder one; zero: not counted apart
  /// Difficulty of the step, which the size of the next one depends on.
  int hard() const { return hardest > 0 ? hardest : iterations; }
};

/// The first law over one step, in joules (whole body; axisymmetric: the full revolution), and where
/// mechanical work goes.
struct EnergyAudit {
  double stored_heat = 0;  ///< change of sensible and latent heat
  double structural = 0;   ///< change of the structural energy W + M + Θ S
  double contact =
      0;  ///< change of the energy in contact penalties, and of the energy stored by friction's hardening
  double kinetic = 0;         ///< change of the kinetic energy
  double friction = 0;        ///< dissipation by friction
  double numerical = 0;       ///< dissipation by the time integration of inertia and of contact penalties
  double work = 0;            ///< work of loads and supports on the bodies
  double unbalanced = 0;      ///< work of the forces that Newton's iteration left, a part of the defect
  double heat_in = 0;         ///< through boundaries and from sources
  double to_channels = 0;     ///< taken up by the fluids of channels, which heat_in counts as heat that left
  double entropy_in = 0;      ///< that came with it, at the temperatures of the bodies there [J/K]
  double heat_exchanged = 0;  ///< reference of the defect: the sum of magnitudes of heat moved in the step
  double viscous_dissipation = 0;  ///< heat of the flowing melt (2.114)
  double plastic_dissipation = 0;  ///< heat of plastic flow (2.117)
  double plastic_work = 0;         ///< work of the deviator on plastic flow
  BodyHeat bodies;                 ///< of bodies that came and left before the step, no part of the defect
  double inelastic_entropy = 0;    ///< change of the entropy S^I of plastic flow (4.43b) [J/K]
  /// Internal energy of the first state of the run and of the present one less that, each computed from the
  /// fields of its moment (internal_energy.hpp); of a run, not of a step.
  double internal_at_start = 0, internal = 0;
  double hardening() const { return plastic_work - plastic_dissipation; }  ///< stored by plastic flow
  double frictional_heat = 0;  ///< heat of friction that the thermal phase took up
  /// Work of the stresses of the ends of steps beyond that of the stresses between them
  /// (mechanics::excess_work). Zero in schemes of second order, whose excess is of second order too.
  double excess_work = 0;
  contact::InterfaceSums interface;  ///< of the last thermal pass; sums of a step, not of a run
  double defect() const {
    return stored_heat + structural + contact + kinetic + numerical + friction - frictional_heat - work -
           heat_in;
  }
  /// The same of a run, of which energies at its two ends alone are known.
  double state_defect() const {
    return internal - bodies.energy + kinetic + numerical + friction - frictional_heat - work - heat_in;
  }
  /// The same of two steps in a row.
  EnergyAudit& operator+=(const EnergyAudit& next);
  /// Adds the energies of the first of two stages whose second one begins with the share `carried` of the
  /// change in the first (SDIRK2): of what flows and of the heat of the interfaces. Changes of stored
  /// energies are those of the whole step as they are.
  void add_first_stage(const EnergyAudit& first, double carried);
};

/// The a-priori stability functional 𝓛 of 2.24 (with contact 3.69) over one step, and what it is made of
/// [J].
struct StabilityAudit {
  double mechanical = 0, thermal = 0;  ///< increments of 𝓛 over the two phases (4.34, 4.39)
  double entropy = 0;                  ///< change of S^E + S^pc, and of S^e_c at interfaces [J/K]
  double frictional_entropy = 0;       ///< change of S^p_c, which 𝓛 does not hold [J/K]
  double tolerance = 0;                ///< growth that residuals and rounding explain
  double increment() const { return mechanical + thermal; }
  StabilityAudit& operator+=(const StabilityAudit& next);
};

struct ContactSummary {
  int closed_points = 0, points = 0;
  double heat = 0;   ///< from slave to master by conduction and radiation [W]
  double force = 0;  ///< resultant normal force [N]
  int sticking_points = 0;
  double friction = 0;                           ///< ∫ ‖T‖ dA [N]
  std::array<double, 3> resultant = {};          ///< force on the master [N]
  std::array<double, 3> moment = {};             ///< of it about the origin [N m]
  double dissipation = 0;                        ///< of friction, since the start [J]
  double heat_to_slave = 0, heat_to_master = 0;  ///< in all, that of friction included [W]
  double wet_area = 0;                           ///< of points that liquid metal wets [m²]
  /// The part of the liquid skin that has left its wall (contact::ContactParameters::leaving_gap): area [m²],
  /// largest gap [m].
  double left_area = 0, left_gap = 0;
  double left_penetration = 0;  ///< contact::Augmentations::left_penetration
};

/// Report of a scheme on a step that it took.
struct StepEffort {
  PhaseEffort heat, mechanics;
  int coupling_iterations = 1;  ///< solutions of both phases until they agreed
  EnergyAudit energy;
  StabilityAudit stability;
  std::vector<ContactSummary> contacts;
  /// Heat by each thermal condition [J], several of one name one after the other, and the time in which it
  /// came [s].
  std::vector<heat::ConditionHeat> conditions;
  double conditions_time = 0;
  /// The fluids of the cooling channels: heat of the step, all else at its end.
  std::vector<heat::ChannelReading> channels;
  /// The power of the conditions of a name, their mean over the step [W].
  double power_of(const std::string& condition) const;
  /// The heat that passed through other gaps than the mean ones of the step, [contact], in schemes that
  /// conduct heat before they solve deformation; else empty.
  std::vector<contact::GapHeat> gap_heat;
  /// The least and the largest D_mech at any point and zero [W/m³]: the least is zero but for rounding.
  double least_dissipation = 0, largest_dissipation = 0;
  double solid_fraction = 1;                        ///< of the bodies that can melt, by volume
  double min_temperature = 0, max_temperature = 0;  ///< [K]
  double internal_energy = 0;  ///< of the state, where it has one (internal_energy.hpp) [J]
  /// Fields that belong to the solution besides the state. The run takes them out: a record has none but what
  /// the two stages of a step have left for who asked for it (heat::ThermalPhase::keep_stages).
  struct Fields {
    /// Flows of heat of the last thermal pass in which something flowed, for the estimate of the step's error
    /// (error_estimate.hpp); known where nodes hold the heat.
    heat::StageFlows flows;
    /// Support forces at the end of the step, [owned node][component] [N]; empty without mechanics.
    std::vector<double> reactions;
  } fields;
  /// The effort of two steps in a row as that of one: the harder iteration, sums, and the end of the second.
  StepEffort& operator+=(const StepEffort& next);
};

/// A step as it was taken, for steps.csv, the progress line and the audit.
struct StepRecord : StepEffort {
  int number = 0;
  double time = 0, dt = 0;  ///< t_{n+1} and the step [s]
  std::string reason;       ///< why this size
  int rejected = 0;         ///< how many tries failed before, or were too long when they had been solved
  int shortened = 0;        ///< how many tries were too long by their heat alone, before mechanics was solved
  std::string rejection;    ///< the last try's reason
  bool output = false;      ///< the time is an output time
  std::string stage;        ///< empty in a run without stages
  int stage_of_case = 0;    ///< its number in the case, from one; zero without stages
  int cycle = 0;            ///< how often its cycle has come round, from one; zero outside of cycles
  /// Local errors as estimated, zero where nothing estimates them [K], [m], [1].
  double temperature_error = 0, displacement_error = 0, stress_error = 0;
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// The state before the first step, of this run or of its continuation.
  virtual void begin(const State& state) = 0;
  /// A step was committed. Called on every process.
  virtual void step(const StepRecord& record, const State& state) = 0;
  /// A shot is over; the last step told to step() was its last.
  virtual void shot(const ShotRecord& /*record*/, const State& /*state*/) {}
  /// A checkpoint is due at the committed state; with `continuation` the run can go on from it.
  virtual void checkpoint(const RestartData& /*continuation*/, const State& /*state*/) {}
  /// The run cannot or shall not go on; `state` is the last committed one, its checkpoint is written.
  virtual void stopped(const Stop& stop, const State& state) = 0;
  virtual void end(const State& state) = 0;
};

}  // namespace solidus::coupling
