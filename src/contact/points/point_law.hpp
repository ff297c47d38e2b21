/// Forces at one point from its motion: the normal law and friction together, and their derivatives.
///
///   T^trial = T_n + ε_T ΔG,   T = T^trial ‖T‖/‖T^trial‖  with ‖T‖ of FrictionLaw (5.30, 5.31a) ∂T/∂T^trial =
///   (‖T‖/‖T^trial‖)(1 − m⊗m) + (∂‖T‖/∂‖T^trial‖) m⊗m,   m = T^trial/‖T^trial‖
#pragma once

#include <optional>

#include "contact/interface/friction.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "contact/interface/interface_thermodynamics.hpp"
#include "contact/interface/normal.hpp"
#include "contact/interface/wear.hpp"
#include "contact/points/contact_kinematics.hpp"
#include "contact/surfaces/rotation.hpp"

namespace solidus::contact {

/// Boundary data of an interface point while slip and Θ_c are solved for simultaneously (5.40).
struct Surroundings {
  const HeatTransferLaw* law = nullptr;
  double time_step = 0;                 ///< Δt [s]
  std::array<double, 2> temperature{};  ///< of the slave and the master at the point [K]
  bool master_takes_heat = true;

  Conductance conductance(double penetration, double pressure) const {
    return law->at(penetration, pressure, 0.5 * (temperature[0] + temperature[1]));
  }
  /// @param pressure  at which the conductance is, zero over a gap [Pa]
  InterfaceSides sides(double conductance, double pressure) const {
    const double share = law->slave_resistance(pressure, 0.5 * (temperature[0] + temperature[1]));
    const OneSided h = HeatTransferLaw::one_sided(conductance, share);
    return {temperature,
            {h.slave, master_takes_heat ? h.master : 0.0},
            HeatTransferLaw::slave_share(share, master_takes_heat)};
  }
};

/// Derivatives of the solution of both equations, besides those of PointForces.
struct JointSlopes {
  double stiffness = 0;                                ///< dr/dΘ_c of the balance [W/(m² K)]
  double source_by_trial = 0, source_by_pressure = 0;  ///< InterfaceReturn
  double traction_by_conductance = 0;        ///< ∂‖T‖/∂h at fixed trial traction and pressure
  std::array<double, 2> traction_by_side{};  ///< ∂‖T‖/∂Θ_i of slave and master [Pa/K]
};

/// The penetration that heat takes a point to have [m]: a wet one conducts as a closed one, and so does one
/// with a pressure, which a multiplier may carry where penetration and gap are of the size of the tolerance.
inline double seen_by_heat(double penetration, double pressure, double suction) {
  return (pressure > 0 || suction > 0) && penetration < 0 ? 0.0 : penetration;
}
/// The least multiplier that a point may have, that of an open one [Pa].
inline double least_multiplier(const ContactPointState& state) {
  return state.suction > 0 ? -state.suction : 0.0;
}

struct PointForces {
  PointStatus status = PointStatus::open;
  NormalLaw::Response normal;
  Point traction{};              ///< T [Pa]
  Tensor traction_by_trial{};    ///< ∂T/∂T^trial
  Point traction_by_pressure{};  ///< ∂T/∂t_N
  double trial = 0;              ///< ‖T^trial‖ [Pa]
  FrictionResponse friction;     ///< void without a friction law and at open points
  /// Slopes of the simultaneous solution for Θ_c and slip, if there is one. The slopes of T then include the
  /// dependence of Θ_c on trial traction and pressure; through the conductance they change by
  /// traction_by_conductance.
  std::optional<JointSlopes> joint;
  /// ∂T/∂h, T ∥ T^trial; zero where Θ_c is not found with the slip [Pa m² K/W].
  Point traction_by_conductance{};
  Conductance conductance;  ///< there
};

/// Returns the force per area on the master of a pressure and the traction of a state, in the current
/// configuration: p n + F T.
inline Point force_on_master(const PointMotion& motion, const ContactPointState& state, double pressure) {
  return add_scaled(times(motion.push, state.traction), pressure, motion.normal);
}

/// Takes the slip of a step into the history of a point: what friction leaves is a mean over the area that
/// the point stands for, of which the part beyond the rim of the master does not rub
/// (ContactPointState::covered).
void take_slip(const FrictionResponse& friction, const ContactPointState& from, ContactPointState& to);

struct PointLaw {
  NormalLaw normal;
  std::optional<FrictionLaw> friction;
  std::optional<WearParameters> wear;  ///< with friction
  /// ε_N of a point with a solid skin over that of `normal`; one: the same everywhere.
  double stiffening = 1;
  bool friction_stiffens = true;  ///< ε_T of a point follows its ε_N: it was not given in Pa/m
  bool isentropic = false;        ///< the mechanical phase holds the entropy of the interface (5.24)
  double share = 1;               ///< s of normal.hpp

  /// The normal law of a point, with its own ε_N.
  NormalLaw normal_at(const ContactPointState& state) const {
    return {normal.kind, state.stiffening * normal.penalty};
  }
  /// ε_T of a point [Pa/m]; with friction.
  double tangential_penalty(const ContactPointState& state) const {
    return friction->tangential_penalty(friction_stiffens ? state.stiffening : 1.0);
  }
  /// Gives a point at the start of a step the penalty of its skin, ε_N stiffening^strength. A stiffer one
  /// leaves the pressure as it is: the point takes what it had sunk in, but for p/ε_N, for its wall
  /// (ContactPointState::offset). A softer one leaves the penetration, and pressure and traction fall. Either
  /// way the energy of the springs does not grow.
  /// @param strength  Skin::strength
  void stiffen(double strength, ContactPointState& state) const;
  /// @param from the state at t_n with the present multipliers: λ_N, and T_n or the traction that replaces it
  /// @param around   where slip and Θ_c are found together: the simultaneous scheme
  /// @param iterate  of a scheme whose phases are solved in alternation within the step
  PointForces forces(const PointMotion& motion, const ContactPointState& from,
                     const std::optional<Surroundings>& around = {},
                     const std::optional<FrictionInput::Iterate>& iterate = {}) const;
  /// The state that the forces lead to, at t_{n+1}. A point that is open, or where no friction acts, keeps
  /// what friction left.
  ContactPointState next(const PointMotion& motion, const ContactPointState& from,
                         const PointForces& forces) const;
  /// Returns the elastic energy of the normal and tangential penalty springs in a state [J/m²].
  double stored(const ContactPointState& state) const;

 private:
  /// Friction's answer; with `around` and a known Θ_c of t_n, together with that of the interface.
  FrictionResponse respond(const FrictionInput& in, const std::optional<Surroundings>& around,
                           double conductance, std::optional<JointSlopes>& joint) const;
};

}  // namespace solidus::contact
