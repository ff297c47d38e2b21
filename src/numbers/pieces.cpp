/// A table of buckets leads to the piece in one step; lanes look up each of their values and share the
/// rest.
#include "numbers/pieces.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus {
namespace {

constexpr double k_max_buckets = 4096;

}  // namespace

Pieces::Pieces(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  assert(!pieces_.empty());
  for (const Piece& piece : pieces_) start_.push_back(piece.x);
  const std::size_t n = pieces_.size();
  if (n == 1) return;

  // Buckets of less than half the shortest piece hold at most one start, so that one comparison ends the
  // look-up; very unequal pieces get the largest number of buckets and a few comparisons more.
  const double range = start_.back() - start_.front();
  double shortest = range;
  for (std::size_t i = 0; i + 1 < n; ++i) shortest = std::min(shortest, start_[i + 1] - start_[i]);
  const double count = std::min(std::ceil(2.1 * range / shortest), k_max_buckets);
  bucket_scale_ = count / range;
  // Bucket b reaches from b - 1/2 to b + 1/2 in units of its width, and a little further: places are rounded.
  std::size_t most = 0;
  for (double b = 0; b <= count; ++b) {
    const auto piece_at = [&](double place) {
      const auto next =
          std::upper_bound(start_.begin() + 1, start_.end(), start_.front() + place / bucket_scale_);
      return as_size(next - start_.begin()) - 1;
    };
    const std::size_t first = piece_at(b - 0.51), last = piece_at(b + 0.51);
    bucket_.push_back(static_cast<std::uint32_t>(first));
    most = std::max(most, last - first);
  }
  // Strides of s, s/2, …, 1 reach 2 s - 1 pieces further.
  if (most > 0)
    for (first_stride_ = 1; 2 * first_stride_ - 1 < most;) first_stride_ *= 2;
  start_.resize(n + 2 * first_stride_, std::numeric_limits<double>::infinity());
}

std::size_t Pieces::index(double x) const {
  if (bucket_.empty()) return 0;
  const double place = (x - start_[0]) * bucket_scale_;
  if (!(place > 0)) return 0;  // a NaN too
  const double last = static_cast<double>(bucket_.size() - 1);
  std::size_t i = bucket_[static_cast<std::size_t>(std::min(place, last) + 0.5)];
  for (std::size_t stride = first_stride_; stride > 0; stride /= 2)
    if (x >= start_[i + stride]) i += stride;
  return i;
}

Pieces::Line<Lane> Pieces::line_by_look_up(const Lane& x) const {
  // Buckets of equal width say near which piece an argument lies; a few comparisons with falling stride find
  // the piece itself. Rounding to an integer is done by adding 2^52, whose last bits then hold it.
  const Lane zero(0.0), last(static_cast<double>(bucket_.size() - 1));
  Lane place = (x - Lane(start_[0])) * Lane(bucket_scale_);
  place = select(place > zero, place, zero);  // a NaN too
  place = min(place, last) + Lane(0x1p52);    // the nearest integer, in the last bits
  std::size_t i[k_lanes];
  for (int lane = 0; lane < k_lanes; ++lane)
    i[lane] = bucket_[static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(place[lane]))];
  for (std::size_t stride = first_stride_; stride > 0; stride /= 2)
    for (int lane = 0; lane < k_lanes; ++lane) i[lane] += x[lane] >= start_[i[lane] + stride] ? stride : 0;
  // The numbers of the pieces are gathered lane by lane, since each lane may be in another one.
  Lane start, value, slope;
  for (int lane = 0; lane < k_lanes; ++lane) {
    const Piece& piece = pieces_[i[lane]];
    start.set(lane, piece.x);
    value.set(lane, piece.y);
    slope.set(lane, piece.slope);
  }
  return {value + slope * (x - start), slope};
}

}  // namespace solidus
