/// A quantity over time whose clock may start with a stage of the run.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "numbers/table.hpp"

namespace solidus {

/// y(t) = table(t − start), held at table(duration) from the end of the stage on, so that rounding of the
/// stage's times never leaves the table. Without a stage the table is one of the time of the run.
class TimeFunction {
 public:
  TimeFunction() = default;
  TimeFunction(double constant) : table_(constant) {}      // NOLINT: a number is a constant function
  TimeFunction(Table table) : table_(std::move(table)) {}  // NOLINT: a table is a function of the run's time
  /// @param start, duration of the stage [s]
  TimeFunction(Table table, double start, double duration)
      : table_(std::move(table)), start_(start), duration_(duration) {}

  double value(double time) const { return table_.value(on_clock(time)); }
  /// dy/dt from that time on; at the end of the stage, up to it.
  double derivative(double time) const { return table_.derivative(on_clock(time)); }
  bool constant() const { return table_.constant(); }
  const Table& table() const { return table_; }
  /// Adds the times in (from, to) at which its slope may change.
  void add_bends(double from, double to, std::vector<double>& times) const {
    const auto x = table_.x();
    if (constant()) return;
    for (auto i = std::upper_bound(x.begin(), x.end(), from - start_); i != x.end() && *i < to - start_; ++i)
      times.push_back(start_ + *i);
    if (start_ + duration_ > from && start_ + duration_ < to) times.push_back(start_ + duration_);
  }

 private:
  double on_clock(double time) const { return time >= start_ + duration_ ? duration_ : time - start_; }

  Table table_;
  double start_ = 0;
  double duration_ = std::numeric_limits<double>::infinity();
};

}  // namespace solidus
