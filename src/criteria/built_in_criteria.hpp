/// The criteria that every program has: of each file kinds/NAME.cpp its criterion_NAME(). The build writes
/// the source of this header (CMakeLists.txt), so that no list names them.
#pragma once

#include <vector>

#include "criteria/criterion_kind.hpp"

namespace solidus::criteria {

/// In no particular order: each says its place.
std::vector<SharedCriterionKind> built_in_criteria();

}  // namespace solidus::criteria
