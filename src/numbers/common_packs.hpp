/// Array of structs of lanes, one per quadrature point; a member that is the same at all points is stored
/// once.
///
/// Most properties at a point do not depend on temperature, and most of its results are zero until something
/// melts or flows. A member that differs anywhere gets a place at every point, and keeps it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "numbers/simd.hpp"

namespace solidus {

/// @tparam T  holds nothing but lanes
template <class T>
class CommonPacks {
  static constexpr std::size_t n_lanes = sizeof(T) / sizeof(Lane);
  static_assert(sizeof(T) == n_lanes * sizeof(Lane));
  using Lanes = std::array<Lane, n_lanes>;

 public:
  explicit CommonPacks(std::size_t n_points = 0) : n_points_(n_points) {}

  std::size_t size() const { return n_points_; }
  /// A point that has not been set reads as the first that was, zeros before that.
  T operator[](std::size_t point) const {
    Lanes lanes = common_;
    const Lane* from = values_.data() + point * own_.size();
    for (const std::size_t lane : own_) lanes[lane] = *from++;
    return std::bit_cast<T>(lanes);
  }
  void set(std::size_t point, const T& value) {
    const auto lanes = std::bit_cast<Lanes>(value);
    if (!any_set_) common_ = lanes;
    any_set_ = true;
    bool differs = false;
    for (std::size_t i = 0; i < n_lanes; ++i) {
      const bool here = !is_own_[i] && !same_bits(lanes[i], common_[i]);
      differs = differs || here;
      is_own_[i] = is_own_[i] || here;
    }
    if (differs) widen();
    Lane* to = values_.data() + point * own_.size();
    for (const std::size_t lane : own_) *to++ = lanes[lane];
  }
  /// Lanes that a point has of its own.
  std::size_t width() const { return own_.size(); }
  std::size_t bytes() const { return values_.capacity() * sizeof(Lane); }

 private:
  /// Zeros of different signs differ too, so that a point reads as it was set, whatever was set before.
  static bool same_bits(const Lane& a, const Lane& b) { return std::memcmp(&a, &b, sizeof(Lane)) == 0; }

  /// Makes places for the lanes that have come to differ.
  void widen() {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < n_lanes; ++i)
      if (is_own_[i]) own.push_back(i);
    PackVector<Lane> values(n_points_ * own.size());
    for (std::size_t point = 0; point < n_points_; ++point) {
      const auto lanes = std::bit_cast<Lanes>((*this)[point]);
      for (std::size_t k = 0; k < own.size(); ++k) values[point * own.size() + k] = lanes[own[k]];
    }
    own_ = std::move(own);
    values_ = std::move(values);
  }

  std::size_t n_points_;
  bool any_set_ = false;
  Lanes common_{};
  std::array<bool, n_lanes> is_own_{};
  std::vector<std::size_t> own_;  ///< lanes of the struct that differ, rising
  PackVector<Lane> values_;       ///< [point][own]
};

}  // namespace solidus
