/// The isentropic split (monograph 4.2.2, 4.31–4.34, 4.40–4.45): first the mechanical phase, in which every
/// quadrature point keeps its elastic entropy S^E_n, solid fraction and flow stress and takes an intermediate
/// temperature Θ̄; then the thermal phase at the configuration found, from S^E_n and Θ_n.
///
///   mechanical:  equilibrium with σ̄ = σ(ε_{n+1}, z̄, Θ̄),  S^E(ε_{n+1}, z̄, Θ̄) = S^E_n             (4.40)
///   thermal:     Θ_{n+1} (S_{n+1} − S_n) − D̄  or  E_{n+1} − E_n − σ̄ : Δε,  and heat          (4.43a)
///
/// Θ̄ is an affair of the mechanical phase alone. The thermal phase keeps the internal variables z̄, or maps
/// those of solid metal again from z_n (4.45, ThermalFlow::restarted); of melt it keeps them, because a point
/// that freezes in the step would take back the flow of its melt. Unconditionally stable; the energy form
/// closes the first law besides (docs/theory/coupling_stability.md).
#pragma once

#include <stdexcept>

#include "coupling/sequential_split.hpp"

namespace solidus::coupling {

class IsentropicSplit final : public SequentialSplit {
 public:
  /// The phases must outlive the scheme. Where deformation exchanges no heat, entropy is a function of the
  /// temperature alone: the mechanical phase is the isothermal one then. Throws std::invalid_argument unless
  /// both phases are there.
  explicit IsentropicSplit(const Phases& phases, const SequentialOptions& options = {})
      : SequentialSplit(
            phases,
            phases.structural != nullptr ? mechanics::Mapping::isentropic : mechanics::Mapping::isothermal,
            options) {
    if (phases.heat == nullptr || phases.mechanics == nullptr)
      throw std::invalid_argument("the isentropic split needs both phases");
  }
};

}  // namespace solidus::coupling
