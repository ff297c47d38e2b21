/// The gaps that heat of a contact pair passes through: those of its last update, or others that a scheme
/// conducts through.
#pragma once

#include <span>
#include <vector>

#include "contact/forces/forces.hpp"
#include "contact/forces/step.hpp"
#include "contact/heat/heat.hpp"
#include "contact/points/geometry.hpp"

namespace solidus::contact {

class HeatGaps {
 public:
  /// Keeps references; null without a heat law.
  HeatGaps(ContactHeat* heat, const ContactGeometry& geometry, const ContactForces& forces,
           const ContactStep& step, const ContactEnd& end)
      : heat_(heat), geometry_(geometry), forces_(forces), step_(step), end_(end) {}

  /// At the last update() or restore() of the pair, or those of use(): [point]; empty without a heat law.
  /// Local.
  std::vector<HeatGap> now() const;
  /// As they would be at a later displacement [local node][component], ghosts up to date [m], and time, seen
  /// from the state of the pair: open ones widen or close with the motion; those that carry a pressure, or
  /// melt that clings to its wall, stay closed, since their forces do not follow from the motion alone.
  /// Local.
  std::vector<HeatGap> ahead(std::span<const double> displacement, double time) const;
  /// Conducts through these until the next update() or restore(), wherever a point has a partner in both.
  /// Local.
  void use(std::span<const HeatGap> gaps);
  /// The heat that passes at these temperatures [local node] through the gaps `used` instead of the right
  /// ones. Collective.
  GapHeat heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
               std::span<const double> temperature) const;

 private:
  ContactHeat* heat_;
  const ContactGeometry& geometry_;
  const ContactForces& forces_;
  const ContactStep& step_;
  const ContactEnd& end_;
};

}  // namespace solidus::contact
