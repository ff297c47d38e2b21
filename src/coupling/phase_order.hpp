/// Order of the phases of a sequential split in a step (sequential_split.hpp).
#pragma once

namespace solidus::coupling {

enum class PhaseOrder { mechanics_first, heat_first };

}  // namespace solidus::coupling
