/// The entries that a derivative that is not symmetric has besides a symmetric matrix.
#pragma once

#include <cmath>
#include <vector>

#include "linear/block_matrix.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

class UnsymmetricPart {
 public:
  struct Entry {
    Index row, column;
    double value;  ///< [W/K]
  };
  void clear() { entries_.clear(); }
  /// Of owned rows.
  const std::vector<Entry>& entries() const { return entries_; }
  /// Notes by how much the derivative differs from an entry off the diagonal and, where the matrix keeps
  /// half of itself, from its mirror image.
  /// @param exact, mirrored  the derivatives there
  /// @param n_owned          nodes of this process
  void note(const linear::BlockMatrix& matrix, Index n_owned, Index row, Index column, double entry,
            double exact, double mirrored) {
    constexpr double k_rounding = 1e-12;
    const double threshold = k_rounding * std::abs(entry);
    if (std::abs(exact - entry) > threshold) entries_.push_back({row, column, exact - entry});
    if (matrix.storage() == linear::BlockMatrix::Storage::upper && column < n_owned &&
        std::abs(mirrored - entry) > threshold)
      entries_.push_back({column, row, mirrored - entry});
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace solidus::heat
