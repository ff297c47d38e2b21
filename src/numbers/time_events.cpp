/// Corners of tables by Douglas and Peucker, breaks of arbitrary functions by comparing values on a grid
/// and zooming in.
#include "numbers/time_events.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus {

namespace {

struct Corner {
  double x, y;
};

/// A stretch of points between two that have been chosen, and its point farthest from the line between them.
struct Stretch {
  std::size_t first, last, farthest;
  double distance;
  bool operator<(const Stretch& other) const { return distance < other.distance; }
};

Stretch stretch(const std::vector<Corner>& points, std::size_t first, std::size_t last) {
  Stretch s{first, last, first, 0};
  const Corner &a = points[first], &b = points[last];
  for (std::size_t i = first + 1; i < last; ++i) {
    const double on_line = a.y + (b.y - a.y) * ((points[i].x - a.x) / (b.x - a.x));
    if (const double distance = std::abs(points[i].y - on_line); distance > s.distance)
      s.distance = distance, s.farthest = i;
  }
  return s;
}

/// Where a function bends or jumps, by zooming in; `half` is half the width of the interval.
class Zoom {
 public:
  Zoom(const std::function<double(double)>& f, double low, double high) : f_(f), low_(low), high_(high) {}

  /// The two sides of the jump that most of the change across the interval is; false: there is none.
  bool find_jump() {
    // The interval is halved towards the half that changes more; a smooth function's change would
    // halve too.
    double a = f_(low_), b = f_(high_);
    const double change = std::abs(b - a);
    for (int i = 0; i < k_halvings; ++i) {
      const double middle = low_ + 0.5 * (high_ - low_);
      if (!(middle > low_ && middle < high_)) break;
      const double m = f_(middle);
      if (std::abs(m - a) >= std::abs(b - m))
        high_ = middle, b = m;
      else
        low_ = middle, a = m;
      if (!(std::abs(b - a) > k_stays * change)) return false;
    }
    return true;
  }
  /// Narrows the interval to where the slope changes most; false where it changes smoothly.
  bool find_bend() {
    const double before = bend(low_, high_);
    for (int i = 0; i < k_zooms; ++i) {
      const double quarter = 0.25 * (high_ - low_), middle = low_ + 2 * quarter;
      double best = -1, at = middle;
      for (const double centre : {low_ + quarter, middle, high_ - quarter})
        if (const double b = bend(centre - quarter, centre + quarter); b > best) best = b, at = centre;
      low_ = at - quarter;
      high_ = at + quarter;
    }
    return bend(low_, high_) > before * std::pow(0.5, k_zooms) * k_stays;
  }
  double middle() const { return low_ + 0.5 * (high_ - low_); }
  double high() const { return high_; }

 private:
  static constexpr int k_halvings = 60, k_zooms = 12;
  static constexpr double k_stays = 0.25;
  double bend(double low, double high) const {
    return std::abs(f_(low) - 2 * f_(low + 0.5 * (high - low)) + f_(high));
  }
  const std::function<double(double)>& f_;
  double low_, high_;
};

}  // namespace

std::vector<double> corners(const Table& table, double from, double to, double tolerance) {
  std::vector<double> chosen;
  if (table.constant() || !(from < to)) return chosen;
  // Corners are chosen by Douglas and Peucker's method: the point that lies farthest from the straight line
  // between its neighbours first, until none is farther off than the tolerance.
  std::vector<Corner> points{{from, table.value(from)}};
  const auto x = table.x(), y = table.y();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] > from && x[i] < to) points.push_back({x[i], y[i]});
  points.push_back({to, table.value(to)});
  std::priority_queue<Stretch> open;
  open.push(stretch(points, 0, points.size() - 1));
  while (!open.empty() && open.top().distance > tolerance && chosen.size() < as_size(k_most_events)) {
    const Stretch s = open.top();
    open.pop();
    chosen.push_back(points[s.farthest].x);
    open.push(stretch(points, s.first, s.farthest));
    open.push(stretch(points, s.farthest, s.last));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<TimeEvent> breaks(const std::function<double(double)>& f, double from, double to,
                              double spacing) {
  constexpr double k_least = 4096, k_most = 262144;
  constexpr double k_small_jump = 1e-3, k_small_bend = 0.02;  ///< as shares of the range of values
  std::vector<TimeEvent> found;
  if (!(from < to)) return found;
  const auto n = static_cast<std::size_t>(std::clamp((to - from) / spacing, k_least, k_most));
  const double step = (to - from) / static_cast<double>(n);
  const auto at = [&](std::size_t i) { return i == n ? to : from + static_cast<double>(i) * step; };
  // The function on an even grid, and the range of its values.
  std::vector<double> values(n + 1);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i <= n; ++i) {
    values[i] = f(at(i));
    if (!std::isfinite(values[i])) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  const double range = high - low;
  if (!(range > 0)) return found;
  const auto add = [&](double time, bool jump) {
    if (time > from && time < to) found.push_back({time, false, jump});
  };
  // Steep intervals are searched for a jump, those without one for a bend at their ends.
  std::vector<char> jumps(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(values[i + 1] - values[i]) > k_small_jump * range)) continue;
    Zoom zoom(f, at(i), at(i + 1));
    if (!zoom.find_jump()) continue;
    jumps[i] = 1;
    add(zoom.high(), true);
    if (found.size() > as_size(k_most_events)) return {};
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (jumps[i - 1] != 0 || jumps[i] != 0) continue;
    const double bend = std::abs(values[i - 1] - 2 * values[i] + values[i + 1]);
    if (!(bend * static_cast<double>(n) > k_small_bend * range)) continue;
    // A bend between two times of the grid is seen from both.
    if (const auto next = std::abs(values[i] - 2 * values[i + 1] + values[std::min(i + 2, n)]);
        i + 2 <= n && next > bend)
      continue;
    Zoom zoom(f, at(i - 1), at(i + 1));
    if (zoom.find_bend()) add(zoom.middle(), false);
    if (found.size() > as_size(k_most_events)) return {};
  }
  return found;
}

std::vector<TimeEvent> in_order(std::vector<TimeEvent> events, double same, double shortest) {
  std::sort(events.begin(), events.end(),
            [](const TimeEvent& a, const TimeEvent& b) { return a.time < b.time; });
  // Events nearer than the shortest step become one, which jumps if either does.
  std::vector<TimeEvent> kept;
  for (const TimeEvent& event : events) {
    if (!kept.empty() && event.time - kept.back().time <= (event.at_ends ? same : shortest)) {
      kept.back().jump = kept.back().jump || event.jump;
      if (event.time - kept.back().time <= same) kept.back().at_ends |= event.at_ends;
      continue;
    }
    kept.push_back(event);
  }
  return kept;
}

}  // namespace solidus
