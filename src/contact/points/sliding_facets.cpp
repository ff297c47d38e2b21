/// What the facets of both faces do to the gap of a point.
#include <algorithm>
#include <array>
#include <span>

#include "contact/points/sliding_kinematics.hpp"

namespace solidus::contact {

FacetGap SlidingKinematics::facets(Index point) const {
  const auto p = static_cast<std::size_t>(point);
  const Partner& partner = partner_[p];
  // Heights matter where the master has facets; an analytic surface has none.
  if (partner.face < 0) return {};
  const auto n_slave = slave_.nodes(face_[p]).size();
  std::array<double, k_max_face_nodes> values{};
  std::size_t n_master = 0;
  if (master_->heights() != nullptr) {
    master_->frame(partner, false, frame_);
    n_master = static_cast<std::size_t>(frame_.n_face_nodes);
    std::copy_n(frame_.share.begin(), n_master, values.begin());
  }
  return facet_gap(heights_, face_[p], std::span(shape_[p]).first(n_slave), master_->heights(), partner.face,
                   std::span(values).first(n_master));
}

}  // namespace solidus::contact
