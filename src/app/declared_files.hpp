/// The files whose keys are declared: of `explain` and of `schema`.
#pragma once

#include <CLI/CLI.hpp>

#include "input/keys.hpp"

namespace solidus::app {

/// The file that --material and --point choose; without them the case file.
struct ChosenFile {
  bool material = false, point = false;

  /// Declares both options, which exclude each other.
  void add_options(CLI::App& verb);

  struct Declared {
    const SectionInfo& keys;
    const char *reference, *schema;  ///< titles
  };
  Declared declared() const;
};

}  // namespace solidus::app
