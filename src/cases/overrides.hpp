/// Case files laid over each other: variants that include a case, and `--set path=value`.
#pragma once

#include <string>

#include "input/document.hpp"

namespace solidus::cases {

/// Lays `over` on `base` (a variant that changes the `kind` of a section drops what only the old kind takes):
/// sections merge key by key; lists of sections ([[body]]) merge by their `name`, new names are added behind;
/// everything else (numbers, texts, lists, tables written inline) replaces what was there. Places stay those
/// of the file a value came from.
void lay_over(Value& base, const Value& over);

/// Applies "time.step=0.5 s" or "body.part.material=steel" to a case. A list of sections is addressed by name
/// or by number from one. Throws InputError for a text without '=', an empty path, or a section of a list
/// that does not exist.
void apply_override(Value& base, const std::string& assignment);

}  // namespace solidus::cases
