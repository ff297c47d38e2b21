/// The tangents of the last forces of a law that costs much to ask: an iteration of Newton's method assembles
/// forces and then the tangent at the same displacements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus::mechanics {

/// w (C + Cᵀ)/2.
inline Sym4<Lane> symmetric_part(const Sym4<Lane>& c, const Lane& weight) {
  const Lane half = Lane(0.5) * weight;
  Sym4<Lane> part;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) part.c[i][j] = part.c[j][i] = half * (c.c[i][j] + c.c[j][i]);
  return part;
}
/// w (C − Cᵀ)/2.
inline Sym4<Lane> skew_part(const Sym4<Lane>& c, const Lane& weight) {
  const Lane half = Lane(0.5) * weight;
  Sym4<Lane> part;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      part.c[i][j] = half * (c.c[i][j] - c.c[j][i]);
      part.c[j][i] = -part.c[i][j];
    }
  return part;
}

/// A symmetric law keeps the symmetric part of its tangent, which is all that the assembly reads.
class KeptTangents {
 public:
  explicit KeptTangents(bool symmetric) : symmetric_(symmetric) {}

  /// Forgets all.
  void clear() { displacement_.clear(); }
  /// The tangents that keep() is given from now on are those at displacement u.
  void begin(std::span<const double> u, std::size_t n_points) {
    displacement_.assign(u.begin(), u.end());
    numbers_.resize(n_points * size());
  }
  void keep(std::size_t point, const Sym4<Lane>& tangent) {
    Lane* to = numbers_.data() + point * size();
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < (symmetric_ ? i + 1 : 6); ++j)
        *to++ = symmetric_ ? Lane(0.5) * (tangent.c[i][j] + tangent.c[j][i]) : tangent.c[i][j];
  }
  /// Whether there are tangents at u, to the last bit.
  bool are_at(std::span<const double> u) const {
    return !displacement_.empty() &&
           std::equal(u.begin(), u.end(), displacement_.begin(), displacement_.end());
  }
  Sym4<Lane> at(std::size_t point) const {
    const Lane* from = numbers_.data() + point * size();
    Sym4<Lane> tangent;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < (symmetric_ ? i + 1 : 6); ++j) {
        tangent.c[i][j] = *from++;
        if (symmetric_) tangent.c[j][i] = tangent.c[i][j];
      }
    return tangent;
  }
  std::size_t bytes() const {
    return numbers_.capacity() * sizeof(Lane) + displacement_.capacity() * sizeof(double);
  }

 private:
  std::size_t size() const { return symmetric_ ? 21 : 36; }

  bool symmetric_;
  std::vector<double> displacement_;  ///< empty: no tangents
  PackVector<Lane> numbers_;          ///< [point][entry]
};

}  // namespace solidus::mechanics
