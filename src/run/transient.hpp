/// A transient run: the simulation with the observers that watch it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "coupling/shot_map.hpp"
#include "coupling/simulation.hpp"
#include "results/recorder.hpp"
#include "run/audit_watch.hpp"
#include "run/bounds_watch.hpp"
#include "run/channel_watch.hpp"
#include "run/dissipation_watch.hpp"
#include "run/gap_watch.hpp"
#include "run/growth_step_watch.hpp"
#include "run/lag_watch.hpp"
#include "run/melt_watch.hpp"
#include "run/range_watch.hpp"
#include "run/session.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// Remembers why a run stopped, for the caller.
class StopReason : public coupling::Observer {
 public:
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord&, const coupling::State&) override {}
  void stopped(const coupling::Stop& why, const coupling::State& state) override {
    stop = why;
    time = state.time;
  }
  void end(const coupling::State&) override {}
  coupling::Stop stop;
  double time = 0;
};

/// The parts refer to each other, to the case and to what was built of it, which must outlive them. All
/// functions are collective.
class Transient {
 public:
  /// @param recorder  null: nothing is written
  Transient(const cases::CaseSpec& spec, const RunOptions& options, setup::Assembly& a,
            coupling::Observer* recorder);
  Transient(const Transient&) = delete;
  Transient& operator=(const Transient&) = delete;

  /// Begins at the start of the case, or where the checkpoint has it.
  void begin(std::optional<results::Checkpoint> from);
  /// The outcome of the last step; nothing while the run goes on.
  std::optional<RunResult> result(std::optional<coupling::Outcome> outcome) const;
  /// Gives the phases the conditions that the case has now.
  void change_conditions();
  coupling::Simulation& simulation() { return simulation_; }

 private:
  /// What looks at each step and says what a reader of the results must know.
  struct Watches {
    Watches(const cases::CaseSpec& spec, setup::Assembly& a);
    RangeWatch range;
    std::optional<BoundsWatch> bounds;
    std::optional<MeltWatch> melts;
    DissipationWatch dissipation;
    StabilityWatch stability;
    FirstLawWatch first_law;
    WallWatch walls;
    LagWatch lag;
    FrictionLagWatch friction_lag;
    StressWorkWatch stress_work;
    GapWatch gaps;
    std::optional<GrowthStepWatch> growth_steps;
    ChannelWatch channels;
  };

  const cases::CaseSpec& spec_;
  const RunOptions& options_;
  setup::Assembly& a_;
  coupling::Simulation simulation_;
  Watches watches_;
  std::unique_ptr<coupling::ShotMap> shots_;
  StopReason why_;
};

}  // namespace solidus::run
