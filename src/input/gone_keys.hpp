/// Keys that a section of an input file does not have but users write: those of earlier versions that are
/// gone, and those of what is not computed; each with what to do instead.
#pragma once

#include <optional>
#include <string_view>

namespace solidus {

struct MissingKey {
  std::string_view section, key;
  std::string_view state;    ///< "is gone", "is not there"
  std::string_view instead;  ///< what to do
};

/// Nothing for any other key.
std::optional<MissingKey> missing_key(std::string_view section, std::string_view key);

}  // namespace solidus
