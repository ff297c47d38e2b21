#include "base/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace solidus {
namespace {

constexpr std::size_t k_max_buckets = 4096;
/// Tables of so few pieces choose by comparison for all lanes at once. That pays where a register holds a
/// whole Lane; below AVX-512 g++ 12 compares lane by lane anyway, and a look-up of each lane is faster.
#if defined(__AVX512F__)
constexpr std::size_t k_few_pieces = 6;
#else
constexpr std::size_t k_few_pieces = 0;
#endif

/// ∫_a^b y/x dx of y = y_a + m (x − a):  (y_a − m a) ln(b/a) + m (b − a).
double entropy_of_part(double a, double b, double y_a, double m) {
  return (y_a - m * a) * std::log1p((b - a) / a) + m * (b - a);
}

}  // namespace

Table::Table(double y) : y_{y} {
  if (!std::isfinite(y)) throw std::invalid_argument("a constant is not a finite number");
}

Table::Table(std::vector<double> x, std::vector<double> y, Extrapolation extrapolation)
    : x_(std::move(x)), y_(std::move(y)), extrapolation_(extrapolation) {
  if (x_.size() != y_.size()) throw std::invalid_argument("a table needs as many values as arguments");
  if (x_.empty()) throw std::invalid_argument("a table needs at least one point");
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const std::string place = "point " + std::to_string(i + 1) + " of the table";
    if (!std::isfinite(x_[i]) || !std::isfinite(y_[i]))
      throw std::invalid_argument(place + " is not a finite number");
    if (i > 0 && x_[i] <= x_[i - 1])
      throw std::invalid_argument(place + " is not beyond the point before it");
  }
  if (constant()) return;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) slope_.push_back((y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]));

  // As many buckets as the shortest piece asks for, so that a look-up steps at most one piece further; a
  // table with very unequal pieces gets the largest number and may step a few pieces.
  const double range = x_.back() - x_.front();
  double shortest = range;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) shortest = std::min(shortest, x_[i + 1] - x_[i]);
  const auto count = static_cast<std::size_t>(std::min(std::ceil(range / shortest), double{k_max_buckets}));
  bucket_scale_ = static_cast<double>(count) / range;
  for (std::size_t b = 0, piece = 0; b < count; ++b) {
    const double start = x_.front() + static_cast<double>(b) / bucket_scale_;
    while (piece + 2 < x_.size() && x_[piece + 1] <= start) ++piece;
    bucket_.push_back(piece);
  }
}

std::size_t Table::interval(double x) const {
  const double place = (x - x_.front()) * bucket_scale_;
  if (!(place > 0)) return 0;  // a NaN too
  std::size_t i =
      bucket_[std::min(static_cast<std::size_t>(std::min(place, double{k_max_buckets})), bucket_.size() - 1)];
  while (i + 2 < x_.size() && x_[i + 1] <= x) ++i;
  while (i > 0 && x < x_[i]) --i;  // the bucket's start is rounded
  return i;
}

bool Table::flat(double x) const {
  return extrapolation_ != Extrapolation::linear && (x < x_.front() || x > x_.back());
}

Table::Line<double> Table::line(double x) const {
  if (constant()) return {y_[0], 0.0};
  if (flat(x)) return {x < x_.front() ? y_.front() : y_.back(), 0.0};
  const std::size_t i = interval(x);
  // exact at the last point too
  return {x == x_.back() ? y_.back() : y_[i] + slope_[i] * (x - x_[i]), slope_[i]};
}

Table::Line<Lane> Table::line_of_lanes(Lane x) const {
  if (slope_.size() > k_few_pieces) {
    Line<Lane> result;
    for (int lane = 0; lane < k_lanes; ++lane) {
      const Line<double> at = line(x[lane]);
      result.value.set(lane, at.value);
      result.slope.set(lane, at.slope);
    }
    return result;
  }
  Lane x0(x_[0]), y0(y_[0]), slope(slope_[0]);
  for (std::size_t i = 1; i < slope_.size(); ++i) {
    const LaneMask beyond = x >= Lane(x_[i]);
    x0 = select(beyond, Lane(x_[i]), x0);
    y0 = select(beyond, Lane(y_[i]), y0);
    slope = select(beyond, Lane(slope_[i]), slope);
  }
  Lane y = y0 + slope * (x - x0);
  const Lane last(x_.back());
  y = select(x == last, Lane(y_.back()), y);  // as value(double): exact at the points
  if (extrapolation_ != Extrapolation::linear) {
    const LaneMask below = x<Lane(x_.front()), above = x> last;
    y = select(below, Lane(y_.front()), select(above, Lane(y_.back()), y));
    slope = select(below | above, Lane(0.0), slope);
  }
  return {y, slope};
}

template <class Part>
double Table::add_parts(double a, double b, Part part) const {
  if (a > b) return -add_parts(b, a, part);
  if (constant()) return part(a, b, y_[0], 0.0);
  double total = 0;
  double from = a;
  const bool linear = extrapolation_ == Extrapolation::linear;
  if (!linear && from < x_.front()) {
    const double to = std::min(b, x_.front());
    total += part(from, to, y_.front(), 0.0);
    from = to;
  }
  if (from < b && (linear || from < x_.back())) {
    for (std::size_t i = interval(from); from < b && i < slope_.size(); ++i) {
      const bool last = i + 1 == slope_.size();
      const double to = last && linear ? b : std::min(b, x_[i + 1]);
      total += part(from, to, y_[i] + slope_[i] * (from - x_[i]), slope_[i]);
      from = to;
    }
  }
  if (from < b) total += part(from, b, y_.back(), 0.0);
  return total;
}

double Table::integral(double a, double b) const {
  return add_parts(a, b, [](double from, double to, double y_from, double m) {
    return (to - from) * (y_from + 0.5 * m * (to - from));
  });
}

double Table::integral_over_x(double a, double b) const {
  return add_parts(a, b, entropy_of_part);
}

bool Table::outside(double x) const {
  return extrapolation_ == Extrapolation::error && !constant() && (x < x_.front() || x > x_.back());
}

double Table::min_value() const {
  return *std::min_element(y_.begin(), y_.end());
}
double Table::max_value() const {
  return *std::max_element(y_.begin(), y_.end());
}

Table Table::scaled(double factor) const {
  Table result = *this;
  for (double& y : result.y_) y *= factor;
  for (double& m : result.slope_) m *= factor;
  return result;
}

}  // namespace solidus
