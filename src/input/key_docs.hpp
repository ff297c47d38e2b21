/// Documentation that is generated from the declaration of keys: explanations, the JSON Schema, the reference
/// manual.
#pragma once

#include <string>
#include <vector>

#include "input/keys.hpp"

namespace solidus {

/// Explains one key or section to the user: "time.step", "body", "phase_change.NAME.latent_heat"; the
/// overview of all keys for an empty path. Throws InputError with the nearest name for a path that does not
/// exist.
std::string explain(const SectionInfo& root, const std::string& path);

/// For the message of a key that is missing: what it means, and with which value of another key it is needed.
std::string advice_on_missing(const Key& key);

/// Returns the JSON Schema (draft 7) of a file, for editors: types, choices, ranges, no unknown keys. Keys
/// that are required carry it in their description only, because a variant file that includes another gives
/// just a part of them.
std::string json_schema(const SectionInfo& root, const std::string& title);

/// The reference manual of a file in Markdown: one table of keys a section.
std::string reference_manual(const SectionInfo& root, const std::string& title);

/// The paths of all keys that --set can change, "time.step", in the order of their declaration; keys of
/// sections that have names of the user's are under NAME.
std::vector<std::string> key_paths(const SectionInfo& root);

}  // namespace solidus
