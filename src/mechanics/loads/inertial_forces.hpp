/// Inertia in the balance of momentum (⟨η, ρ v'⟩, missing in monograph 4.40, 4.46): the term that a step adds
/// to the residual and to the tangent, and the change of the kinetic energy.
///
/// Divided by 1 − α_f, motion.hpp's balance is g_1 + J = 0 with
///   J(u_1) = { M [(1−α_m) a_1 + α_m a_n] + α_f g_n } / (1−α_f).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/loads/inertia.hpp"
#include "mechanics/loads/motion.hpp"
#include "mechanics/state/mechanical_state.hpp"

namespace solidus::mechanics {

struct DynamicsOptions {
  MassKind mass = MassKind::consistent;
  Motion motion;
  std::vector<std::array<double, 3>> initial_velocity;  ///< of each body [m/s]; empty: at rest
};

/// Work and energies of a step, this process's part [J]; docs/theory/dynamics.md.
struct MotionWork {
  double external = 0;   ///< of the loads
  double support = 0;    ///< of the supports, which move their nodes' mass too
  double kinetic = 0;    ///< change of ½ v·Mv
  double numerical = 0;  ///< energy that the integrator dissipates
};

class InertialForces {
 public:
  /// @param density of each body [kg/m³]
  InertialForces(const mesh::Mesh& mesh, AnalysisKind kind, int components, std::span<const double> density,
                 DynamicsOptions options);

  const Motion& motion() const { return options_.motion; }
  const MassMatrix& mass() const { return mass_; }
  void bind(const linear::BlockMatrix& matrix) { mass_.bind(matrix); }
  /// Initial velocity of the bodies; where they share a node, that of their common momentum. [local
  /// node][component], owned nodes.
  const std::vector<double>& initial_velocity() const { return initial_velocity_; }

  /// A step from a state, which must live until conclude(). Collective.
  void begin(const MechanicalState& old, double dt);
  /// J at x ([local node][component], ghosts up to date), on owned nodes [N].
  void force(std::span<const double> x, std::span<double> j) const;
  void add_tangent(linear::BlockMatrix& matrix) const;
  /// Inertia forces that are rounding of the displacement [N].
  double round_off() const { return round_off_; }

  /// Writes velocity, acceleration and, where the method remembers, force and load of the new state.
  /// @param net    g_1 at the solution x, load: the loads; [owned node][component] [N]
  /// @param fixed  prescribed degrees of freedom, [local node][component]
  MotionWork conclude(std::span<const double> x, std::span<const double> net, std::span<const double> load,
                      std::span<const char> fixed, MechanicalState& next) const;
  std::size_t bytes() const;

 private:
  void set_initial_velocity(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const double> density);
  double slope() const {  ///< of J [1/s²]
    return options_.motion.slope(dt_) * (1 - options_.motion.alpha_m) / (1 - options_.motion.alpha_f);
  }

  int components_;
  std::size_t n_owned_;  ///< degrees of freedom
  DynamicsOptions options_;
  MassMatrix mass_;
  const MechanicalState* old_ = nullptr;
  double dt_ = 0, round_off_ = 0;
  std::vector<double> initial_velocity_;
  std::vector<double> constant_;           ///< J at u_1 = u_n, owned
  mutable std::vector<double> increment_;  ///< scratch, [local node][component]
};

}  // namespace solidus::mechanics
