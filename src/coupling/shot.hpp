/// Shots: the rounds of a cycle in which castings are poured, freeze and leave while the die stays.
#pragma once

#include <vector>

namespace solidus::coupling {

/// Heat of bodies at the changes between two steps, counted from 20 °C [J].
struct BodyHeat {
  double poured = 0;   ///< with bodies that come
  double ejected = 0;  ///< with bodies that leave
  /// Into the bodies that stay, by the search for their periodic state (shot_map.hpp).
  double corrected = 0;
  /// Change of the internal energy by all that, and by contacts that begin or end (internal_energy.hpp); zero
  /// where it is not followed.
  double energy = 0;
  BodyHeat& operator+=(const BodyHeat& next) {
    poured += next.poured;
    ejected += next.ejected;
    corrected += next.corrected;
    energy += next.energy;
    return *this;
  }
};

/// Temperatures of the bodies that stay [K]: by volume, and at nodes.
struct DieTemperature {
  double mean = 0, lowest = 0, highest = 0;
};

/// A shot that is over.
struct ShotRecord {
  int number = 0;
  double poured = 0, end = 0;      ///< [s]
  DieTemperature at_pour, at_end;  ///< when the shot began and ended
  double change = 0;               ///< the largest between those two at a node of the bodies that stay [K]
  BodyHeat heat;                   ///< `corrected`: before its pour
  bool periodic = false;           ///< the change is within what was asked for
};

/// The end of a shot as the search for the periodic state needs it, [local node]; of the bodies that stay,
/// zero elsewhere.
struct ShotIterate {
  std::vector<double> change;        ///< of the temperature over the shot [K]
  std::vector<double> heat;          ///< heat content [J], or temperature [K] where that is the unknown
  std::vector<double> displacement;  ///< [local node][component] [m]; empty without mechanics
};

/// How far a run has come in its shots: what a restart needs of them.
struct ShotHistory {
  static constexpr double k_unknown = 1e300;
  int shots = 0;                           ///< that are over
  double change = k_unknown;               ///< of the last one of them, as in ShotRecord [K]
  double lowest = k_unknown, highest = 0;  ///< temperature of the run so far [K]
  BodyHeat heat;                           ///< of the present shot
  DieTemperature at_pour;
  std::vector<double> start;          ///< temperature when the present shot began [K], [local node]
  std::vector<ShotIterate> iterates;  ///< of the last shots, the newest last
};

}  // namespace solidus::coupling
