/// Checks of a law along the history of a material point: what a finite element run relies on and a law from
/// outside may get wrong (material/external_law.hpp). The laws of the program go through the same checks.
#pragma once

#include <string>
#include <vector>

#include "point/point_history.hpp"

namespace solidus::point {

struct LawCheck {
  std::string name;  ///< "tangent"
  bool passed = true;
  std::string finding;  ///< a figure and where, in words
};

/// Marches through the program and checks on the way: finite answers; the tangent against central differences
/// and its symmetry; the same bits from the same input, whatever was asked in between; the same answer in a
/// rotated frame; dissipation; the energies that the law tells against the work; its moduli against those of
/// the material file.
/// @return one entry per check; the first one that failed of `history` alone where it did not end
std::vector<LawCheck> check_law(const material::Material& material, const Program& program);

}  // namespace solidus::point
