/// The loop over time: plan a step, take and measure it, commit or repeat it. run() goes through it to its
/// end; a caller that looks at every step drives the same loop by begin(), take_step() and commit_step().
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/error_estimate.hpp"
#include "coupling/growth.hpp"
#include "coupling/measured_step.hpp"
#include "coupling/observer.hpp"
#include "coupling/scheme.hpp"
#include "coupling/shot_map.hpp"
#include "coupling/state.hpp"
#include "coupling/step_control.hpp"
#include "criteria/criteria.hpp"

namespace solidus::heat {
class ThermalPhase;
}

namespace solidus::coupling {

/// A part of the run with conditions of its own. Its first step starts again: no step size, no rates and no
/// history of a two-step method from before.
struct Stage {
  std::string name;
  int of_case = 0, cycle = 0;  ///< as in StepRecord
  double end = 0;              ///< [s]
  StepOptions step;
  int shot = 0;                                 ///< that it belongs to, from one; zero: to none
  bool begins_shot = false, ends_shot = false;  ///< it is the first, the last stage of its shot
  bool pours = false;                           ///< bodies come when it begins
};

struct TimeOptions {
  double end = 0;  ///< [s]
  /// The run ends with the first step after which all that can melt is solid, which is an output.
  bool until_solid = false;
  StepOptions step;
  std::vector<Stage> stages;  ///< one after the other, instead of end and step; empty: one without a name
  std::vector<double> output_times;  ///< met exactly; a checkpoint is due at each of them
  bool output_at_stage_ends = true;
  int checkpoint_every = 0;  ///< steps between further checkpoints; zero: none
  /// Returns the times in a stage (number in `stages`) at which its conditions bend or jump, where steps end
  /// too; empty: none are known.
  std::function<std::vector<TimeEvent>(std::size_t stage)> events;
};

enum class Outcome {
  finished,
  stuck,       ///< the smallest step was rejected; the last committed state is kept
  interrupted  ///< asked to stop; the last committed state is kept
};

/// Parts of a run that are informed of its steps; null where the run has none. They must outlive the
/// simulation.
struct Followers {
  /// Brings State::criteria along with every step that is committed.
  criteria::Criteria* criteria = nullptr;
  /// The phase that gets the heat of bodies that burn; State::burning goes along.
  heat::ThermalPhase* burning = nullptr;
  /// Adaptive steps are kept so short that loads of this phase that move overlap with themselves from step to
  /// step.
  const heat::ThermalPhase* loads = nullptr;
  /// Bodies grow between steps; adaptive steps end where elements are born.
  Growth* growth = nullptr;
  /// Called after each step that is committed, before observers see its end: moves heat with the metal that
  /// the criteria have moved in it. Collective.
  /// @param state  of which the criteria are those of its time
  /// @param has_moved  the state has the moved heat already: a run goes on
  std::function<void(State& state, bool has_moved)> moves_heat;
  /// Asked before each step, on every process; the run stops when one of them says so.
  std::function<bool()> stop_asked;
  /// Called when a stage of the run begins, also where a run goes on inside it: gives the phases its
  /// conditions. Collective.
  /// @param stage   number in TimeOptions::stages
  /// @param begins  the committed state, from which bodies that leave take what is theirs and to which others
  ///                come; null where the run goes on with a state that the stage has begun with
  /// It returns the heat of these bodies, which is that of the run's start where the first stage begins.
  std::function<BodyHeat(std::size_t stage, const StageStart&, State* begins)> stage_begins;
  /// Internal energy of a state, by which it is booked how that of the committed state changes with bodies
  /// that come and leave (BodyHeat::energy). Collective.
  std::function<double(const State&)> internal_energy;
  /// Finds the physical state behind a step that could not be taken, for Stop. Called once, where the run
  /// ends for it, before observers are told. Collective.
  /// @param last  the last committed state
  /// @param dt    the shortest step tried [s]
  std::function<Diagnosis(const State& last, const StepRejected& rejected, double dt)> diagnose;
  /// Reports shots, and ends the run after one that leaves the die as it found it.
  const ShotMap* shots = nullptr;
};

/// Where a run that has begun stands.
struct Present {
  bool pending = false;           ///< a step has been taken that is not committed yet
  const State& state;             ///< of the pending step, else the last committed one
  const StepRecord& record;       ///< likewise
  const StageStart& stage_start;  ///< of the present stage
  std::size_t stage = 0;          ///< in TimeOptions::stages
};

class Simulation {
 public:
  /// @param estimate  how adaptive steps measure their local error; needed unless they do not
  /// Throws std::invalid_argument where it is missing.
  Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options,
             std::optional<ErrorEstimate> estimate = {});
  ~Simulation();
  /// Observers are called in the order they were added; they must outlive the simulation.
  void add(Observer& observer) { observers_.push_back(&observer); }
  /// The parts that are informed of the steps; to be set before the run begins.
  Followers& followers() { return followers_; }
  /// Gives the solid fraction of a committed state, of the bodies that are active in the present stage, as
  /// StepEffort gives it of the states that follow. Collective.
  using SolidFraction = std::function<double(const State&)>;
  /// Runs from `initial` to the end time, which must lie ahead; a run that goes on from its end only tells
  /// its observers of the end. Collective.
  /// @param solid_fraction  asked at the start and whenever a stage begins, because bodies may have left
  /// @param from where the run that `initial` comes from stood; without it a new run begins. Its step size
  /// counts only if the step options are still the same; it must have stood in the stage of this time.
  Outcome run(State initial, const SolidFraction& solid_fraction,
              const std::optional<RestartData>& from = {});

  /// Begins a run as run() does, up to its first step. Collective.
  void begin(State initial, SolidFraction solid_fraction, const std::optional<RestartData>& from = {});
  /// Takes the next step, in as many tries as it needs, and leaves it pending: commit_step() or
  /// discard_step() follows. Returns nothing while the run goes on, else how it ended; then no step is
  /// pending. Collective.
  std::optional<Outcome> take_step();
  /// The pending step counts: observers learn of it, a checkpoint is written where one is due. Collective.
  void commit_step();
  /// The pending step does not count: the run is where it was before it. Collective.
  /// @param step  the size wanted in its place [s]; absent: as before
  void discard_step(std::optional<double> step = {});
  /// The size wanted for the next step [s], before it lands on a time that must be met. No step is pending.
  void ask_step(double step);
  /// The phases have got other conditions from outside. No step is pending. Collective.
  void conditions_changed();
  /// Where the run stands; not before begin().
  Present present() const;

 private:
  struct Progress;  ///< variables of the loop over steps

  enum class Try { taken, repeat, stuck };
  /// Begins the stage that holds at the committed time, or goes on in it.
  void enter_stage(Progress& p, const std::optional<RestartData>& from);
  /// A run that goes on from its end has nothing left but to end.
  void end_at_once(Progress& p, const StageStart& stage_start);
  void begin_bodies(Progress& p, bool anew, bool changed_before);
  void end_shot(Progress& p);
  /// Adds what is born until the committed time.
  void grow(Progress& p);
  /// Whether a run that lasts until all is solid has come to its end.
  bool solid(const Progress& p) const;
  /// Whether a run is at the end of a shot that left the die as it found it.
  bool periodic(const Progress& p) const;
  Outcome stopped(const Stop& why, Progress& p, Outcome outcome);
  Try try_step(Progress& p);
  void hold_pending(Progress& p, const PlannedStep& step, const StepMeasure& measure, StepRecord record);
  PlannedStep plan(const Progress& p) const;
  void commit(Progress& p, const PlannedStep& step, const StepMeasure& measure);
  void check_limits(Progress& p, const PlannedStep& step, const StepMeasure& measure);
  static bool measures_error(const StepOptions& step);
  bool stop_asked() const;
  /// Moves heat with the metal of a step that is committed, where it moves.
  void move_heat(State& state);
  std::vector<TimeEvent> events(const Progress& p) const;
  bool checkpoint_due(const StepRecord& record) const;
  /// Writes a checkpoint of the committed state, from which a run goes on with this step control.
  void save(Progress& p, const ControlState& control);
  void measure_steps(Progress& p, const StepOptions& step, Rates rates);

  std::unique_ptr<CouplingScheme> scheme_;
  std::unique_ptr<Progress> progress_;  ///< from begin() on
  TimeOptions options_;
  std::optional<ErrorEstimate> estimate_;
  std::vector<Observer*> observers_;
  Followers followers_;
};

}  // namespace solidus::coupling
