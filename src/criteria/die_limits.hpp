/// The limits up to which a die is used, of one body.
#pragma once

#include <optional>

namespace solidus::criteria {

struct DieLimits {
  std::optional<double> worn_depth;             ///< depth at which a place is worn out [m]
  std::optional<double> soldering_temperature;  ///< above which metal sticks to the die [K]
};

}  // namespace solidus::criteria
