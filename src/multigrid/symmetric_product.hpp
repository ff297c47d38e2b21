/// Products with symmetric matrices of which only the blocks on and above the diagonal are stored: they read
/// half of the memory, and memory traffic limits their speed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::multigrid {

/// y = A x
/// @param size    block size, one of those of with_block_sizes()
/// @param start   first slot of each block row, which begins with its diagonal; columns are sorted, those of
/// other processes last
/// @param blocks  [slot][row][column]; seven numbers after the last must be readable
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
