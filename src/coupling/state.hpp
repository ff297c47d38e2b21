/// The whole committed state of a run: what a step starts from and a checkpoint keeps, and nothing else.
#pragma once

#include <vector>

#include "contact/state.hpp"
#include "criteria/state.hpp"
#include "heat/thermal_state.hpp"
#include "mechanics/mechanical_state.hpp"

namespace solidus::coupling {

struct State {
  double time = 0;                       ///< [s]
  heat::ThermalState heat;               ///< empty without a thermal phase
  mechanics::MechanicalState mechanics;  ///< empty without a mechanical phase
  /// One per pair; empty, or one that is empty: bodies that have not moved yet.
  std::vector<contact::ContactState> contacts;
  /// Schemes leave it alone: the simulation brings it to the state that it commits.
  criteria::State criteria;
};

}  // namespace solidus::coupling
