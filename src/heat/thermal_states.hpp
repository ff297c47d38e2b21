/// States of a thermal phase: how they begin, and what they tell of heat and fractions.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "heat/loads/thermal_state.hpp"
#include "heat/storage/node_shares.hpp"

namespace solidus::heat {

class NodalEnthalpy;
struct ThermalParts;

/// Temperature from which heat contents are counted [K].
inline constexpr double k_counted_from = 293.15;

class ThermalStates {
 public:
  /// Keeps a reference to the parts, which are those of the phase at the time of a call.
  explicit ThermalStates(const ThermalParts& parts) : parts_(parts) {}

  /// Every body at its temperature [K], one per body. A node of several bodies takes the temperature at which
  /// their heats add up. A body that starts at the temperature of an isothermal change is molten.
  ThermalState initial(std::span<const double> body_temperature) const;
  /// Bodies with an enthalpy per volume of their own at each of their nodes; with the open rule of bodies
  /// that store at Gauss points the temperature for it is interpolated from there.
  /// @param enthalpy  h(node, body) [J/m³], by the curves of storage().body_enthalpy(), of owned nodes
  ThermalState initial_of(const std::function<double(Index node, int body)>& enthalpy) const;
  /// From nodal temperatures [K], [local node], ghosts up to date.
  ThermalState initial_at_nodes(std::span<const double> temperature) const;
  /// Heat of the active bodies, counted from 20 °C [J]. With the open rule by the weights of the nodes.
  /// Collective.
  double heat_content(const ThermalState& state) const;
  /// Plateau shares: the shares of isothermal changes that are done at the nodes at their temperature, from 0
  /// (cold) to 1 (hot); one at other nodes. Temperature and plateau share together determine how much of
  /// every material has changed: PhaseFraction::value. [local node], ghosts up to date; empty where no
  /// material has such a change. Collective.
  std::vector<double> plateau_share(const ThermalState& state) const;
  /// Solid fraction of the materials around each node that can melt, 1 if none can; [local node].
  std::vector<double> solid_fraction(const ThermalState& state) const;
  /// Mean over the volume of a body, over all processes.
  double mean_solid_fraction(const ThermalState& state, int body) const;
  /// Mean over the volume of all bodies that can melt, 1 if none can.
  double mean_solid_fraction(const ThermalState& state) const;
  /// Change of the entropy of sensible and latent heat, ∫ dH/Θ over all bodies [J/K]. Temperatures above
  /// zero. Collective.
  EntropyChange entropy_change(const ThermalState& from, const ThermalState& to) const;
  /// Sensible and latent heat of a state, counted from a zero of the materials [J]. Collective.
  double enthalpy(const ThermalState& state) const;
  /// Mean temperature of a body over its volume [K].
  double mean_temperature(const ThermalState& state, int body) const;

 private:
  const ThermalParts& parts_;
};

/// The heat of a node [J]; without enthalpies in the state that of its temperature, molten at that of a
/// change.
double heat_at(const NodalEnthalpy& storage, const ThermalState& state, Index node);

}  // namespace solidus::heat
