/// History of a contact pair: written by ContactPair::update, committed or discarded by the scheme with the
/// rest of the state.
#pragma once

#include <cmath>
#include <vector>

#include "contact/surfaces/vector.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

enum class PointStatus { open, sticks, slips };

/// The history of one point of the slave surface: it travels with the slave's particle, whatever it meets.
/// Slip, ζ_c, work, dissipation and wear are means over the area that the point stands for.
struct ContactPointState {
  GlobalIndex number = 0;  ///< ContactKinematics::Particle: of all processes alike
  bool counted = false;    ///< this process writes it to checkpoints
  PointStatus status = PointStatus::open;
  /// Added to g_N: closes an initial gap that counts as touching, and takes what a skin has sunk in while it
  /// was soft [m].
  double offset = 0;
  double sunk = 0;  ///< what of `offset` the skin has sunk in while it was soft, taken for the wall [m]
  double penetration = 0;  ///< g_N [m] (3.5)
  double pressure = 0;     ///< t_N [Pa]
  /// Contact pressure in the balance of forces at t_n [Pa]: equal to t_N, except with the energy-conserving
  /// quotient, which is a mean over the step (normal.hpp).
  double balance_pressure = 0;
  double multiplier = 0;  ///< λ_N [Pa]: of the augmented Lagrangian, else zero
  /// Pressure of the atmosphere in the step that led here, where liquid metal wets the wall; else zero
  /// (normal.hpp) [Pa].
  double suction = 0;
  /// ε_N of the step that led here over that of the pair: more than one where the skin gets solid
  /// (PointLaw::stiffen).
  double stiffening = 1;
  /// In the step that led here the metal at the point is below coherency: it does not rub. Known from the
  /// start of a step on; checkpoints do without it.
  bool molten = false;
  // Friction.
  Point traction{};       ///< t_T of 3.42b, a vector in the master's tangent plane (ContactKinematics) [Pa]
  Point anchor{};         ///< where slip is counted from: PointMotion::anchor [m]
  Point master_normal{};  ///< ν^ref of the plane that holds `traction`: PointMotion::master_normal
  bool anchored = false;  ///< had a partner at t_n, touching it or not: `anchor` holds
  double internal_variable = 0;  ///< ζ_c, in the units of the law (friction.hpp)
  double slip = 0;               ///< ∫ γ_c dt [m]
  double work = 0;               ///< ∫ ‖T‖ γ_c dt, of which the dissipation is a part [J/m²]
  double dissipation = 0;        ///< ∫ D_c,mech dt [J/m²] (3.58)
  double wear_depth = 0;         ///< by Archard's law [m]
  /// PointMotion::covered of the step that led here. Checkpoints do without it.
  double covered = 1;
  // The interface as a body of its own.
  double temperature = 0;      ///< Θ_c [K]; zero: not known yet
  double plastic_entropy = 0;  ///< S^p_c [J/(m² K)] (3.53c)
};

/// ζ_c at the end of a step of the part of a point that rubbed in it; the history holds the mean with the
/// part that lies beyond the rim of the master.
inline double rubbed_variable(const ContactPointState& from, const ContactPointState& now) {
  return now.covered < 1 ? std::lerp(from.internal_variable, now.internal_variable, 1 / now.covered)
                         : now.internal_variable;
}

/// The pressure with which a point rubs [Pa]: that of a coherent skin. Metal below coherency has no strength
/// to rub with, and tension makes no friction.
/// @param pressure, molten  of the step, as in ContactPointState
inline double rubbing_pressure(double pressure, bool molten) {
  return molten || pressure < 0 ? 0.0 : pressure;
}

/// History of a node of a master that wears. It moves with the master's surface, whichever slave points pass
/// over it.
struct WornNode {
  GlobalIndex number = 0;  ///< mesh::Mesh::input_node: of all processes alike
  bool counted = false;    ///< this process writes it to checkpoints
  double volume = 0;       ///< worn off around the node [m³]
  double dissipation = 0;  ///< of friction there [J]
};

struct ContactState {
  std::vector<ContactPointState> points;  ///< one per point of the pair, in its order
  std::vector<WornNode> master;  ///< one per node of the master in local order, where it wears; else empty
};

}  // namespace solidus::contact
