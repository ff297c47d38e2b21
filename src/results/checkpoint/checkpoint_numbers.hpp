/// The numbers of a checkpoint that are neither field nor text: of the step control, sums of energy, shots.
#pragma once

#include <vector>

#include "results/checkpoint/checkpoint.hpp"
#include "results/checkpoint/checkpoint_tables.hpp"

namespace solidus::results {

/// All of them in a fixed order.
std::vector<double> numbers_of(const CheckpointView& c);

/// Takes them from the file, which must hold as many. Counts are whole and fit; the temperatures of a die
/// that is not there are infinite. Refuses the file otherwise.
void set_numbers(TableReader& in, Checkpoint& c);

}  // namespace solidus::results
