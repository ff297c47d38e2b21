/// How far a point of the slave has opened from the master's surface where it really is.
///
/// Kinematics of small sliding keep the partner and the normal that a point began with. Melt that slides by
/// more than a face along a wall of flat faces passes edges between them: its gap along that normal says that
/// it is off its wall where it lies in front of the next face. Reports of melt that has left its wall ask for
/// this distance, which costs a search, where the gap says so.
#pragma once

#include <span>

#include "contact/points/contact_kinematics.hpp"
#include "contact/surfaces/search.hpp"
#include "contact/surfaces/surface.hpp"

namespace solidus::contact {

class WallDistance {
 public:
  /// @param displacement  [local node][component], ghosts up to date [m]
  WallDistance(const ContactSurface& master, std::span<const double> displacement, int components);

  /// The distance of a point in front of the master as it has been deformed, less the one that it had at the
  /// start, up to `reach`; zero within the master [m].
  double opened(const ContactKinematics::Particle& particle, double reach) const;

 private:
  static double in_front(const FaceSearch& wall, const Point& x, double reach);

  std::span<const double> displacement_;
  std::size_t components_;
  FaceSearch reference_, current_;
};

}  // namespace solidus::contact
