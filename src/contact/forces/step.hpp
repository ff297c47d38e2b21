/// The start of a step of a contact pair: all that forces and heat of the step take from t_n.
#pragma once

#include <optional>
#include <vector>

#include "contact/forces/coupled_interface.hpp"
#include "contact/points/contact_state.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

struct ContactStep {
  /// At t_n, one per point; multipliers and tractions are those of the last augmentation of the Lagrangian.
  std::vector<ContactPointState> from;
  /// The tractions at t_n where the augmentations of the Lagrangian have replaced those of `from`, [point]
  /// [Pa]; else empty.
  std::vector<Point> start_traction;
  std::vector<WornNode> worn_from;   ///< of a master that wears, at t_n; else empty
  double dt = 0;                     ///< [s]
  double time = 0;                   ///< t_{n+1} [s]
  double begun = 0;                  ///< t_n [s]
  std::vector<double> displacement;  ///< u_n, [local node][component] [m]
  CoupledInterface coupled;          ///< of the simultaneous scheme
  /// Θ_c and ζ_c of the pass before in a scheme that iterates within the step: [point]; else empty.
  std::vector<FrictionInput::Iterate> iterate;
  /// Wet points whose face has no coherent node, so that no shell moves them: [point].
  std::vector<char> liquid;

  std::optional<FrictionInput::Iterate> iterate_of(Index point) const {
    if (iterate.empty()) return {};
    return iterate[as_size(point)];
  }
  /// The state of a point at t_n, with the traction that it had there.
  ContactPointState at_start(std::size_t point) const {
    ContactPointState start = from[point];
    if (!start_traction.empty()) start.traction = start_traction[point];
    return start;
  }
};

/// The end of a step of a contact pair, or of one that is on its way: what reports are made from.
struct ContactEnd {
  ContactState state;                ///< history at t_{n+1}
  std::vector<double> displacement;  ///< u_{n+1}, [local node][component] [m]
  double time = 0;                   ///< t_{n+1} [s]
};

}  // namespace solidus::contact
