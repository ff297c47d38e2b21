/// Newton's method with the nodal enthalpy as unknown, piece by piece: for the iteration of the simultaneous
/// scheme, which has displacements as further unknowns (thermal_iteration.hpp).
///
///   F_i(H) = (H_i − H*_i)/Δt + r_i(Θ(H)) = 0                                                  [W]
///
/// Θ_i(H) is continuous, rises, and is flat on a plateau. Each iteration solves
///
///   (D + J) δΘ = −F,   D_i = 1/(Δt dΘ_i/dH)  or  δΘ_i = 0 on a plateau,   J = ∂r/∂Θ
///   δH_i = δΘ_i / (dΘ_i/dH)  or  −Δt (F + J δΘ)_i on a plateau
///
/// Full steps need one to four solves when the front passes a few nodes. A held node hides what lies behind
/// it, so an isothermal front moves about one node per iteration. When a step moves it further, plateaus are
/// tilted for some iterations, Θ_i(H) + (H − H*_i) tilt/latent heat, by 1 K, then 0.3 K, …: the front runs at
/// once to about where it belongs, and the last iterations are exact again.
///
/// The phase alone is solved by truncated_newton.hpp, which needs no tilt and fewer iterations, but moves its
/// nodes one by one: here the forces would have to follow.
#pragma once

#include <span>
#include <vector>

#include "heat/iteration/heat_system.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

class EnthalpyNewton {
 public:
  /// plateaus_aram tolerance  Σ|F_i| <= tolerance × heat moved per time
  EnthalpyNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage,
                 const parallel::GhostExchange& ghosts, double tolerance);

  /// Starts from `heat`, which is kept and moved on.
  void begin(std::span<const double> old_heat, double dt, std::span<double> heat);
  /// F at the temperatures of the heats of now.
  void evaluate(std::span<const double> temperature);
  /// Tilts the plateaus, or less, or no more, when it is time; then F is that of now. `iteration` counts from
  /// zero.
  void adapt_tilt(int iteration, std::span<double> temperature);
  bool converged() const;
  /// D + J in the matrix of the system, nodes on a plateau held, and the right-hand side.
  void assemble(std::span<const double> temperature);
  std::span<const double> right_hand_side() const { return b_; }
  /// Makes δΘ [owned node] zero where it is none.
  void hold(std::span<double> step_t) const;
  /// Sets out along the δH that follows from δΘ with its ghosts.
  /// plateaus_aram further  change of F by the further unknowns [W], [owned node]; may be empty
  void enthalpy_step(std::span<const double> step_t, std::span<const double> further);
  /// Moves heats and temperatures [owned node] from `start` by α δH; prescribed ones stay.
  void move(std::span<const double> start, double alpha, std::span<double> temperature);
  /// F at the last evaluate(), [owned node] [W]: where the temperature is prescribed, the heat that holds it.
  std::span<const double> residual() const { return r_; }
  /// Of the last residual, over all processes [W].
  struct Sums {
    double unbalanced = 0;   ///< Σ|F_i| where free
    double moved = 0;        ///< heat moved per time
    double round_off = 0;    ///< F that is rounding
    double conductance = 0;  ///< Σ|A_ii Θ_i|
  };
  const Sums& sums() const { return sums_; }

 private:
  double tilt(std::size_t i) const { return plateaus_.tilt * plateaus_.per_latent[i]; }
  double temperature_of(std::size_t i, double heat) const;
  void set_tilt(double tilt, std::span<double> temperature);

  struct Plateaus {
    std::vector<double> per_latent;  ///< 1/latent heat, zero without, [owned node] [1/J]
    int tilted = 0;                  ///< iterations with the tilt of now
    double tilt = 0;                 ///< temperature difference over the latent heat now [K]
    bool any = false;                ///< on any process
  };

  HeatSystem& system_;
  const NodalEnthalpy& storage_;
  const parallel::GhostExchange& ghosts_;
  double tolerance_;

  double dt_ = 1;
  std::span<const double> old_heat_;
  std::span<double> heat_;
  std::vector<double> r_, b_, step_h_;  ///< [owned node]
  std::vector<double> inverse_;         ///< dΘ/dH, [owned node] [K/J]
  Plateaus plateaus_;
  Sums sums_;
};

}  // namespace solidus::heat
