/// The isothermal split (monograph 4.2.3, 4.36, 4.46–4.54): first the mechanical phase at Θ_n, then the
/// thermal phase at the configuration found, in any form of structural heat
/// (mechanics/structural_heat.hpp): 4.48a with 4.50 literal or collapsed, 4.53a, or the difference of the
/// internal energy.
///
/// Conditionally stable, in every form alike: docs/theory/coupling_stability.md, section 5. With only one of
/// the phases it is that phase alone.
#pragma once

#include "coupling/sequential_split.hpp"

namespace solidus::coupling {

class IsothermalSplit final : public SequentialSplit {
 public:
  /// The phases must outlive the scheme.
  explicit IsothermalSplit(Phases phases, const SequentialOptions& options = {})
      : SequentialSplit(std::move(phases), mechanics::Mapping::isothermal, options) {}
};

}  // namespace solidus::coupling
