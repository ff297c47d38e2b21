/// Forces at one point from its motion: the normal law and friction together, and their derivatives.
///
///   T^trial = T_n + ε_T ΔG,   T = T^trial ‖T‖/‖T^trial‖  with ‖T‖ of FrictionLaw (5.30, 5.31a) ∂T/∂T^trial =
///   (‖T‖/‖T^trial‖)(1 − m⊗m) + (∂‖T‖/∂‖T^trial‖) m⊗m,   m = T^trial/‖T^trial‖
#pragma once

#include <optional>

#include "contact/friction.hpp"
#include "contact/kinematics.hpp"
#include "contact/normal.hpp"
#include "contact/wear.hpp"

namespace solidus::contact {

struct PointForces {
  PointStatus status = PointStatus::open;
  NormalLaw::Response normal;
  Point traction{};              ///< T [Pa]
  Tensor traction_by_trial{};    ///< ∂T/∂T^trial
  Point traction_by_pressure{};  ///< ∂T/∂t_N
  double trial = 0;              ///< ‖T^trial‖ [Pa]
  FrictionResponse friction;     ///< void without a friction law and at open points
};

struct PointLaw {
  NormalLaw normal;
  std::optional<FrictionLaw> friction;
  std::optional<WearSpec> wear;  ///< with friction
  bool isentropic = false;       ///< what the mechanical phase holds at the interface (5.24)
  double share = 1;              ///< s of normal.hpp

  /// @param from  the state at t_n with the multipliers of now: λ_N, and T_n or what stands for it
  PointForces forces(const PointMotion& motion, const PointState& from) const;
  /// The state that the forces lead to, at t_{n+1}. A point that is open, or where no friction acts, keeps
  /// what friction left.
  PointState next(const PointMotion& motion, const PointState& from, const PointForces& forces) const;
  /// What the springs of a state hold, normal and tangential [J/m²].
  double stored(const PointState& state) const;
};

}  // namespace solidus::contact
