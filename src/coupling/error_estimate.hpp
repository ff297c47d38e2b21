/// Estimate of the error of a step in temperature, displacement and stress.
///
/// Temperature, where nodes hold the heat and the phase is solved once a step: heat::time_error() of the
/// flows of heat, spread to temperatures (heat/iteration/heat_spread.hpp), for backward Euler and SDIRK2. The
/// part of this local error that shifts the mean of a body lasts, because conduction within the body does not
/// level it: a casting that loses its heat too slowly is late until it has frozen. Steps are to commit it in
/// proportion to the heat they move: with ε̄ the mean and s the change of heat in the step, S that of all
/// steps so far,
///
///   ε = max( ‖δ‖, |ε̄| min(S/s, 50) )
///
/// so that the sum of all ε̄ stays about ε however many steps there are. What else there is of δ is levelled
/// or dies away with the transient that made it.
///
/// Else, and for the displacement: backward Euler commits the local error ½ Δt² ÿ. Two ways to measure it:
///
/// predictor   the solution less its extrapolation y_n + Δt ẏ_n, where ẏ_n = (y_n − y_{n−1})/Δt_n is what
///             backward Euler took for the rate at t_n. Their difference is Δt ẏ_{n+1} − Δt ẏ_n = Δt² ÿ
///             whatever the two steps are, hence ε = ½ |y_{n+1} − y_n − Δt ẏ_n| (the pair forward/backward
///             Euler of Gresho, Lee and Sani 1980). Costs two nodal fields and no solve. It sees how curved
///             the solution is in time, not what a split adds by solving the phases one after the other.
/// doubling    the same step again in two halves: the whole commits e Δt², the halves together ½ e Δt², so
///             ε = |y_whole − y_halves| is the error of the halves, which are kept. Sees the whole scheme,
///             and costs three steps for one.
///
/// The displacement counts at nodes that are coherent (Coherency) at t_n and, where the rate of the step
/// before predicts it, were so at t_{n−1}: melt that flows has no displacement that is worth a step, and
/// leaves no stress in what it becomes (docs/theory/melt.md). Its volume counts in the mean, with an error of
/// zero.
///
/// Where something melts and nothing has inertia, the node counts whose displacement is farthest off, not the
/// root mean square over the body: the largest distortion and the widest gap are those of one node (decision
/// 0075).
///
/// Where nothing has inertia only the distortion of a body counts, not where the body lies: a casting that
/// has come off its walls is held by hardly anything, and stress, which is what a step has to resolve, knows
/// nothing of a rigid motion. What it does to gaps shows in the temperatures.
///
/// A displacement that is held says nothing of the stress that creeps away at it. The stress has an error of
/// its own where the flow of solid metal depends on its rate: y is the plastic strain at the points, and ε
/// what it leaves in the stress (mechanics/creep_error.hpp), as a share of the stress of the body.
///
/// A first step has no step before, and one after a jump none that tells: they are measured by doubling.
#pragma once

#include <memory>

#include "coupling/body_norm.hpp"
#include "coupling/phases.hpp"
#include "coupling/rates.hpp"
#include "coupling/state.hpp"
#include "heat/loads/time_error.hpp"

namespace solidus::coupling {

struct LocalError {
  double temperature = 0;   ///< [K]; with the lasting part, see above
  double displacement = 0;  ///< [m]
  double stress = 0;        ///< of the deviatoric stress of a body [1]
  double skin = 0;          ///< the change of the coherent share of a skin (SkinShare), which is no error [1]
  double opening = 0;       ///< ErrorEstimate::skin_opening(), which is no error either [m]
};

/// Whether the error of a displacement is that of the distortion of bodies, or of their whole motion.
enum class Displacement { distortion, motion };

/// Sizes are those of BodyNorm. All calls are collective.
class ErrorEstimate {
 public:
  /// @param phases  which know what is melt and how heat has flowed, and must outlive the estimate; null:
  ///                nothing melts, and temperatures are compared alone
  explicit ErrorEstimate(BodyNorm norm, const Phases* phases = nullptr,
                         Displacement displacement = Displacement::motion)
      : norm_(std::move(norm)), phases_(phases), displacement_(displacement) {
    if (phases_ == nullptr || phases_->mechanics == nullptr) return;
    creep_ = std::make_shared<const mechanics::CreepError>(*phases_->mechanics);
    if (!creep_->any()) creep_.reset();
  }

  /// Estimates the error of temperature of the step from `old` to `now` by its extrapolation from `rates`,
  /// which must be known [K]; `now` need not be deformed yet.
  /// @param flows  of the step (StepEffort)
  double temperature_predictor(const State& old, const State& now, double dt, const Rates& rates,
                               const heat::StageFlows& flows) const;
  /// The same of the displacement [m].
  double displacement_predictor(const State& old, const State& now, double dt, const Rates& rates) const;
  /// The change of the coherent share of skins in contact from `old` to `now` [1]; zero where none melts or
  /// no heat is exchanged. `now` need not be deformed yet.
  double skin_change(const State& old, const State& now) const;
  /// The widest gap that opens in the step at a point that liquid metal wets at its start and not at its end
  /// [m]. A skin that lets go in a long step is drawn in while the mean of the step is still soft, and keeps
  /// that gap.
  double skin_opening(const State& old, const State& now) const;
  /// That of the stress of what creeps, as a share [1]; zero where nothing does or the rate is not known.
  double stress_predictor(const State& old, const State& now, double dt, const Rates& rates) const;
  /// The error of the two `halves` of a step, by comparison with the `whole`. Both start from `old` and take
  /// `dt`.
  /// @param flows  of the second half
  LocalError doubling(const State& old, const State& whole, const State& halves, const Rates& rates,
                      double dt, const heat::StageFlows& flows) const;
  /// Heat that a step has moved: the norm of its change in the nodes in kelvin of sensible heat. Zero where
  /// its flows are not known.
  double change_of(const State& old, const State& now, const heat::StageFlows& flows) const;
  /// The rates of the step from `old` to `now`.
  Rates rates_of(const State& old, const State& now, double dt, const heat::StageFlows& flows) const;

 private:
  /// Whether the error of the heat is taken from these flows.
  bool measures(const heat::StageFlows& flows) const;
  std::vector<double> coherency(const State& state) const;
  std::span<const double> temperature(const State& state) const;
  double size_of_displacement(std::span<const double> error, std::span<const char> counts) const;
  double lasting(double mean, double before, double change) const;

  BodyNorm norm_;
  const Phases* phases_;
  Displacement displacement_;
  std::shared_ptr<const mechanics::CreepError> creep_;  ///< null: nothing creeps
};

}  // namespace solidus::coupling
