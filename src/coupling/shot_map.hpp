/// The map from the die's temperatures at the start of a shot to those at its end, and the search for the
/// state that it leaves as it is: the periodic state.
///
/// Repeating the shot is x_{k+1} = G(x_k), with errors that fall by the same factor from shot to shot: a die
/// of 50 kg that takes up a hundredth of its heat in a shot needs a hundred. Anderson's method takes the ends
/// of the last shots together,
///
///   x_{k+1} = Σ_j α_j G(x_j),   α = argmin ‖Σ_j α_j (G(x_j) − x_j)‖,   Σ_j α_j = 1
///
/// which for a linear map is GMRES (D. G. Anderson, J. ACM 12 (1965) 547–560; H. F. Walker, P. Ni, SIAM J.
/// Numer. Anal. 49 (2011) 1715–1735). The norm weighs kelvin by volume. What is combined is the heat of the
/// nodes, and the displacements of the bodies that stay, so that linear elastic ones stay in balance; their
/// inelastic strain and wear are those of the last shot.
///
/// A combination is not taken beyond the highest temperature of the run, nor farther than half the range of
/// its temperatures. After a shot whose change is twice as large as that of the one before, the search begins
/// again from there.
#pragma once

#include "coupling/shot.hpp"
#include "coupling/state.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::coupling {

struct PeriodicOptions {
  double tolerance = 0;    ///< of ShotRecord::change [K]; zero: the shots go on to the last one
  bool accelerate = true;  ///< false: by repetition
  int depth = 5;           ///< shots that are combined, besides the last one
};

class ShotMap {
 public:
  /// @param heat   of all bodies; kept by reference
  /// @param stays  [body of the mesh] bodies that are there in all stages of the shots
  ShotMap(const heat::ThermalPhase& heat, const std::vector<char>& stays, PeriodicOptions options);

  /// A shot begins, before bodies come: remembers its start, which the search may have moved. Collective.
  /// Returns the heat that this put into the bodies [J].
  double begin(State& state, ShotHistory& history) const;
  /// A shot is over. Collective.
  ShotRecord end(const State& state, ShotHistory& history) const;
  /// Whether the last shot left the die as it found it.
  bool periodic(const ShotHistory& history) const {
    return options_.tolerance > 0 && history.shots > 0 && history.change <= options_.tolerance;
  }

 private:
  DieTemperature die_temperature(const State& state) const;
  /// α of the iterates. Collective.
  std::vector<double> coefficients(const ShotHistory& history) const;
  double combine(State& state, const ShotHistory& history) const;
  bool stays(std::size_t node) const { return volume_[node] > 0; }

  const heat::ThermalPhase& heat_;
  PeriodicOptions options_;
  parallel::GhostExchange ghosts_;
  std::vector<double> volume_;  ///< of bodies that stay, [local node] [m³]; zero where there is none
};

}  // namespace solidus::coupling
