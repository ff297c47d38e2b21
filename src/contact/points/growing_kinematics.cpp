/// Everything is that of all faces; only a point that lacks a face has no partner, which laws, terms and
/// reports know from points beyond the rim of their master.
#include "contact/points/growing_kinematics.hpp"

#include <utility>

#include "contact/points/integration.hpp"

namespace solidus::contact {

GrowingKinematics::GrowingKinematics(std::unique_ptr<ContactKinematics> all, std::vector<Index> master_face)
    : all_(std::move(all)), master_face_(std::move(master_face)), there_(as_size(all_->n_points()), 1) {}

void GrowingKinematics::set_there(const FacesThere& faces) {
  const auto has = [](const std::vector<char>& there, Index face) {
    return there.empty() || there[as_size(face)] != 0;
  };
  for (Index p = 0; p < n_points(); ++p) {
    // The number of a point begins with that of its face.
    const auto slave = static_cast<Index>(particle(p).number / k_points_of_a_face);
    const bool master = master_face_.empty() || has(faces.master, master_face_[as_size(p)]);
    there_[as_size(p)] = has(faces.slave, slave) && master ? 1 : 0;
  }
}

PointMotion GrowingKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  if (there(point)) return all_->motion(point, old, asked);
  PointMotion none;
  none.weight = particle(point).weight;
  return none;
}

}  // namespace solidus::contact
