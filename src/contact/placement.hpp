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
  void place(double time, std::span<const double> displacement,
             ContactKinematics::Points points = ContactKinematics::Points::all) {
    const bool enough = points_ == ContactKinematics::Points::all || points_ == points;
    if (placed_ && enough && time == time_ && std::ranges::equal(displacement, displacement_)) return;
    kinematics_.set_time(time);
    kinematics_.place(displacement, points);
    placed_ = true;
    points_ = points;
    time_ = time;
    displacement_.assign(displacement.begin(), displacement.end());
  }

  /// Somebody else has placed them.
  void forget() { placed_ = false; }

 private:
  ContactKinematics& kinematics_;
  bool placed_ = false;
  ContactKinematics::Points points_ = ContactKinematics::Points::all;
  double time_ = 0;
  std::vector<double> displacement_;
};

}  // namespace solidus::contact
