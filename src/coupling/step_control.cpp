#include "coupling/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace solidus::coupling {

namespace {

// Two times closer than this share of the step are the same: sums of steps carry rounding errors.
constexpr double k_same_time = 1e-9;

}  // namespace

StepControl::StepControl(const StepOptions& options, double start, std::vector<double> landings)
    : options_(options), landings_(std::move(landings)) {
  if (!(options_.step > 0)) throw std::invalid_argument("the time step must be positive");
  if (options_.min_step <= 0) options_.min_step = options_.step / 1024;
  if (options_.max_step <= 0) options_.max_step = options_.adaptive ? 10 * options_.step : options_.step;
  if (!options_.adaptive) options_.max_step = options_.step;
  if (options_.min_step > options_.step || options_.max_step < options_.step)
    throw std::invalid_argument("min_step <= step <= max_step must hold");
  if (!(options_.growth > 1) || !(options_.cut > 0 && options_.cut < 1))
    throw std::invalid_argument("growth must exceed one and cut lie between zero and one");
  std::sort(landings_.begin(), landings_.end());
  std::erase_if(landings_, [start](double t) { return t <= start; });
  if (landings_.empty()) throw std::invalid_argument("the end time must lie after the start");
  end_ = landings_.back();
  size_ = options_.step;
}

PlannedStep StepControl::plan(double time) const {
  const double tolerance = k_same_time * size_;
  const auto next = std::upper_bound(landings_.begin(), landings_.end(), time + tolerance);
  const double landing = next == landings_.end() ? end_ : *next;
  const double rest = landing - time;
  if (rest <= size_ + tolerance)
    return {landing, rest, rest < size_ - tolerance ? (landing == end_ ? "end" : "output time") : reason_};
  // Two halves rather than a full step and a sliver, where the size is ours to choose.
  if (options_.adaptive && rest < 1.5 * size_) return {time + rest / 2, rest / 2, "output time ahead"};
  return {time + size_, size_, reason_};
}

void StepControl::accepted(int iterations) {
  if (size_ >= options_.max_step) {
    reason_ = options_.adaptive ? "largest allowed" : "as asked";
    return;
  }
  // After a cut the size comes back to what was asked even when steps are not easy: one hard moment must not
  // slow the rest.
  const bool easy = iterations <= options_.easy_iterations;
  if (!easy && size_ >= options_.step) {
    reason_ = "kept: many iterations";
    return;
  }
  const double ceiling = easy ? options_.max_step : options_.step;
  size_ = std::min(size_ * options_.growth, ceiling);
  reason_ = size_ == options_.step ? "as asked"
                                   : (size_ < options_.step ? "growing after a cut" : "growing: easy steps");
}

bool StepControl::rejected(const PlannedStep& step) {
  size_ = step.dt * options_.cut;
  reason_ = "cut after a rejected step";
  return size_ >= options_.min_step * (1 - k_same_time);
}

bool StepControl::is_landing(double time) const {
  return std::binary_search(landings_.begin(), landings_.end(), time);
}

}  // namespace solidus::coupling
