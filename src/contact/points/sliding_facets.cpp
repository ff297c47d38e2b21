/// What the facets of both faces do to the gap of a point.
#include <algorithm>
#include <array>
#include <span>

#include "contact/points/sliding_kinematics.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

FacetGap SlidingKinematics::facets(Index point) const {
  const auto p = as_size(point);
  const Partner& partner = points_.table().partner[p];
  // Heights matter where the master has facets; an analytic surface has none.
  if (partner.face < 0) return {};
  const auto n_slave = points_.slave().nodes(points_.table().face[p]).size();
  std::array<double, k_max_face_nodes> values{};
  std::size_t n_master = 0;
  if (points_.master().heights() != nullptr) {
    points_.master().frame(partner, false, last_.frame);
    n_master = as_size(last_.frame.n_face_nodes);
    std::copy_n(last_.frame.share.begin(), n_master, values.begin());
  }
  return facet_gap(heights_, points_.table().face[p], std::span(points_.table().shape[p]).first(n_slave),
                   points_.master().heights(), partner.face, std::span(values).first(n_master));
}

}  // namespace solidus::contact
