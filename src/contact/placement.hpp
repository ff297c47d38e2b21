/// Where a pair's surfaces stand: places its kinematics once for each displacement, whoever asks.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contact/kinematics.hpp"

namespace solidus::contact {

class Placement {
 public:
  /// Keeps a reference.
  explicit Placement(ContactKinematics& kinematics) : kinematics_(kinematics) {}

  const ContactKinematics& kinematics() const { return kinematics_; }
  void place(double time, std::span<const double> displacement) {
    if (placed_ && time == time_ && std::ranges::equal(displacement, displacement_)) return;
    kinematics_.set_time(time);
    kinematics_.place(displacement);
    placed_ = true;
    time_ = time;
    displacement_.assign(displacement.begin(), displacement.end());
  }

  /// Somebody else has placed them.
  void forget() { placed_ = false; }

 private:
  ContactKinematics& kinematics_;
  bool placed_ = false;
  double time_ = 0;
  std::vector<double> displacement_;
};

}  // namespace solidus::contact
