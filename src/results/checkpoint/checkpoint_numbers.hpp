/// The numbers of a checkpoint that are neither fields nor text: step control, sums of energy, shots.
#pragma once

#include <vector>

#include "results/checkpoint/checkpoint.hpp"
#include "results/checkpoint/checkpoint_tables.hpp"

namespace solidus::results {

/// All of them in a fixed order.
std::vector<double> numbers_of(const CheckpointView& c);

/// Reads them from the file, which must contain the same number. Rejects the file if a count is not an
/// integer in its range; without a die its temperatures are infinite.
void set_numbers(TableReader& in, Checkpoint& c);

}  // namespace solidus::results
