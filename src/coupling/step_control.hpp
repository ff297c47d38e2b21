/// The size of the next step: lands on output times, cuts after a rejection, grows when steps are easy.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace solidus::coupling {

struct StepOptions {
  double step = 1;          ///< the step asked for [s]
  bool adaptive = false;    ///< may grow beyond `step`, up to max_step
  double min_step = 0;      ///< [s]; zero: step / 1024
  double max_step = 0;      ///< [s]; zero: 10 × step when adaptive, else step
  double growth = 1.5;      ///< factor after an easy step
  double cut = 0.5;         ///< factor after a rejection
  int easy_iterations = 6;  ///< a step whose phases all took at most this many Newton iterations is easy

  bool operator==(const StepOptions&) const = default;
};

/// A planned step: from the present time to `time`.
struct PlannedStep {
  double time = 0;     ///< t_{n+1}, exactly a landing where the step ends at one
  double dt = 0;       ///< t_{n+1} − t_n
  std::string reason;  ///< why this size, for steps.csv
};

class StepControl {
 public:
  /// @param landings times that must be met exactly (output times, the end), any order; those before `start`
  /// are ignored Throws std::invalid_argument for sizes that are not positive or contradict each other, or if
  /// no landing lies ahead.
  StepControl(const StepOptions& options, double start, std::vector<double> landings);

  bool finished(double time) const { return time >= end_; }
  double end() const { return end_; }
  PlannedStep plan(double time) const;
  /// The step went through; `iterations` is the largest Newton count of its phases.
  void accepted(int iterations);
  /// The step did not go through. False when the next one would fall below the smallest step allowed.
  bool rejected(const PlannedStep& step);
  bool is_landing(double time) const;

  /// What a checkpoint keeps.
  double present_size() const { return size_; }
  const std::string& present_reason() const { return reason_; }
  void resume(double size, std::string reason) {
    size_ = size;
    reason_ = std::move(reason);
  }

 private:
  StepOptions options_;
  std::vector<double> landings_;  ///< rising
  double end_ = 0;
  double size_ = 0;  ///< the size wanted, before landing
  std::string reason_ = "as asked";
};

}  // namespace solidus::coupling
