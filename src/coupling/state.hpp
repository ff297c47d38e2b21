/// The whole committed state of a run, from which a step starts and which a checkpoint holds.
#pragma once

#include <vector>

#include "contact/points/contact_state.hpp"
#include "criteria/criteria_state.hpp"
#include "heat/loads/exothermic.hpp"
#include "heat/loads/thermal_state.hpp"
#include "mechanics/state/mechanical_state.hpp"

namespace solidus::coupling {

struct State {
  double time = 0;          ///< [s]
  int shot = 0;             ///< number of the present shot, from one; zero: a run without shots
  double poured = 0;        ///< when the present castings were poured [s]: times of criteria count from it
  heat::ThermalState heat;  ///< empty without a thermal phase
  mechanics::MechanicalState mechanics;  ///< empty without a mechanical phase
  /// One per pair; empty, or one that is empty: bodies that have not moved yet.
  std::vector<contact::ContactState> contacts;
  /// (u_n − u_{n−1})/(t_n − t_{n−1}) [m/s], [local node][component]: where Newton's iteration of the next
  /// step may start. Empty where a run or a stage begins, and with schemes that do not use it.
  std::vector<double> displacement_rate;
  /// The same of the nodal pressure of mixed elements [Pa/s], [local node][field].
  std::vector<double> pressure_rate;
  /// One per pair: whether its gaps in the last step were much nearer to those that the motion before let
  /// expect than to those of its start. Empty: not known, as no.
  std::vector<char> steady_gaps;
  /// Schemes leave these alone: the simulation brings them to the state that it commits.
  criteria::CriteriaState criteria;
  heat::BurningState burning;
};

}  // namespace solidus::coupling
