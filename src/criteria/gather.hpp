/// Gathers small lists from all processes on all.
#pragma once

#include <span>
#include <vector>

namespace solidus::criteria {

/// The numbers of all processes, one process behind the other, the same everywhere. Collective.
std::vector<double> gathered(std::span<const double> own);

}  // namespace solidus::criteria
