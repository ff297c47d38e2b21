/// Runs a checked case and fills its results folder.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "model/case_file.hpp"
#include "model/coupling_estimate.hpp"
#include "results/summary.hpp"

namespace solidus::model {

struct RunOptions {
  std::filesystem::path folder;      ///< of the results
  std::ostream* progress = nullptr;  ///< where steps are shown; null: nowhere (process 0 only)
  bool terminal = false;             ///< draw a progress bar
  bool restart = false;              ///< go on from the checkpoint in `folder`
  bool profile = false;              ///< show at the end where the wall time went
  std::function<bool()> stop_asked;  ///< asked before each step; true on any process ends the run there
};

struct RunResult {
  bool finished = true;
  std::string reason;  ///< why it stopped, with place, checkpoint and advice; several lines
};

/// Loads materials and mesh, builds the phases, runs and writes the results. Collective. Throws InputError
/// for what the case or the place for the results has wrong, before anything is computed where that can be
/// known.
RunResult run_case(Case c, const RunOptions& options);

/// Result of checking a case without running it.
struct CheckedRun {
  results::MeshCounts mesh;
  results::Overview overview;
  std::vector<CouplingEstimate> couplings;  ///< one per body where heat and deformation are coupled
};

/// Everything that run_case does before it computes, but for the results folder. Collective. Throws
/// InputError.
CheckedRun check_run(Case c);

}  // namespace solidus::model
