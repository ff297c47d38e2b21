/// Merging of case files: variants that include a case, and `--set path=value`.
#pragma once

#include <string>

#include "input/document.hpp"

namespace solidus::cases {

/// Merges `over` into `base`. Sections merge key by key; lists of sections ([[body]]) merge by their `name`,
/// new names are appended; everything else (numbers, texts, lists, inline tables) replaces the value of
/// `base`. If the `kind` of a section changes, keys that only the old kind has are removed. Each value keeps
/// its place in the file it came from.
void lay_over(Value& base, const Value& over);

/// Applies "time.step=0.5 s" or "body.part.material=steel" to a case. A list of sections is addressed by name
/// or by number from one. Throws InputError for a text without '=', an empty path, or a section of a list
/// that does not exist.
void apply_override(Value& base, const std::string& assignment);

}  // namespace solidus::cases
