/// Completion of the command line for shells, from its declarations.
#pragma once

#include <string>
#include <vector>

#include "app/command_tree.hpp"

namespace solidus::app {

/// Words that the completion of the shell can offer besides verbs and options.
struct KnownWords {
  std::vector<std::string> keys;       ///< of the case file: "time.step"
  std::vector<std::string> materials;  ///< of the library
};

/// The shells that completion() knows.
const std::vector<std::string>& completed_shells();

/// A script for one of completed_shells(). Throws InputError for another one.
std::string completion(const CommandTree& tree, const KnownWords& words, const std::string& shell);

}  // namespace solidus::app
