/// Cache of the configuration of a pair's surfaces: it updates the kinematics once for each displacement,
/// however many terms ask for it.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contact/points/contact_kinematics.hpp"

namespace solidus::contact {

class CurrentConfiguration {
 public:
  /// Keeps a reference.
  explicit CurrentConfiguration(ContactKinematics& kinematics) : kinematics_(kinematics) {}

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

  /// Discards the cached configuration, because the kinematics have been placed by other means.
  void forget() { placed_ = false; }

 private:
  ContactKinematics& kinematics_;
  bool placed_ = false;
  ContactKinematics::Points points_ = ContactKinematics::Points::all;
  double time_ = 0;
  std::vector<double> displacement_;
};

}  // namespace solidus::contact
