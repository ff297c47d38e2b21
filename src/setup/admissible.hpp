/// The ambient temperature of a case, and whether its conditions are those under which the functional 𝓛 of
/// 2.24 cannot grow (monograph 2.26; docs/theory/coupling_stability.md, 2).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"

namespace solidus::setup {

struct Admissibility {
  /// Θ_a [K]: as given, else the constant one that films, radiation and prescribed temperatures share, else
  /// the lowest initial temperature.
  double ambient_temperature = 0;
  std::vector<std::string> violations;  ///< in words; empty: in the quasi-static limit 𝓛 must fall
  bool holds() const { return violations.empty(); }
};

/// Checks a thermo-mechanical case. Admissible are dead loads, supports that do not move, no source and no
/// flux, surroundings at Θ_a, and a time integration for which the decay is proved (backward Euler).
/// @param coldest  the lowest initial temperature of bodies that have several [K]
Admissibility admissibility(const cases::CaseSpec& spec,
                            double coldest = std::numeric_limits<double>::infinity());

}  // namespace solidus::setup
