#include "contact/heat_gaps.hpp"

#include <algorithm>
#include <array>

#include "contact/heat/heat_measures.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::contact {

std::vector<HeatGap> HeatGaps::now() const {
  return heat_ != nullptr ? gaps_of(heat_->points()) : std::vector<HeatGap>{};
}

std::vector<HeatGap> HeatGaps::ahead(std::span<const double> displacement, double time) const {
  std::vector<HeatGap> gaps = now();
  if (gaps.empty() || !forces_.active()) return gaps;
  const ContactKinematics& kinematics = geometry_.at(time, displacement);
  // Only open points may change: the gap at the displacements that are to come.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const auto i = as_size(p);
    HeatGap& gap = gaps[i];
    if (!gap.partnered || !(gap.penetration < 0)) continue;
    // Points with a partner are taken by the motion at that place; they can come back to touching
    // but not be pressed.
    const PointMotion motion = kinematics.motion(p, end_.state.points[i], ContactKinematics::Asked::motion);
    gap.partnered = motion.partnered;
    if (motion.partnered) gap.penetration = std::min(motion.penetration + step_.from[i].offset, 0.0);
  }
  // The geometry is put back to the end of the step, which others refer to.
  geometry_.at(end_.time, end_.displacement);
  return gaps;
}

void HeatGaps::use(std::span<const HeatGap> gaps) {
  if (heat_ != nullptr) set_gaps(gaps, heat_->points());
}

GapHeat HeatGaps::heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
                       std::span<const double> temperature) const {
  if (heat_ == nullptr) return {};
  const GapHeat heat = gap_heat(heat_->points(), used, right, temperature);
  std::array<double, 2> sums = {heat.passed, heat.misplaced};
  processes::sum(sums);
  return {sums[0], sums[1]};
}

}  // namespace solidus::contact
