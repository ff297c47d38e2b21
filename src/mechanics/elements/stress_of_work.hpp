/// The stress whose work a step does: that at its end, the mean of those at both ends in a dynamic step, or
/// the one that an earlier solve of the step has left (StepStart::at_work). Elements ask for it at their
/// points, and in the same way for the pressures that mixed elements have besides.
#pragma once

#include <cstring>

#include "mechanics/elements/block_kernel.hpp"

namespace solidus::mechanics {

class StressOfWork {
 public:
  void begin_step(const StepStart& start) {
    old_ = start.old_stress;
    share_ = start.stress_share;
    given_ = start.at_work;
  }
  /// The weight of the stress at the end of the step in the mean of both ends.
  double share() const { return share_; }
  /// The stress of an earlier solve; null: there is none.
  const StressAtWork* given() const { return given_; }

  /// The mean over the step of a stress, or of a pressure; what it is at the end where the step is not
  /// dynamic.
  /// @param old  at t_n, as a function: it is read where it counts
  template <class Stress, class Old>
  Stress mean(const Stress& now, const Old& old) const {
    if (old_ == nullptr) return now;
    return Lane(share_) * now + Lane(1.0 - share_) * old();
  }
  /// The mean of the stresses at a point.
  /// @param point  [batch][point]
  Sym<Lane> mean_at(std::size_t point, const Sym<Lane>& now) const {
    return mean(now, [&] {
      Sym<Lane> old;
      std::memcpy(static_cast<void*>(&old), old_->values.data() + point * k_lanes_of_stress, sizeof old);
      return old;
    });
  }
  /// Writes the stress at a point for those who ask for it, and returns that whose work the step does.
  Sym<Lane> record(std::size_t point, const Sym<Lane>& now, const BlockEnd& end) const {
    if (end.stress != nullptr)
      std::memcpy(static_cast<void*>(end.stress->values.data() + point * k_lanes_of_stress), &now,
                  sizeof now);
    const Sym<Lane> at_work = mean_at(point, now);
    if (end.at_work != nullptr) end.at_work->stress[point] = at_work;
    return given_ != nullptr ? given_->stress[point] : at_work;
  }

 private:
  static constexpr std::size_t k_lanes_of_stress = sizeof(Sym<Lane>) / sizeof(Lane);

  const BlockHistory* old_ = nullptr;  ///< as StepStart::old_stress
  double share_ = 1;
  const StressAtWork* given_ = nullptr;
};

}  // namespace solidus::mechanics
