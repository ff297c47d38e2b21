/// Blocks are stored by columns in single precision and padded so that whole vectors can be loaded behind
/// the last one.
#include "multigrid/packed_rows.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "multigrid/symmetric_product.hpp"
#include "numbers/index_casts.hpp"
#include "system/large_pages.hpp"

namespace solidus::multigrid {

namespace {

/// The register that a column of a block is read into; entries of the next column that it reads are never
/// written.
template <int rows>
struct Vector;
template <>
struct Vector<1> {
  using Type = float;
};
template <>
struct Vector<2> {
  typedef float Type __attribute__((vector_size(8)));
};
template <>
struct Vector<3> {
  typedef float Type __attribute__((vector_size(16)));
};
template <>
struct Vector<6> {
  typedef float Type __attribute__((vector_size(32)));
};

template <class Type>
Type load(const float* from) {
  Type v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <int rows, int columns, bool add>
void multiply_rows(std::span<const std::int64_t> start, const Index* column, const float* value,
                   const float* x, float* y) {
  using Type = typename Vector<rows>::Type;
  // Columns of a block are loaded as vectors, so that each entry of x multiplies a whole column.
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    Type sum{};
    const float* a = value + start[row] * rows * columns;
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s, a += rows * columns) {
      const float* const from = x + static_cast<std::ptrdiff_t>(column[s]) * columns;
      for (int c = 0; c < columns; ++c) sum += load<Type>(a + c * rows) * from[c];
    }
    // The lanes of the sum are the rows of the block.
    float part[sizeof(Type) / sizeof(float)];
    __builtin_memcpy(part, &sum, sizeof sum);
    float* const to = y + row * rows;
    for (int r = 0; r < rows; ++r) to[r] = add ? to[r] + part[r] : part[r];
  }
}

template <int rows, int columns>
void multiply_transposed(std::span<const std::int64_t> start, const Index* column, const float* value,
                         const float* x, float* y) {
  // By rows of the matrix the product goes to the columns.
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    const float* const from = x + row * rows;
    const float* a = value + start[row] * rows * columns;
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s, a += rows * columns) {
      float* const to = y + static_cast<std::ptrdiff_t>(column[s]) * columns;
      for (int c = 0; c < columns; ++c) {
        float sum = 0;
        for (int r = 0; r < rows; ++r) sum += a[c * rows + r] * from[r];
        to[c] += sum;
      }
    }
  }
}

}  // namespace

PackedRows::PackedRows(const MatrixView& a, Index n_local, bool symmetric, Pattern pattern)
    : rows_(a.size),
      columns_(a.size),
      symmetric_(symmetric),
      n_local_(n_local),
      start_(a.start),
      column_(a.column) {
  // Where the matrix before has both halves and symmetry is to be used, the pattern of its upper half is
  // copied. Otherwise the pattern is shared with it, or copied where it will not outlive this level.
  assert(symmetric || a.lower == nullptr);
  if (symmetric && a.lower == nullptr) {
    copy_upper_pattern(a);
  } else if (pattern == Pattern::copied) {
    own_start_.assign(a.start.begin(), a.start.end());
    own_column_.assign(a.column.begin(), a.column.begin() + a.start.back());
  }
  if (!own_start_.empty()) {
    start_ = own_start_;
    column_ = own_column_;
  }
  // Values are copied in single precision, into large pages because products stream through them. Behind the
  // last block some numbers are left free: vector loads may read beyond it.
  const auto entries = as_size(a.size * a.size);
  assign_in_large_pages(value_, as_size(start_.back()) * entries + k_overhang, 0.0F);
  float* to = value_.data();
  for (Index row = 0; row < a.n_rows(); ++row) {
    const std::int64_t n = start_[as_size(row) + 1] - start_[as_size(row)];
    // A symmetric row begins with its diagonal block, so only the last n of a whole row are taken. Blocks of
    // a row that is not symmetric are stored by columns, which is how the product reads them.
    for (std::int64_t s = a.end(row) - n; s < a.end(row); ++s) {
      const double* const block = a.block(s);
      for (int i = 0; i < a.size; ++i)
        for (int k = 0; k < a.size; ++k)
          *to++ = static_cast<float>(symmetric ? block[i * a.size + k] : block[k * a.size + i]);
    }
  }
}

/// Copies the sparsity pattern of the upper triangle; blocks left of the diagonal are omitted.
void PackedRows::copy_upper_pattern(const MatrixView& a) {
  own_start_.assign(1, 0);
  own_start_.reserve(a.start.size());
  // Where the diagonal of each row is: what follows it is kept.
  std::vector<std::int64_t> diagonal(a.start.size() - 1);
  for (Index row = 0; row < a.n_rows(); ++row) {
    const auto first = a.column.begin() + a.begin(row), last = a.column.begin() + a.end(row);
    diagonal[as_size(row)] = std::lower_bound(first, last, row) - a.column.begin();
    own_start_.push_back(own_start_.back() + a.end(row) - diagonal[as_size(row)]);
  }
  own_column_.reserve(as_size(own_start_.back()));
  for (Index row = 0; row < a.n_rows(); ++row)
    own_column_.insert(own_column_.end(), a.column.begin() + diagonal[as_size(row)],
                       a.column.begin() + a.end(row));
}

PackedRows::PackedRows(BlockRows<float> from, Index n_rows)
    : rows_(from.rows), columns_(from.columns), own_start_(std::move(from.start)) {
  // Rows of ghosts are dropped: their products belong to other processes.
  own_start_.resize(as_size(n_rows) + 1);
  const auto n_slots = as_size(own_start_.back());
  own_column_ = std::move(from.column);
  own_column_.resize(n_slots);
  start_ = own_start_;
  column_ = own_column_;
  value_ = std::move(from.value);
  const auto entries = as_size(rows_ * columns_);
  value_.reserve(n_slots * entries + k_overhang);  // not more, as growing would
  value_.resize(n_slots * entries + k_overhang);
  // Block by block, each in its place.
  std::vector<float> block(entries);
  float* to = value_.data();
  for (std::size_t s = 0; s < n_slots; ++s) {
    std::copy_n(to, entries, block.begin());
    for (int c = 0; c < columns_; ++c)
      for (int r = 0; r < rows_; ++r) *to++ = block[as_size(r * columns_ + c)];
  }
}

void PackedRows::multiply(const float* x, float* y) const {
  if (symmetric_)
    return multiply_symmetric(rows_, start_, column_.data(), value_.data(), x, y, scratch_, n_local_);
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_rows<rows, columns, false>(start_, column_.data(), value_.data(), x, y);
  });
}

void PackedRows::multiply_add(const float* x, float* y) const {
  assert(!symmetric_);
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_rows<rows, columns, true>(start_, column_.data(), value_.data(), x, y);
  });
}

void PackedRows::multiply_transposed_add(const float* x, float* y) const {
  assert(!symmetric_);
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_transposed<rows, columns>(start_, column_.data(), value_.data(), x, y);
  });
}

std::size_t PackedRows::bytes() const {
  return own_start_.capacity() * sizeof own_start_[0] + own_column_.capacity() * sizeof own_column_[0] +
         (value_.capacity() + scratch_.capacity()) * sizeof value_[0];
}

}  // namespace solidus::multigrid
