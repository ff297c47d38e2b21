/// The isothermal split (monograph 4.2.3, 4.36, 4.46–4.54) in its temperature form: first the mechanical
/// phase at Θ_n, then the thermal phase at the configuration found, with exact enthalpy differences and
/// structural heating (2.127b).
///
/// Conditionally stable: see docs/theory/coupling.md. With only one of the phases it is that phase alone.
#pragma once

#include "coupling/sequential_split.hpp"

namespace solidus::coupling {

class IsothermalSplit final : public SequentialSplit {
 public:
  /// The phases must outlive the scheme.
  explicit IsothermalSplit(Phases phases)
      : SequentialSplit(std::move(phases), mechanics::Mapping::isothermal) {}
};

}  // namespace solidus::coupling
