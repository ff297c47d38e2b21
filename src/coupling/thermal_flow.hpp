/// Flow of metal in the thermal phase of a split.
#pragma once

namespace solidus::coupling {

enum class ThermalFlow {
  kept,      ///< the internal variables stay those of the mechanical phase
  restarted  ///< solid metal is mapped again from those of t_n, at Θ_{n+1} (4.45, 4.49, 4.54)
};

}  // namespace solidus::coupling
