/// The formats of fields that every program writes: of each file results/formats/format_NAME.cpp its
/// format_NAME(). The build writes the source of this header (CMakeLists.txt), so that no list names them.
#pragma once

#include <vector>

#include "results/output/field_format.hpp"

namespace solidus::results {

/// In no particular order: each says its place.
std::vector<FieldFormat> built_in_field_formats();

}  // namespace solidus::results
