/// Derivatives of stress and structural heat at a point for the tangent of the simultaneous scheme
/// (coupled_points.hpp has the equations), for the kernels of all shapes.
#pragma once

#include <optional>

#include "material/viscoplastic.hpp"
#include "mechanics/elements/structural_points.hpp"

namespace solidus::mechanics {

struct CoupledRates {
  Sym<Lane> stress;            ///< σ_Θ [Pa/K]
  Sym<Lane> heat_strain{};     ///< h_ε, h the heat per time [W/m³]
  Lane heat_temperature{0.0};  ///< h_Θ
};

/// An update of the law at a point, and what the heat counts from.
struct CoupledUpdate {
  using Law = material::Viscoplastic;

  const Law& law;
  const Law::Properties<Jet<Lane>>& properties;  ///< coupled_properties at `temperature`
  const Law::State<Lane>& start;
  const Law::Response<Lane>& response;
  const Sym<Lane>& strain;     ///< that the law sees
  const Sym<Lane>& increment;  ///< of strain since the start of the step
  const Sym<Lane>& at_work;    ///< the stress whose work the step counts [Pa]
  const StructuralPoints::Point& point;
  Lane temperature;                     ///< of the iterate [K]
  double dt;                            ///< the step [s]
  const material::TimeStep& effective;  ///< of the law
  double stress_share;                  ///< of σ at the end of the step in at_work
};

/// @param form  none: only the derivative of stress
CoupledRates coupled_rates(const CoupledUpdate& at, std::optional<StructuralForm> form);

/// The properties of a law with their derivatives in temperature, phases held.
/// @param held  the properties that the mechanical phase holds
material::Viscoplastic::Properties<Jet<Lane>> coupled_properties(const material::Viscoplastic& law,
                                                                 Lane temperature, Lane initial_temperature,
                                                                 const material::PointProperties<Lane>& held);

}  // namespace solidus::mechanics
