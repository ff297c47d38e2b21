/// Error in time of a step of the thermal phase, estimated from its flows of heat.
///
/// With f the heat that flows into a node [W], f_n at the end of the step before, f¹ and f² in the stages:
///
///   SDIRK2          e = K Δt f[0, γ, 1],   K = ((√2 − 1)/2 − 1/6)/γ
///   backward Euler  e = ½ Δt (f² − f_n)
///
/// f[0, γ, 1] is the second divided difference over the parts of the step. For linear flows the first term
/// of e is that of the method's own local error; in front of a kink of the enthalpy, where the flow bends,
/// e is of second order, as the error is. Flows are continuous where temperatures bend, at plateaus too, so
/// that e does not mistake the passing of a front for an error, as differences of temperatures do.
#pragma once

#include <span>
#include <vector>

namespace solidus::heat {

/// Flows of heat in a step in which the nodes hold the heat.
struct StageFlows {
  double time = 0;            ///< t_{n+1} [s]
  double dt = 0;              ///< the step [s]; zero: nothing is known
  double share = 1;           ///< of the step that lies before the end of the first stage; 1: the only one
  double last_share = 1;      ///< of the step over which the last stage solves
  bool second_order = false;  ///< the stages are those of SDIRK2; else backward Euler, one after the other
  /// Into the nodes by conduction, surfaces, sources and contributions that do not store, [owned node] [W];
  /// `first` is empty where there is one stage.
  std::vector<double> first, last;
  /// The state at the end of the first of two stages, [local node]: temperatures [K] and heats [J]. Empty
  /// unless the phase was asked for it (ThermalPhase::keep_stages).
  std::vector<double> middle_temperature = {}, middle_enthalpy = {};

  bool known() const { return dt > 0; }
};

/// e, [owned node] [J].
/// @param before  f_n, at least [owned node] [W]
std::vector<double> time_error(const StageFlows& flows, std::span<const double> before);

}  // namespace solidus::heat
