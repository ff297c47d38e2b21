/// Temperatures of the bodies around an interface whose temperature is solved for simultaneously with the
/// slip (simultaneous scheme, 5.40).
#pragma once

#include <optional>
#include <vector>

#include "contact/points/point_law.hpp"

namespace solidus::contact {

struct CoupledInterface {
  const HeatTransferLaw* law = nullptr;    ///< null: Θ_c is that of t_n, or of fixed entropy
  double time_step = 0;                    ///< Δt [s]
  std::vector<double> temperature;         ///< Θ of now, [local node] [K]
  std::optional<double> tool_temperature;  ///< of a master without nodes; absent: it takes no heat

  /// Returns the surroundings of a point that has a partner; nothing outside of the simultaneous scheme.
  std::optional<Surroundings> around(const PointMotion& motion) const;
};

}  // namespace solidus::contact
