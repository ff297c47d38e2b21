/// Exports the end of a run, from its folder, as the start of a structural analysis in another program.
#pragma once

#include <filesystem>
#include <string>

#include "results/formats/structural_deck.hpp"
#include "setup/case_file.hpp"

namespace solidus::run {

struct ExportOptions {
  std::filesystem::path folder;                                        ///< of the run: its checkpoint
  std::filesystem::path file;                                          ///< to write
  std::string (*deck)(const results::StructuralDeck& deck) = nullptr;  ///< the text of the file
  bool deformed = false;                                               ///< coordinates with the displacement
  /// Not the end, but the temperatures of all times for which there are fields, as the load of the analysis.
  bool temperature_history = false;
};

struct ExportReport {
  double time = 0;      ///< of the checkpoint [s]
  double adjusted = 0;  ///< the largest displacement that equilibrium at the final temperature asks for [m]
  std::size_t elements = 0;
  std::size_t times = 0;     ///< of the history, where it was asked for
  std::size_t supports = 0;  ///< degrees of freedom held besides, in parts that only contact held
};

/// Brings the state of the checkpoint into equilibrium at its own temperature (the phases are solved in
/// alternation: the stress of the last step is that of the temperature before) and writes it; or writes the
/// temperatures over time (then the run must have left fields, and no body may come or go). One process.
/// Throws InputError for a case without mechanics or with inertia, for several processes, and as a restart
/// does; StepRejected where there is no equilibrium.
ExportReport export_state(const setup::Case& c, const ExportOptions& options);

}  // namespace solidus::run
