/// Runs a checked case and fills its results folder: as a whole, or step by step.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/state.hpp"

#include "check/coupling_estimate.hpp"
#include "check/uncertain_parameters.hpp"
#include "results/summary.hpp"
#include "run/neighbours.hpp"
#include "setup/case_file.hpp"

namespace solidus::setup {
struct Assembly;
struct MadeMesh;
}  // namespace solidus::setup

namespace solidus::run {

struct MadeMesh;

struct RunOptions {
  std::filesystem::path folder;  ///< of the results; only a Session may go without, and leaves no files then
  std::ostream* progress = nullptr;  ///< where steps are shown; null: nowhere (process 0 only)
  bool terminal = false;             ///< draw a progress bar
  bool restart = false;              ///< go on from the checkpoint in `folder`
  bool profile = false;              ///< show at the end where the wall time went
  std::function<bool()> stop_asked;  ///< asked before each step; true on any process ends the run there
  /// The mesh where the first process has it already (setup/made_mesh.hpp), which is moved from; null: the
  /// case's mesh is read or made.
  std::shared_ptr<setup::MadeMesh> mesh = {};
  /// Parameters with respect to which temperatures of probes are differentiated (run/sensitivities.hpp).
  std::vector<Neighbour> neighbours = {};
};

struct RunResult {
  bool finished = true;
  std::string reason;  ///< why it stopped, with place, checkpoint and advice; several lines
};

/// Loads materials and mesh, builds the phases, runs and writes the results. Collective. Throws InputError
/// for what the case or the place for the results has wrong, before anything is computed where that can be
/// known.
RunResult run_case(setup::Case c, const RunOptions& options);

/// A run that a caller drives step by step: looks at the fields, changes conditions, repeats a step.
/// run_case() is a session that runs to its end. All functions are collective.
class Session {
 public:
  /// Loads and builds everything, as run_case() does. Throws InputError.
  Session(setup::Case c, RunOptions options);
  ~Session();

  /// Runs to the end, or on to it. A pending step is committed first.
  RunResult run();

  /// Commits the pending step and takes the next one, which is pending then: its fields can be read, and it
  /// can be repeated. Nothing is taken behind the end. Throws InputError for a steady case, and StepRejected
  /// or linear::Interrupted as a run does where a part of it has no committed state to stop at.
  /// @param step  the size wanted [s], cut where a time must be met; absent: by the step control
  /// Returns nothing while the run goes on, else how it ended.
  std::optional<RunResult> advance(std::optional<double> step = {});
  /// Takes the pending step again, perhaps with another size, or after a change of conditions.
  /// Throws InputError where no step is pending.
  std::optional<RunResult> repeat(std::optional<double> step = {});
  /// Commits the pending step, if there is one: tables and criteria have it then.
  void commit();
  /// Changes a key of a thermal or mechanical condition, "thermal_condition.mould.ambient=50 degC". It holds
  /// for what is computed next: the next step, or the repetition of the pending one. Throws InputError for
  /// what the case could not say either, and for other keys.
  void change(const std::string& assignment);

  /// Whether there is a step that can be repeated.
  bool pending() const;
  /// The state of the pending step, else the last committed one; of a steady case the one reached.
  const coupling::State& state() const;
  const coupling::StepRecord& record() const;
  /// The case that runs, with what has been changed, and what has been made of it.
  struct Made {
    const setup::Case& running;
    const setup::Assembly& assembly;
  };
  Made made() const;
  /// What summary.json says, after run(); null without a folder.
  const results::Summary* summary() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Result of checking a case without running it.
struct CheckedRun {
  results::MeshCounts mesh;
  results::Overview overview;
  std::vector<check::CouplingEstimate> couplings;  ///< one per body where heat and deformation are coupled
  check::UncertainParameters uncertain;
};

/// Everything that run_case does before it computes, but for the results folder. Collective. Throws
/// InputError.
CheckedRun check_run(setup::Case c);

}  // namespace solidus::run
