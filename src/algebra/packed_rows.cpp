#include "algebra/packed_rows.hpp"

#include <algorithm>

#include "base/large_pages.hpp"

namespace solidus::algebra {

namespace {

/// The register that a column of a block is read into; what it reads of the next column is never written.
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

constexpr std::size_t k_overhang = 8;  ///< floats behind the last block

template <class Type>
Type load(const float* from) {
  Type v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <int rows, int columns, bool add>
void multiply_rows(const std::vector<std::int64_t>& start, const Index* column, const float* value,
                   const float* x, float* y) {
  using Type = typename Vector<rows>::Type;
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    Type sum{};
    const float* a = value + start[row] * rows * columns;
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s, a += rows * columns) {
      const float* const from = x + static_cast<std::ptrdiff_t>(column[s]) * columns;
      for (int c = 0; c < columns; ++c) sum += load<Type>(a + c * rows) * from[c];
    }
    float part[sizeof(Type) / sizeof(float)];
    __builtin_memcpy(part, &sum, sizeof sum);
    float* const to = y + row * rows;
    for (int r = 0; r < rows; ++r) to[r] = add ? to[r] + part[r] : part[r];
  }
}

template <int rows, int columns>
void multiply_transposed(const std::vector<std::int64_t>& start, const Index* column, const float* value,
                         const float* x, float* y) {
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

template <class Number>
PackedRows::PackedRows(int rows, int columns, const std::int64_t* start, Index n_rows, const Index* column,
                       const Number* blocks)
    : rows_(rows), columns_(columns), start_(start, start + n_rows + 1) {
  const auto n_slots = static_cast<std::size_t>(start_.back());
  assign_in_large_pages(column_, n_slots, Index{0});
  std::copy_n(column, n_slots, column_.begin());
  assign_in_large_pages(value_, n_slots * static_cast<std::size_t>(rows * columns) + k_overhang, 0.0F);
  float* to = value_.data();
  for (std::size_t s = 0; s < n_slots; ++s, blocks += rows * columns)
    for (int c = 0; c < columns; ++c)
      for (int r = 0; r < rows; ++r) *to++ = static_cast<float>(blocks[r * columns + c]);
}

template PackedRows::PackedRows(int, int, const std::int64_t*, Index, const Index*, const double*);
template PackedRows::PackedRows(int, int, const std::int64_t*, Index, const Index*, const float*);

void PackedRows::multiply(const float* x, float* y) const {
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_rows<rows, columns, false>(start_, column_.data(), value_.data(), x, y);
  });
}

void PackedRows::multiply_add(const float* x, float* y) const {
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_rows<rows, columns, true>(start_, column_.data(), value_.data(), x, y);
  });
}

void PackedRows::multiply_transposed_add(const float* x, float* y) const {
  with_block_sizes(rows_, columns_, [&]<int rows, int columns>() {
    multiply_transposed<rows, columns>(start_, column_.data(), value_.data(), x, y);
  });
}

std::size_t PackedRows::bytes() const {
  return start_.capacity() * sizeof start_[0] + column_.capacity() * sizeof column_[0] +
         value_.capacity() * sizeof value_[0];
}

}  // namespace solidus::algebra
