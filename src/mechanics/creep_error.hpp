/// The error of stress that a step leaves through flow whose rate follows the stress (creep).
///
/// Strain follows from equilibrium at the end of a step, the plastic strain is integrated over it: an error
/// δ of ε^vp is one of the stress, 2G δ at a strain that is held. The flow of the same step answers to it: an
/// overstress x that falls by x' for each unit of the rate γ̇ takes back what flows with it in Δt, and
///
///   δs = 2G δ [x'/(x' + 2G Δt)]²
///
/// is left after that step and another one: what flow levels at once is not carried on. Flow that follows at
/// once (x' → 0, rate independent) leaves none: its end of a step is on the yield surface whatever the step.
///
/// Symbols: G shear modulus, x overstress [Pa] at the rate γ̇ = |Δε^vp|/Δt [1/s], the larger one of the step
/// and of that before (material/laws/rate_law.hpp), s deviatoric stress [Pa]. Validity: solid metal with a
/// law of rate dependence of the program; melt, mush and laws from outside count with no error.
#pragma once

#include <span>
#include <vector>

#include "mechanics/mechanical_phase.hpp"
#include "mechanics/state/mechanical_state.hpp"

namespace solidus::mechanics {

/// A plastic strain or its rate at the points, one per block of the mesh, with the six components of Sym;
/// empty for blocks whose flow does not depend on its rate.
using CreepField = std::vector<BlockHistory>;

class CreepError {
 public:
  /// Keeps a reference to the phase.
  explicit CreepError(const MechanicalPhase& phase);

  /// Whether a body creeps; the same on every process.
  bool any() const { return any_; }
  /// factor × (ε^vp of `to` − ε^vp of `from`).
  CreepField flow(const MechanicalState& from, const MechanicalState& to, double factor) const;
  /// The error ½ Δt (ε̇^vp − that of the step before) of backward Euler.
  static CreepField error(const CreepField& rate, const CreepField& before, double dt);
  /// The root mean square of δs over the volume of a body relative to that of its deviatoric stress, in the
  /// body where it is largest [1]. A stress of less than 2e-4 of 2G counts as that. Collective.
  /// @param error        δ
  /// @param rate         of ε^vp in the step [1/s]
  /// @param before       in the step before [1/s]; empty: not known
  /// @param temperature  at its end [K], [local node]
  /// @param now          the state at its end, with its element values
  double of_stress(const CreepField& error, const CreepField& rate, const CreepField& before,
                   std::span<const double> temperature, const MechanicalState& now, double dt) const;

 private:
  struct Block {
    bool creeps = false;
    std::size_t first = 0;       ///< component of ε^vp in the history of a point
    std::vector<double> volume;  ///< of counted elements [m³]
  };
  const MechanicalPhase& phase_;
  std::vector<Block> blocks_;  ///< of the mesh
  bool any_ = false;
};

}  // namespace solidus::mechanics
