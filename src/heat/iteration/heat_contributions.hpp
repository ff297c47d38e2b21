/// The terms of the thermal balance that come from outside of the room: contact, structural heat.
///
/// Contributions that store heat are summed apart, because the balance of a step treats them as storage.
#pragma once

#include <span>
#include <vector>

#include "heat/loads/thermal_state.hpp"
#include "linear/contribution.hpp"

namespace solidus::heat {

class HeatContributions {
 public:
  /// @param contributions  must outlive this object
  /// @param n_owned        nodes of this process
  HeatContributions(std::vector<linear::Contribution*> contributions, Index n_owned);

  std::span<linear::Contribution* const> each() const { return contributions_; }
  bool empty() const { return contributions_.empty(); }
  /// Adds the heat that leaves owned nodes to r [W] and its magnitudes on this process to `moved`.
  /// @param exchanges  false: only of contributions that store
  void add_residual(std::span<const double> temperature, bool exchanges, std::span<double> r, double& moved);
  void add_tangent(std::span<const double> temperature, bool exchanges, linear::BlockMatrix& matrix) const;
  /// The heat that storing contributions took up at the last add_residual(), [owned node] [W]; empty: none
  /// stores.
  std::span<const double> stored() const { return stored_; }
  /// Heat into the bodies by each contribution at the last add_residual(), over all processes [W].
  std::vector<double> powers() const;
  /// Adds the heat into owned nodes to `gain`, that out of them to `loss`, both positive [W]. Notes whether
  /// contributions bring heat, rather than pass it on. Collective.
  void add_supply(std::span<const double> temperature, std::span<double> gain, std::span<double> loss);
  /// Whether they bring or take heat, as far as the last add_supply() has seen; before it, whether any does
  /// more than store.
  bool heat() const { return heat_; }
  /// The range of these temperatures over the nodes that contributions give heat to or take it from, all
  /// processes [K]; +∞ and −∞ where there is none. Friction, say, heats the nodes of its contact, and no node
  /// can be hotter than the hottest of these and of those at the start of a step. Collective.
  TemperatureRange range(std::span<const double> temperature);
  /// Limits what is exchanged at these nodes, [local node]; empty: at none.
  void limit_exchange(std::span<const char> nodes) const;
  std::size_t bytes() const { return contributed_.capacity() * sizeof(double); }

 private:
  std::vector<linear::Contribution*> contributions_;
  bool heat_ = false;
  std::vector<double> contributed_;  ///< work, [owned node]
  std::vector<double> stored_;       ///< its part taken up by storing contributions
  std::vector<double> powers_;       ///< of this process
};

}  // namespace solidus::heat
