/// Segments of a path are cut into steps; values are linear within a segment.
#include "point/loading.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::point {

namespace {

/// Relative difference below which a target is there already: the accuracy of stresses found by iteration.
constexpr double k_same = 1e-9;
/// The rounding of a sum of steps, as a share of the duration.
constexpr double k_rounding = 1e-12;

/// The time that a ramp with target and rate takes; the sign of the rate follows from the target.
std::optional<double> time_needed(const Ramp& ramp, double from) {
  if (!ramp.target || !ramp.rate) return std::nullopt;
  const double way = std::abs(*ramp.target - from);
  if (way <= k_same * std::max(std::abs(*ramp.target), std::abs(from))) return 0;
  return way / std::abs(*ramp.rate);
}

double duration_of(const Segment& segment, const Target& begin) {
  std::optional<double> duration = segment.duration;
  for (int i = 0; i < 6 && !duration; ++i)
    duration = time_needed(segment.components[as_size(i)], begin.value[i]);
  if (!duration) duration = time_needed(segment.temperature, begin.temperature);
  if (!duration || !(*duration > 0) || !std::isfinite(*duration))
    throw InputError(segment.where, "the segment takes no time: its target is there already",
                     "a target that differs from what is there, and a rate that is not zero");
  return *duration;
}

double value_at_end(const Ramp& ramp, double from, double duration) {
  if (ramp.target) return *ramp.target;
  return ramp.rate ? from + *ramp.rate * duration : from;
}

/// The factor by which n steps grow that begin with `first` and add up to `sum`: the root of
/// 1 + r + ... + r^(n−1) = sum/first, which rises with r.
double growth(double first, double sum, int n) {
  double low = 1, high = 1e3;
  if (first * n >= sum) return 1;
  for (int i = 0; i < 200; ++i) {
    const double r = 0.5 * (low + high);
    (first * std::expm1(n * std::log(r)) / (r - 1) < sum ? low : high) = r;
  }
  return 0.5 * (low + high);
}

}  // namespace

void check_duration(const Segment& segment) {
  int given = segment.duration ? 1 : 0;
  const auto count = [&](const Ramp& ramp) { given += ramp.target && ramp.rate ? 1 : 0; };
  for (const ComponentRamp& ramp : segment.components) count(ramp);
  count(segment.temperature);
  if (given != 1)
    throw InputError(segment.where,
                     given == 0 ? "the segment has no duration" : "the segment's duration is given twice",
                     "its duration, or to one ramp both a target and a rate that lead there");
}

Path::Path(const Segment& segment, const Sym<double>& strain, const Sym<double>& stress, double temperature)
    : segment_(&segment) {
  begin_.temperature = temperature;
  for (int i = 0; i < 6; ++i) {
    const auto k = as_size(i);
    begin_.of[k] = segment.components[k].of;
    begin_.value[i] = begin_.of[k] == Control::strain ? strain[i] : stress[i];
  }
  duration_ = duration_of(segment, begin_);
  end_ = begin_;
  for (int i = 0; i < 6; ++i)
    end_.value[i] = value_at_end(segment.components[as_size(i)], begin_.value[i], duration_);
  end_.temperature = value_at_end(segment.temperature, temperature, duration_);
}

Target Path::at(double time) const {
  if (time >= (1 - k_rounding) * duration_) return end_;
  const double part = time / duration_;
  Target target = begin_;
  target.value = (1 - part) * begin_.value + part * end_.value;
  target.temperature = (1 - part) * begin_.temperature + part * end_.temperature;
  return target;
}

std::vector<double> Path::steps() const {
  const int n = segment_->steps;
  const double even = duration_ / n, first = segment_->first_step.value_or(even);
  const double factor = first < even ? growth(first, duration_, n) : 1;
  std::vector<double> sizes;
  double size = factor == 1 ? even : first;
  for (int i = 0; i < n; ++i, size *= factor) sizes.push_back(size);
  return sizes;
}

}  // namespace solidus::point
