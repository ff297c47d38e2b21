/// The families of findings that every program has: of each file findings/NAME.cpp its findings_NAME(). The
/// build writes the source of this header (CMakeLists.txt), so that no list names them.
#pragma once

#include <vector>

#include "check/finding_family.hpp"

namespace solidus::check {

/// In no particular order: each says its place.
std::vector<FindingFamily> built_in_findings();

}  // namespace solidus::check
