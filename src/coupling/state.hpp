/// The whole committed state of a run: what a step starts from and a checkpoint keeps, and nothing else.
#pragma once

#include "heat/thermal_state.hpp"
#include "mechanics/mechanical_state.hpp"

namespace solidus::coupling {

struct State {
  double time = 0;                       ///< [s]
  heat::ThermalState heat;               ///< empty without a thermal phase
  mechanics::MechanicalState mechanics;  ///< empty without a mechanical phase
};

}  // namespace solidus::coupling
