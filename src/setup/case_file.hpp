/// Reads a case file and validates the case.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "input/document.hpp"

namespace solidus::setup {

struct Case {
  cases::CaseSpec spec;
  Value document;              ///< the resolved case: includes, overrides and defaults in place
  std::filesystem::path file;  ///< the requested file
  std::string variant;         ///< name of its variant (case_layers.hpp); empty: the file itself

  /// The case as a TOML file that gives the same run from anywhere: paths are absolute.
  std::string toml() const;
};

/// Reads a case, the case.toml of a folder, or a variant of either (case_layers.hpp); follows `include`,
/// applies overrides, fills in defaults, checks every key and the agreement of keys as far as possible
/// without the mesh. Throws InputError with the place of the first error.
/// @param overrides "path=value" as given to --set
/// @param physics   replaces the physics of the case; other keys are adapted (cases/physics_switch.hpp)
Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
               std::optional<cases::Physics> physics = {});

/// Checks between keys, as part of load_case: names used twice, components that the analysis does not have,
/// ...
void check_case(const cases::CaseSpec& spec);

}  // namespace solidus::setup
