/// Guard of SDIRK2: checks the temperatures that follow from the extrapolation between its two stages.
///
/// The second stage starts from H* = H_n + (1 − γ)/γ (H¹ − H_n), an extrapolation of heats. Where a node
/// gives off the last of its latent heat in the step, its flow of heat goes on as if there were more of it,
/// and Θ(H*) falls far below what the temperatures around it let expect. Conduction takes that back within
/// the second stage where it is a matter of single nodes. Where a whole region freezes in the step, it ends
/// below its surroundings, which no solution of the equations does.
///
/// A solve by backward Euler makes no node colder than it was and than all its neighbours, but for what
/// surfaces and sources take. So two things at the end of the step tell that an extrapolation went too far:
/// temperatures beyond the range of all that there were, and a node that has sunk below its way out, the
/// nodes through which its heat went in the first stage. Melting is the same upside down. Θ(H*) itself is no
/// measure: nodes of a melt that is all but at rest on its plateau are extrapolated beyond the hottest of
/// them by what the iteration has left, and a step of first order in place of one of second is a jump.
#pragma once

#include <span>
#include <vector>

#include "heat/iteration/heat_system.hpp"
#include "heat/loads/thermal_state.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

/// Share of the range of temperatures by which the end of a step may leave it: what the iteration leaves in
/// the heats of nodes far from all that happens is no overshoot.
inline constexpr double k_no_overshoot = 1e-6;

/// Judges the extrapolation of one step. All calls are collective.
class ExtrapolationGuard {
 public:
  /// All must outlive this object.
  /// @param old, middle   the states at t_n and at the end of the first stage
  ExtrapolationGuard(HeatSystem& system, const NodalEnthalpy& storage, const ThermalState& old,
                     const ThermalState& middle);

  /// Whether Θ(H*) lies so far beyond the range of temperatures at t_n and around, by more than its width,
  /// that a second stage from it is not worth a solve. The range may grow as fast as in the first stage:
  /// where a flux or a source cools or heats, nothing bounds it.
  /// @param surroundings  the temperatures around the bodies during the step
  bool extrapolates_too_far(const TemperatureRange& surroundings) const;
  /// Whether the end of the step has left that range.
  /// @param next  the state at the end of the second stage
  /// @param share  of the range by which temperatures may leave it
  bool overshoots(const ThermalState& next, const TemperatureRange& surroundings,
                  double share = k_no_overshoot) const;
  /// Whether metal has sunk below its way out: by more than three ten-thousandths of the range of
  /// temperatures, root mean square over the volume of what can melt, of the nodes that have passed a kink of
  /// their curve. The way out leads from each node to its coldest neighbour in the first stage. Nodes that
  /// pass a kink are those whose Θ(H*) lies beyond what it and its neighbours would come to, changing on as
  /// in the first stage and half as fast again.
  /// @param next  the state at the end of the second stage
  bool turns_back(const ThermalState& next, const parallel::GhostExchange& ghosts) const;

 private:
  template <class F>
  void for_neighbours(const F& f) const;
  bool free(std::size_t i) const;
  TemperatureRange range_of_free(std::span<const double> temperature) const;
  bool leaves_range(const TemperatureRange& reached, const TemperatureRange& surroundings,
                    double share) const;
  bool raise_along(std::span<const std::size_t> way_out, double sign, std::span<double> barrier) const;

  HeatSystem& system_;
  const NodalEnthalpy& storage_;
  const std::vector<double>&before_, &now_;      ///< Θ_n and Θ¹, [local node]
  std::size_t n_;                                ///< owned nodes
  TemperatureRange ahead_;                       ///< of Θ(H*) at the free nodes of this process
  std::vector<char> passes_kink_;                ///< [owned node]: 1 downward, −1 upward; empty: none
  double lowest_ = 0, highest_ = 0;              ///< of Θ_n, of all processes
  double first_lowest_ = 0, first_highest_ = 0;  ///< of Θ¹
};

}  // namespace solidus::heat
