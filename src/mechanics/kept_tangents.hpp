/// The tangents of the last forces of a law that costs much to ask: an iteration of Newton's method assembles
/// forces and then the tangent at the same strains.
#pragma once

#include <algorithm>
#include <limits>

#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus::mechanics {

/// w C by its symmetric and its skew part; the latter is not filled where a law is symmetric.
struct SplitTangent {
  Sym4<Lane> symmetric, skew;

  SplitTangent(const Sym4<Lane>& c, const Lane& weight, bool is_symmetric) {
    const Lane half = Lane(0.5) * weight;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
        symmetric[i][column] = half * (c[i][column] + c[j][row]);
        if (!is_symmetric) skew[i][column] = half * (c[i][column] - c[j][row]);
      }
  }
};

class KeptTangents {
 public:
  /// Forgets all.
  void clear() { numbers_.clear(); }
  /// @param n_points  of the block, [batch][point]
  void keep(std::size_t n_points, std::size_t point, const Sym<Lane>& strain, const Sym4<Lane>& tangent) {
    if (numbers_.empty()) {
      numbers_.resize(n_points * k_numbers);
      for (std::size_t i = 0; i < n_points; ++i)
        numbers_[i * k_numbers] = Lane(std::numeric_limits<double>::quiet_NaN());
    }
    Lane* const to = numbers_.data() + point * k_numbers;
    std::copy_n(strain.c.data(), 6, to);
    for (int i = 0; i < 6; ++i) std::copy_n(tangent[i].data(), 6, to + 6 * (i + 1));
  }
  /// Reads the tangent of a point where it was kept at this strain, to the last bit in all lanes.
  bool find(std::size_t point, const Sym<Lane>& strain, Sym4<Lane>& tangent) const {
    if (numbers_.empty()) return false;
    const Lane* from = numbers_.data() + point * k_numbers;
    LaneMask same = from[0] == strain[0];
    for (int i = 1; i < 6; ++i) same = same & (from[i] == strain[i]);
    if (any(!same)) return false;
    for (int i = 0; i < 6; ++i) std::copy_n(from + 6 * (i + 1), 6, tangent[i].data());
    return true;
  }
  std::size_t bytes() const { return numbers_.capacity() * sizeof(Lane); }

 private:
  static constexpr std::size_t k_numbers = 6 + 36;
  PackVector<Lane> numbers_;  ///< [point][strain, tangent]; empty: none
};

}  // namespace solidus::mechanics
