/// The end of a run as the start of a structural analysis, which the formats of several programs share.
#pragma once

#include <string>

#include "app/export_format.hpp"
#include "results/formats/structural_deck.hpp"

namespace solidus::app {

/// Reads the run's case and its checkpoint, writes the file as `deck` has it, and returns what is to be
/// printed.
/// @param deck  the text of the file
/// Throws as run::export_state does.
std::string write_structural_start(const ExportRequest& request,
                                   std::string (*deck)(const results::StructuralDeck&));

}  // namespace solidus::app
