/// Filling the mould of a case before it freezes: OpenFOAM is driven by Python
/// (python/solidus_plots/fill.py).
#pragma once

#include <filesystem>
#include <optional>

#include "app/exit_code.hpp"
#include "setup/case_file.hpp"

namespace solidus::app {

struct FillingOptions {
  std::optional<int> processes;  ///< of the flow; absent: as many as pay
  bool restart = false;          ///< go on from where an earlier filling of this folder was stopped
};

/// Fills the mould of a case that has [filling], or finds it filled in this folder already. What it is doing
/// is printed. Throws InputError for what the case has wrong, and under mpirun.
ExitCode fill_mould(const setup::Case& c, const std::filesystem::path& folder, const FillingOptions& options);

}  // namespace solidus::app
