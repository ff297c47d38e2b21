/// The loads of the two stages of a step (docs/theory/thermal.md): means over parts of the step that add up
/// to it. The heat that the first stage brings counts (1 − γ) Δt, that of the second γ Δt:
///
///   first stage    mean over [t_n, t_{n+1} − γ Δt]
///   second stage   mean over [t_{n+1} − γ Δt, t_{n+1}]
///
/// No load is larger than it ever is in the step, and for smooth loads the order stays two: the sum is exact,
/// and each is the load of its stage to O(Δt). Where the second stage is one of backward Euler over (1 − γ)
/// Δt, the first counts γ Δt only; what it has then taken from its part too little is in the second.
#pragma once

#include "material/time_integration.hpp"
#include "numbers/load_window.hpp"

namespace solidus::heat {

/// @param time, dt  t_{n+1} and the whole step [s]
inline LoadWindow first_loads(double time, double dt) {
  LoadWindow window = LoadWindow::over(time - dt, time - material::k_sdirk_share * dt);
  window.time = time - dt + material::k_sdirk_share * dt;
  return window;
}

/// @param extrapolated  false: the stage is one of backward Euler
inline LoadWindow last_loads(double time, double dt, bool extrapolated) {
  const double share = material::k_sdirk_share, between = time - share * dt;
  if (extrapolated) return LoadWindow::over(between, time);
  const double left = (1 - 2 * share) / (1 - share);
  return {.time = time,
          .parts = {LoadWindow::Part{time - dt, between, left}, {between, time, 1 - left}},
          .n_parts = 2};
}

}  // namespace solidus::heat
