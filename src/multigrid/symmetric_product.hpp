/// Products with symmetric matrices of which only the blocks on and above the diagonal are there: they read
/// half of the memory, and memory traffic bounds their speed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::multigrid {

/// y = A x
/// @param size    of the blocks, one with_block_sizes() knows
/// @param start   of the block rows, each beginning with its diagonal; columns rise, those of other processes
/// last
/// @param blocks  [slot][row][column]; readable for seven numbers behind the last
/// @param x       [local block row][size]
/// @param y       [block row][size]
/// @param scratch kept from call to call
template <class Number>
void multiply_symmetric(int size, std::span<const std::int64_t> start, const Index* column,
                        const Number* blocks, const Number* x, Number* y, std::vector<Number>& scratch,
                        Index n_local);

extern template void multiply_symmetric(int, std::span<const std::int64_t>, const Index*, const float*,
                                        const float*, float*, std::vector<float>&, Index);
extern template void multiply_symmetric(int, std::span<const std::int64_t>, const Index*, const double*,
                                        const double*, double*, std::vector<double>&, Index);

}  // namespace solidus::multigrid
