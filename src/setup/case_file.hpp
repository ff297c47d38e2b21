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
  std::filesystem::path file;  ///< the file that was asked for
  std::string variant;         ///< of it (case_layers.hpp); empty: the file as it is

  /// The case as a TOML file that gives the same run from anywhere: paths are absolute.
  std::string toml() const;
};

/// Reads a case, the case.toml of a folder, or a variant of either (case_layers.hpp); follows `include`, lays
/// overrides over it, fills in defaults, checks every key and what can be checked between keys without the
/// mesh. Throws InputError with the place of the first thing wrong.
/// @param overrides "path=value" as given to --set
/// @param physics   what is computed in place of what the case says; the rest of the case follows
///                  (cases/physics_switch.hpp)
Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
               std::optional<cases::Physics> physics = {});

/// Checks between keys, as part of load_case: names used twice, components that the analysis does not have,
/// ...
void check_case(const cases::CaseSpec& spec);

}  // namespace solidus::setup
