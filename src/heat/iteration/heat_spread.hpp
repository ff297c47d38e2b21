/// Temperature error that follows from an error in the heat of the nodes.
///
/// Heat that a step puts into the wrong one of two neighbouring nodes is no lasting error of temperature:
/// conduction takes it back within the step. So the heat Q_i spreads for a time τ first,
///
///   (C/τ + A) δ = Q/τ                                                                      [W]
///
/// with the capacity C without latent heat, whatever phase a node is in: a front that is late has not given
/// off the heat yet that its neighbours will miss. This is the filter that keeps estimates of implicit
/// methods in bounds for stiff modes (Shampine, SIAM J. Sci. Stat. Comput. 5 (1984) 709).
#pragma once

#include <span>
#include <vector>

#include "heat/iteration/heat_system.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

/// All calls are collective.
class HeatSpread {
 public:
  /// All must outlive this object.
  HeatSpread(HeatSystem& system, const NodalEnthalpy& storage, const parallel::GhostExchange& ghosts)
      : system_(system), storage_(storage), ghosts_(ghosts) {}

  /// Q/C without spreading [K], [local node], ghosts up to date; zero where nothing is stored.
  /// @param heat         Q [J], at least [owned node]
  /// @param temperature  at which C is taken [K], [local node]
  std::vector<double> at_once(std::span<const double> heat, std::span<const double> temperature) const;
  /// δ [K], [local node], ghosts up to date; zero where the temperature is prescribed. To a part in a
  /// hundred, which is more than an estimate asks for. Leaves the system's matrix at these temperatures.
  /// @param dt  τ [s]
  std::vector<double> operator()(std::span<const double> heat, std::span<const double> temperature,
                                 double dt);

 private:
  std::vector<double> capacities(std::span<const double> temperature) const;

  HeatSystem& system_;
  const NodalEnthalpy& storage_;
  const parallel::GhostExchange& ghosts_;
};

}  // namespace solidus::heat
