/// State of the thermal phase, which it reads at t_n and writes at t_{n+1}, and its report of a step.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "heat/loads/time_error.hpp"
#include "linear/newton.hpp"

namespace solidus::heat {

/// The committed thermal state. With the closed rule the nodal enthalpy is the unknown, of which the
/// temperature is a function; it alone says how much of a node on an isothermal plateau is solid.
struct ThermalState {
  std::vector<double> temperature;  ///< [K], [local node], ghosts up to date
  std::vector<double> enthalpy;     ///< [J], [local node], ghosts up to date; empty with the open rule
};

/// A range of temperatures [K]; empty at first.
struct TemperatureRange {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
};

/// Conduction keeps temperatures within these limits [K].
struct ConductionBounds {
  TemperatureRange range{-HUGE_VAL, HUGE_VAL};  ///< of the start and of what is around; open where heated
  TemperatureRange start;                       ///< of the start alone: HeatSystem::closed_range()
  bool kept = false;  ///< what conduction is held back by stays, unless a temperature leaves the range
};

/// Heat that one condition brought into the bodies during a step (steady analysis: per second).
struct ConditionHeat {
  std::string name;
  double heat =
      0;  ///< [J] (steady: [W]); axisymmetric: of the whole revolution; plane: per metre of thickness
};

/// What the fluid of a cooling channel has come to.
struct ChannelReading {
  std::string name;
  double heat = 0;                ///< that it took up, by its enthalpy [J] (of a state: per second)
  double outlet = 0;              ///< [K]
  double reynolds = 0;            ///< mean along the way; zero: nothing flows
  double film = 0;                ///< h, mean along the way [W/(m² K)]
  double wall = 0;                ///< where it is hottest [K]
  std::array<double, 3> place{};  ///< where that is [m]
  bool found = false;             ///< whether some of the channel lies in its body, and the fluid flows
};

/// The first law of the thermal phase alone, over one step and all processes.
struct HeatBalance {
  double stored = 0;    ///< change of the heat content, by exact enthalpy differences [J]
  double sensible = 0;  ///< the part of `stored` that changed temperature [J]
  double latent = 0;    ///< the part of `stored` that changed phase, positive when melting [J]
  std::vector<ConditionHeat> conditions;  ///< prescribed temperatures, fluxes, films, radiations, sources
  std::vector<double> contributions;      ///< heat into the bodies by each contribution, in their order [J]
  double entropy_in = 0;  ///< ∫ dQ/Θ of the heat by conditions, Θ of the bodies there [J/K]
  double exchanged = 0;   ///< half the sum of the magnitudes of all heat moved: the reference of the defect

  double heat_in() const {  ///< by conditions and contributions [J]
    double sum = 0;
    for (const ConditionHeat& condition : conditions) sum += condition.heat;
    for (double heat : contributions) sum += heat;
    return sum;
  }
  double defect() const { return stored - heat_in(); }
};

/// Change of the entropy of sensible and latent heat [J/K].
struct EntropyChange {
  double change = 0;
  double magnitude = 0;  ///< sum of the magnitudes subtracted from each other: the scale of rounding
  /// Σ |H − H(Θ)|/Θ at the nodes at the start: the residual of the step before is in their heat and not in
  /// their temperatures, of which the entropy is.
  double behind = 0;
};

struct ThermalReport {
  linear::NewtonReport newton;  ///< sums over the stages of the step
  int hardest = 0;              ///< the most effort of one stage (linear::NewtonReport)
  HeatBalance balance;
  std::vector<ChannelReading> channels;  ///< heat of the step, all else at its end
  StageFlows flows;                      ///< known where the nodes hold the heat and something flows
};

}  // namespace solidus::heat
