/// How long a run still takes, from how its steps grow. Freezing slows down as the shell gets thicker, and
/// adaptive steps grow with it, from a tenth of a second to minutes: the share of the time that is behind
/// would tell hours where minutes are left.
#pragma once

#include <deque>

namespace solidus::results {

class RemainingTime {
 public:
  /// @param largest_step  that the run may take [s of the casting]; 0 where its steps are equal
  RemainingTime(double start, double largest_step) : start_(start), largest_(largest_step) {}

  /// A step that has ended.
  /// @param time   of the casting [s]
  /// @param clock  of the machine [s]
  void step(double time, double clock);
  /// Steps grow again from here: a stage begins.
  void begin_anew();

  /// Seconds of the machine until the casting's time is `end`, at the pace of the last steps; negative where
  /// steps may grow and the first ones do not tell yet how.
  double seconds_until(double end) const;

  /// Steps from `time` to `end` where one has the length `dt` now, and later steps grow like
  /// (time since the start)^growth, up to the largest.
  double steps_left(double time, double end, double dt, double growth) const;

 private:
  /// The exponent p of the last steps, whose length follows the time since the start like t^p: 0 where they
  /// are equal. At least 1/2 where they adapt: a front that freezes in like √t passes equal distances in such
  /// steps.
  double growth() const;

  static constexpr std::size_t k_half = 4;  ///< steps in either half of what growth is taken from
  struct Moment {
    double time, clock;
  };
  double start_, largest_;
  std::deque<Moment> last_;  ///< ends of the last steps
};

}  // namespace solidus::results
