/// Files of a case laid over each other: `include`, and the variants of a case in one file.
///
/// Next to a case.toml a file variants.toml may be:
///
///   [part.stiff]               # what several variants share
///   mechanics.tolerance = 1e-9
///   [variant.stiff_isothermal]
///   include = ":stiff"         # a part or another variant of this file; other names are those of files
///   coupling.scheme = "isothermal"
///
/// A variant lies over the case.toml next to it, and is named FOLDER:VARIANT or FILE:VARIANT.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "input/document.hpp"

namespace solidus::setup {

/// A case as a user names it, taken apart.
struct CaseName {
  std::filesystem::path file;  ///< exists
  std::string variant;         ///< of the variants.toml next to it; empty: the file as it is
};

/// Throws InputError, with what may have been meant, where there is no such case. The variant is looked up by
/// load_layers().
/// @param path  a case file, or a folder that holds a case.toml, and behind a colon the name of a variant
CaseName case_named(const std::filesystem::path& path);

/// The document of a case with all that it includes, the later over the earlier. Places stay those of the
/// file a value came from. Throws InputError.
Value load_layers(const CaseName& name);

struct VariantInfo {
  std::string name, title;  ///< as the variant itself says; empty where it does not
};
/// The variants next to a case file, in their order. Throws InputError for a file of variants that is none.
std::vector<VariantInfo> variants_beside(const std::filesystem::path& case_file);

/// A path of the user seen from the file it is written in; on the command line, from the present folder.
std::string resolved_path(const Value& value);

}  // namespace solidus::setup
