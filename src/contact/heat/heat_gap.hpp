/// The gap through which a point of the interface conducts, taken apart from the configuration of the point:
/// a scheme that solves heat before deformation conducts through the mean of the gaps at both ends of the
/// step where they differ much.
#pragma once

#include <vector>

namespace solidus::contact {

struct HeatGap {
  double penetration = 0;  ///< g_N as heat sees it [m]
  double pressure = 0;     ///< t_N [Pa]
  bool partnered = false;  ///< without a partner no heat passes, and the other two mean nothing
};

/// The gaps in the middle of a step, point by point: those of its start where a point has a partner at one
/// end of the step alone. An open gap has no pressure.
std::vector<HeatGap> middle(const std::vector<HeatGap>& start, const std::vector<HeatGap>& end);

/// Heat that a pair passes through other gaps than the right ones [W].
struct GapHeat {
  double passed = 0;     ///< ∫ max(h, h_right) |Θ_s − Θ_m| dA
  double misplaced = 0;  ///< ∫ |h_right − h| |Θ_s − Θ_m| dA
};

}  // namespace solidus::contact
