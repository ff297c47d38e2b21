#include "multigrid/symmetric_product.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "multigrid/matrix_view.hpp"

namespace solidus::multigrid {
namespace {

/// Eleven block rows, some of which couple with ghosts: the blocks on and above the diagonal, and the whole.
struct Halved {
  static constexpr Index n_rows = 11, n_local = 14;
  int size;
  std::vector<std::int64_t> start{0};
  std::vector<Index> column;

  explicit Halved(int block_size) : size(block_size) {
    for (Index row = 0; row < n_rows; ++row) {
      for (Index j = row; j < n_local; ++j)
        if (coupled(row, j)) column.push_back(j);
      start.push_back(static_cast<std::int64_t>(column.size()));
    }
  }
  static bool coupled(Index row, Index j) { return row == j || (row + j) % 3 == 0 || j - row == 1; }
  /// An entry of the whole matrix, which is symmetric where both are rows.
  double entry(Index row, int a, Index j, int b) const {
    const int i = row * size + a, k = j * size + b;
    return std::cos(1.0 + std::min(i, k) * 0.7) * std::sin(0.3 + std::max(i, k));
  }
  template <class Number>
  std::vector<Number> blocks() const {
    std::vector<Number> values;
    for (Index row = 0; row < n_rows; ++row)
      for (std::int64_t s = start[static_cast<std::size_t>(row)];
           s < start[static_cast<std::size_t>(row) + 1]; ++s)
        for (int a = 0; a < size; ++a)
          for (int b = 0; b < size; ++b)
            values.push_back(static_cast<Number>(entry(row, a, column[static_cast<std::size_t>(s)], b)));
    // Values beyond the last block must not matter.
    values.resize(values.size() + 7, static_cast<Number>(1e3));
    return values;
  }
};

template <class Number>
void expect_whole_product(int size) {
  const Halved half(size);
  const auto n = static_cast<std::size_t>(half.n_rows * size),
             all = static_cast<std::size_t>(half.n_local * size);
  std::vector<Number> x(all), y(n, Number(7)), scratch;
  for (std::size_t i = 0; i < all; ++i) x[i] = static_cast<Number>(std::sin(2.0 + static_cast<double>(i)));
  for (int again = 0; again < 2; ++again) {
    multiply_symmetric(size, half.start, half.column.data(), half.blocks<Number>().data(), x.data(), y.data(),
                       scratch, half.n_local);
    for (Index row = 0; row < half.n_rows; ++row)
      for (int a = 0; a < size; ++a) {
        double sum = 0;
        for (Index j = 0; j < half.n_local; ++j)
          for (int b = 0; b < size; ++b)
            if (half.coupled(std::min(row, j), std::max(row, j)))
              sum +=
                  half.entry(row, a, j, b) * static_cast<double>(x[static_cast<std::size_t>(j * size + b)]);
        // Some eighty terms below one.
        EXPECT_NEAR(static_cast<double>(y[static_cast<std::size_t>(row * size + a)]), sum,
                    80 * static_cast<double>(std::numeric_limits<Number>::epsilon()))
            << "blocks of " << size << ", row " << row;
      }
  }
}

TEST(SymmetricProduct, OfHalfTheBlocksIsThatOfAllInBothPrecisions) {
  for (const int size : {1, 2, 3, 6}) {
    expect_whole_product<float>(size);
    expect_whole_product<double>(size);
  }
}

TEST(LowerPart, HasTheMirrorImageOfEveryBlockAboveTheDiagonal) {
  const Halved half(1);
  const std::vector<double> blocks = half.blocks<double>();
  const LowerPart lower(half.start, half.column);
  const MatrixView view{1, half.start, half.column, blocks.data(), &lower};
  for (Index row = 0; row < half.n_rows; ++row) {
    Index before = -1;
    int n = 0;
    view.each(row, [&](Index j, std::int64_t slot, bool mirrored) {
      EXPECT_GT(j, before);
      EXPECT_EQ(mirrored, j < row);
      EXPECT_EQ(*view.block(slot), half.entry(row, 0, j, 0));
      before = j;
      ++n;
    });
    int expected = 0;
    for (Index j = 0; j < half.n_local; ++j)
      expected += half.coupled(std::min(row, j), std::max(row, j)) ? 1 : 0;
    EXPECT_EQ(n, expected) << "row " << row;
  }
}

}  // namespace
}  // namespace solidus::multigrid
