/// Value, slope and integral of a piecewise-linear function, with what happens beyond its ends in one
/// place.
#include "numbers/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace solidus {
namespace {

/// ∫_a^b y/x dx of y = y_a + m (x − a):  (y_a − m a) ln(b/a) + m (b − a).
double entropy_of_part(double a, double b, double y_a, double m) {
  return (y_a - m * a) * std::log1p((b - a) / a) + m * (b - a);
}

}  // namespace

Table::Table() = default;
Table::Table(const Table&) = default;
Table::Table(Table&&) noexcept = default;
Table& Table::operator=(const Table&) = default;
Table& Table::operator=(Table&&) noexcept = default;
Table::~Table() = default;

Table::Table(double y) : y_{y} {
  if (!std::isfinite(y)) throw std::invalid_argument("a constant is not a finite number");
}

Table::Table(std::vector<double> x, std::vector<double> y, Extrapolation extrapolation)
    : x_(std::move(x)), y_(std::move(y)), extrapolation_(extrapolation) {
  // A table without points, with numbers that are none, or with arguments that do not rise is refused with
  // the place of the point.
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
  // Pieces begin at each point with their value and slope. One more at the last point makes its value exact.
  std::vector<Pieces::Piece> pieces;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i)
    pieces.push_back({x_[i], y_[i], (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i])});
  pieces.push_back({x_.back(), y_.back(), pieces.back().slope});  // exact at the last point too
  pieces_ = Pieces(std::move(pieces));
}

bool Table::flat(double x) const {
  return extrapolation_ != Extrapolation::linear && (x < x_.front() || x > x_.back());
}

Table::Line<double> Table::line(double x) const {
  if (constant()) return {y_[0], 0.0};
  if (flat(x)) return {x < x_.front() ? y_.front() : y_.back(), 0.0};
  return pieces_.line(x);
}

Table::Line<Lane> Table::line_of_lanes(const Lane& x) const {
  if (extrapolation_ == Extrapolation::linear) return pieces_.line(x);
  const Lane first(x_.front()), last(x_.back());
  const LaneMask below = x<first, above = x> last;
  Line<Lane> line = pieces_.line(select(below, first, select(above, last, x)));
  line.slope = select(below | above, Lane(0.0), line.slope);
  return line;
}

template <class Part>
double Table::add_parts(double a, double b, Part part) const {
  // The interval is cut at the points of the table; each part is given its ends, the value at its start and
  // its slope. Beyond the table values are constant, or go on along the last line.
  if (a > b) return -add_parts(b, a, part);
  if (constant()) return part(a, b, y_[0], 0.0);
  // Before the table.
  double total = 0;
  double from = a;
  const bool linear = extrapolation_ == Extrapolation::linear;
  if (!linear && from < x_.front()) {
    const double to = std::min(b, x_.front());
    total += part(from, to, y_.front(), 0.0);
    from = to;
  }
  // Within it, piece by piece; the last piece goes on where the table is extrapolated.
  if (from < b && (linear || from < x_.back())) {
    const std::size_t n = x_.size() - 1;
    for (std::size_t i = std::min(pieces_.index(from), n - 1); from < b && i < n; ++i) {
      const bool last = i + 1 == n;
      const double to = last && linear ? b : std::min(b, x_[i + 1]);
      total += part(from, to, y_[i] + pieces_[i].slope * (from - x_[i]), pieces_[i].slope);
      from = to;
    }
  }
  // Behind it.
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
  std::vector<double> y = y_;
  for (double& value : y) value *= factor;
  return Table(x_, std::move(y), extrapolation_);
}

}  // namespace solidus
