/// Checks a TOML text, before it is parsed, for keys with so many parts that the parser would exhaust the
/// stack.
#pragma once

#include <string>
#include <string_view>

namespace solidus {

/// Parts of a dotted key, and depth of tables in tables: far more than any file of ours has.
inline constexpr int k_most_key_parts = 32;

/// Throws InputError for a key of too many parts: each part is a table in a table, and what walks through
/// them would exhaust the stack.
/// @param name  of the file, for the message
void check_key_lengths(std::string_view text, const std::string& name);

}  // namespace solidus
