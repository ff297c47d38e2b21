/// Temperatures and plateau shares of an iterate at which solid fraction and straining of phase changes are
/// taken, so that a scheme that iterates within the step ends with those of Θ_{n+1}.
///
/// 4.81 holds the fractions of Θ_n through a step, which leaves a lag of one step between temperature and
/// shrinkage. A monolithic scheme evaluates them at the temperatures that it has found and solves again until
/// these no longer change. The energy of a step is counted with the same fractions at both of its ends, as in
/// the splits (docs/theory/coupling.md).
#pragma once

#include <span>
#include <vector>

#include "coupling/phases.hpp"

namespace solidus::coupling {

class PhaseIterate {
 public:
  /// Begins at t_n. Collective.
  PhaseIterate(const Phases& phases, const heat::ThermalState& old);

  /// Sets the fractions of a pass; it refers to this object.
  void hold(mechanics::MechanicalPass& pass) const;
  /// Goes on to an iterate. Where nothing that deforms changes its phase this is nothing.
  /// @param temperature, plateau_share  [K], [1], [local node], ghosts up to date
  /// @param share  of the way from the fractions that are held to those of the iterate
  void advance(std::span<const double> temperature, std::vector<double> plateau_share, double share = 1);
  /// How far an iterate is from the fractions that are held: the largest difference of temperatures as a part
  /// of what the step has changed, or of plateau shares. Zero where nothing changes its phase. Collective.
  double difference(std::span<const double> temperature, std::span<const double> plateau_share) const;
  /// Whether a body that deforms changes its phase.
  bool any() const { return any_; }

 private:
  bool any_ = false;
  std::vector<double> old_;            ///< Θ_n [K]
  std::vector<double> temperature_;    ///< [K]
  std::vector<double> plateau_share_;  ///< empty where no change is isothermal
};

}  // namespace solidus::coupling
