/// JSON of other programs (RFC 8259) as a tree of values with their places.
#pragma once

#include <string>
#include <string_view>

#include "input/document.hpp"

namespace solidus {

/// Numbers are always floating-point; null and the NaN and Infinity that Python writes are numbers that are
/// not finite. Throws InputError with line and column where the text is no JSON, or nested deeper than 64
/// levels.
/// @param name stands for the file in messages
Value parse_json(std::string_view text, const std::string& name);

}  // namespace solidus
