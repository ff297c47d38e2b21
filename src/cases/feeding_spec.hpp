/// [feeding] and [gas] of a case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/document.hpp"

namespace solidus::cases {

/// Feeding with heat alone (criteria/feeding.hpp).
struct FeedingSpec {
  bool follow = true;
  bool moves_heat = false;                   ///< metal that moves takes its heat along
  std::vector<std::string> vented, covered;  ///< groups of the mesh
  std::optional<double> mould_rigidity;      ///< absent: that of the moulds' cards
  std::optional<double> wall_movement;       ///< of the mould by graphite, at most [m]; absent: no limit
  SourceLocation where;
};

/// Gas in the melt (criteria/gas_pores.hpp).
struct GasSpec {
  bool follow = true;
  std::optional<double> content;  ///< of all melts with gas on their card [m³/kg]; absent: that of the cards
  double ambient_pressure = 0;    ///< [Pa]
};

}  // namespace solidus::cases
