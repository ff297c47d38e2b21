/// Bodies that burn once when they have become hot enough: exothermic sleeves and toppings.
///
/// A node ignites when its temperature passes Θ_i, at t_i (linear within the step that brings it there), and
/// gives off its heat evenly over the time τ that follows:
///
///   B(t) = clamp((t − t_i)/τ, 0, 1),     q = Q dB/dt  [W/m³]
///
/// A step [t_n, t_{n+1}] has the constant power Q (B(t_{n+1}) − B(t_r))/(t_{n+1} − t_n), where t_r is the
/// time up to which heat has been given off. Every scheme integrates a constant exactly, so that all of Q and
/// no more is released whatever the steps are. What falls between t_i and the end of the step of ignition is
/// given off in the step that follows: the heat comes later than it should by less than one step.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace solidus::heat {

/// Heat that a body releases once, place after place.
struct Exothermic {
  std::string name;
  std::string body;     ///< name of a body of the mesh
  double heat = 0;      ///< Q, of all that burns [J/m³]
  double ignition = 0;  ///< Θ_i [K]
  double duration = 0;  ///< τ, at a place, > 0 [s]
};

/// The burnt fraction of the nodes. Empty where no body of the case burns.
struct BurningState {
  std::vector<double> lit;       ///< t_i, infinite before [local node] [s]
  std::vector<double> released;  ///< t_r, of nodes that are lit [local node] [s]
};

/// B(t), 0 for t_i = ∞.
inline double burnt_share(double lit, double duration, double time) {
  return std::clamp((time - lit) / duration, 0.0, 1.0);
}

/// Nothing has been lit.
BurningState unlit(std::size_t n_nodes);

/// The nodes that are marked, one flag a local node, are of new bodies: they have not burnt.
void renew(const std::vector<char>& marked, BurningState& state);

/// The state at the end of a step.
/// @param ignition  the temperature at which each local node ignites [K]; infinite where nothing burns
/// @param before, after  temperatures at the ends of the step, [local node] [K]
/// @param begin, end     of the step [s]
BurningState burn(const BurningState& state, const std::vector<double>& ignition,
                  const std::vector<double>& before, const std::vector<double>& after, double begin,
                  double end);

}  // namespace solidus::heat
