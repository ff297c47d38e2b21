/// Laws of friction that several tests use.
#pragma once

#include <utility>
#include <vector>

#include "contact/interface/friction.hpp"

namespace solidus::contact {

/// Terms μ_0, μ_1, … over the internal variable in a unit [SI].
inline FrictionParameters friction_spec(std::vector<Table> terms, double unit = 1,
                                        InternalVariable variable = InternalVariable::normal_work) {
  FrictionParameters spec;
  spec.coefficient.terms = std::move(terms);
  spec.coefficient.unit = unit;
  spec.internal_variable = variable;
  return spec;
}

constexpr double k_kilonewton_per_mm = 1e6;  ///< [N/m]

/// Table 7.5, the internal variable in kN/mm.
inline std::vector<Table> galvannealed() {
  return {0.178, -0.666e-2};
}
inline std::vector<Table> electrogalvanised() {
  return {0.157, -0.315e-1, 0.104e-1, -0.821e-3, 0.289e-4, -0.410e-6};
}

}  // namespace solidus::contact
