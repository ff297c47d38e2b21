/// Piecewise-linear functions: the piece that holds an argument is found in O(1), for a lane without a
/// branch.
#pragma once

#include <cstdint>
#include <vector>

#include "numbers/simd.hpp"

namespace solidus {

/// Straight pieces, each from its start to the start of the next; the first also continues to all smaller
/// arguments, the last to all greater ones.
class Pieces {
 public:
  struct Piece {
    double x;  ///< start
    double y;  ///< value at the start
    double slope;
  };
  /// Value and slope of a function at an argument.
  template <class T>
  struct Line {
    T value, slope;
  };

  Pieces() = default;
  /// At least one piece; finite numbers, starts strictly increasing.
  explicit Pieces(std::vector<Piece> pieces);

  std::size_t index(double x) const;  ///< the piece that holds x; of a NaN any
  const Piece& operator[](std::size_t i) const { return pieces_[i]; }
  std::size_t size() const { return pieces_.size(); }

  Line<double> line(double x) const {
    const Piece& piece = pieces_[index(x)];
    return {piece.y + piece.slope * (x - piece.x), piece.slope};
  }
  Line<Lane> line(const Lane& x) const {
    return pieces_.size() <= k_most_to_compare ? line_by_comparison(x) : line_by_look_up(x);
  }

 private:
  /// So few pieces are compared with all lanes at once, more are looked up: where bench/numbers_bench.cpp
  /// finds equal costs.
  static constexpr std::size_t k_most_to_compare = k_registers <= 2 ? 16 : 3;

  Line<Lane> line_by_comparison(const Lane& x) const;
  Line<Lane> line_by_look_up(const Lane& x) const;

  std::vector<Piece> pieces_;
  std::vector<double> start_;          ///< of each piece; infinity behind the last, for searches to stop
  std::vector<std::uint32_t> bucket_;  ///< the piece at the start of each of the equal buckets over the range
  double bucket_scale_ = 0;            ///< buckets per unit of x
  std::uint32_t first_stride_ = 0;     ///< of the search within a bucket: a power of two, 0 for no search
};

inline Pieces::Line<Lane> Pieces::line_by_comparison(const Lane& x) const {
  Lane start(pieces_[0].x), value(pieces_[0].y), slope(pieces_[0].slope);
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const LaneMask beyond = x >= Lane(pieces_[i].x);
    start = select(beyond, Lane(pieces_[i].x), start);
    value = select(beyond, Lane(pieces_[i].y), value);
    slope = select(beyond, Lane(pieces_[i].slope), slope);
  }
  return {value + slope * (x - start), slope};
}

}  // namespace solidus
