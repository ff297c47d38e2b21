/// Each stored block acts twice, as itself and as its mirror image; sizes have instances of their own.
#include "multigrid/symmetric_product.hpp"

#include <algorithm>
#include <bit>

#include "multigrid/packed_rows.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::multigrid {

namespace {

/// A row of a block in a register, whose lanes beyond the block hold what follows in memory: they are
/// multiplied with zeros there, or the result is not read.
template <class Number, int size>
struct Register {
  static constexpr int lanes = static_cast<int>(std::bit_ceil(static_cast<unsigned>(size)));
  typedef Number Type __attribute__((vector_size(lanes * sizeof(Number))));
};

template <class Type, class Number>
Type load(const Number* from) {
  Type v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

/// The product for vectors with a register for each row: y is read back soon after it has been written, which
/// is slow where the two do not cover the same bytes.
template <class Number, int size>
void multiply_registers(std::span<const std::int64_t> start, const Index* column, const Number* blocks,
                        const Number* x, Number* y) {
  using Type = typename Register<Number, size>::Type;
  constexpr std::ptrdiff_t lanes = Register<Number, size>::lanes;
  const auto n = as_index(start.size()) - 1;
  for (Index row = 0; row < n; ++row) {
    std::int64_t s = start[as_size(row)];
    const std::int64_t end = start[as_size(row) + 1];
    const Number* a = blocks + s * size * size;
    // The row's own x as one register, and each of its entries spread over a register.
    const Type own = load<Type>(x + row * lanes);
    Type sum[size], spread[size];
    for (int r = 0; r < size; ++r) {
      Number same[lanes] = {};
      std::fill_n(same, size, x[row * lanes + r]);
      spread[r] = load<Type>(same);
      sum[r] = load<Type>(a + r * size) * own;
    }
    // Blocks right of the diagonal serve this row and, transposed, the row of their column.
    for (++s, a += size * size; s < end && column[s] < n; ++s, a += size * size) {
      const Type other = load<Type>(x + column[s] * lanes);
      Number* const to = y + column[s] * lanes;
      Type back = load<Type>(to);
      for (int r = 0; r < size; ++r) {
        const Type line = load<Type>(a + r * size);
        sum[r] += line * other;
        back += line * spread[r];
      }
      __builtin_memcpy(to, &back, sizeof back);
    }
    // Blocks of ghost columns have no row here.
    for (; s < end; ++s, a += size * size) {
      const Type other = load<Type>(x + column[s] * lanes);
      for (int r = 0; r < size; ++r) sum[r] += load<Type>(a + r * size) * other;
    }
    // The lanes of a sum are the columns of the block: they are added up at the end.
    for (int r = 0; r < size; ++r) {
      Number parts[lanes], total = 0;
      __builtin_memcpy(parts, &sum[r], sizeof parts);
      for (int c = 0; c < size; ++c) total += parts[c];
      y[row * lanes + r] += total;
    }
  }
}

}  // namespace

template <class Number>
void multiply_symmetric(int size, std::span<const std::int64_t> start, const Index* column,
                        const Number* blocks, const Number* x, Number* y, std::vector<Number>& scratch,
                        Index n_local) {
  const auto n = static_cast<std::ptrdiff_t>(start.size()) - 1;
  // A product reads each block once, for its row and for its column. Where a block row does not fill a
  // register (three components), vectors are widened to whole registers while the product runs.
  with_block_sizes(size, size, [&]<int rows, int columns>() {
    constexpr std::ptrdiff_t lanes = Register<Number, rows>::lanes;
    if constexpr (rows == lanes) {
      std::fill_n(y, n * rows, Number(0));
      multiply_registers<Number, rows>(start, column, blocks, x, y);
    } else {
      scratch.resize(as_size((n_local + n) * lanes));
      Number* const wide_x = scratch.data();
      Number* const wide_y = wide_x + n_local * lanes;
      for (std::ptrdiff_t i = 0; i < n_local; ++i)
        for (std::ptrdiff_t c = 0; c < lanes; ++c)
          wide_x[i * lanes + c] = c < rows ? x[i * rows + c] : Number(0);
      std::fill_n(wide_y, n * lanes, Number(0));
      multiply_registers<Number, rows>(start, column, blocks, wide_x, wide_y);
      for (std::ptrdiff_t i = 0; i < n; ++i)
        for (std::ptrdiff_t c = 0; c < rows; ++c) y[i * rows + c] = wide_y[i * lanes + c];
    }
  });
}

template void multiply_symmetric(int, std::span<const std::int64_t>, const Index*, const float*, const float*,
                                 float*, std::vector<float>&, Index);
template void multiply_symmetric(int, std::span<const std::int64_t>, const Index*, const double*,
                                 const double*, double*, std::vector<double>&, Index);

}  // namespace solidus::multigrid
