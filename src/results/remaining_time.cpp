/// The growth of the steps is fitted from those so far and carried on to the end.
#include "results/remaining_time.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::results {
namespace {

constexpr double k_least_growth = 0.5;

/// ∫ (t/t₀)^(−p) dt from t₀ to t₁.
double integral(double from, double to, double p) {
  const double ratio = to / from;
  if (p > 1 - 1e-6) return from * std::log(ratio);
  return from * (std::pow(ratio, 1 - p) - 1) / (1 - p);
}

}  // namespace

void RemainingTime::step(double time, double clock) {
  last_.push_back({time, clock});
  if (last_.size() > 2 * k_half + 1) last_.pop_front();
}

void RemainingTime::begin_anew() {
  if (last_.empty()) return;
  last_ = {last_.back()};
  start_ = last_.back().time;
}

double RemainingTime::growth() const {
  if (largest_ <= 0) return 0;
  // The mean length in two halves: an output time cuts single steps.
  const std::size_t half = (last_.size() - 1) / 2;
  const auto end = last_.size() - 1;
  const double a = last_[end - 2 * half].time, b = last_[end - half].time, c = last_[end].time;
  const double older = 0.5 * (a + b) - start_, newer = 0.5 * (b + c) - start_;
  return std::clamp(std::log((c - b) / (b - a)) / std::log(newer / older), k_least_growth, 1.0);
}

double RemainingTime::steps_left(double time, double end, double dt, double growth) const {
  if (end <= time) return 0;
  const double since = time - start_;
  if (growth <= 0 || since <= 0) return (end - time) / dt;
  const double full = largest_ > dt ? since * std::pow(largest_ / dt, 1 / growth) : since;
  const double grows_until = std::min(full, end - start_);
  double steps = integral(since, grows_until, growth) / dt;
  if (end - start_ > grows_until) steps += (end - start_ - grows_until) / std::max(largest_, dt);
  return steps;
}

double RemainingTime::seconds_until(double end) const {
  const std::size_t needed = largest_ > 0 ? 3 : 2;
  if (last_.size() < needed) return -1;
  const std::size_t n = std::min(k_half, last_.size() - 1);
  const Moment &from = last_[last_.size() - 1 - n], &to = last_.back();
  const double dt = (to.time - from.time) / static_cast<double>(n);
  const double pace = (to.clock - from.clock) / static_cast<double>(n);
  return pace * steps_left(to.time, end, dt, growth());
}

}  // namespace solidus::results
