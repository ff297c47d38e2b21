/// Forces of a contact pair: the law of its points, the term of the mechanical phase that they make, and the
/// multipliers that hold penetrations small.
#pragma once

#include <span>
#include <string>

#include "contact/forces/augmented_lagrangian.hpp"
#include "contact/forces/mechanics_term.hpp"
#include "contact/points/point_law.hpp"

namespace solidus::contact {

class ContactForces {
 public:
  /// Keeps references; the step is the one that the term works on. Collective. Throws InputError for a law
  /// that is none, and where a penalty given as a factor has no stiffness to multiply.
  /// @param body_modulus  E [Pa] of every body of the mesh; empty: not known
  ContactForces(const ContactGeometry& geometry, const ContactParameters& spec, const PairSurfaces& surfaces,
                std::span<const double> body_modulus, const ContactStep& step);
  ContactForces(const ContactForces&) = delete;
  ContactForces& operator=(const ContactForces&) = delete;

  /// Off: no force at any point.
  void activate(bool on);
  /// Begins a step: its way to find the interface's temperature, and s of normal.hpp.
  /// @param goes_on  this is a further pass of the same step
  void begin(bool isentropic, double share, bool goes_on);
  /// Forces of a point that moves as `motion` says from the start of the step.
  PointForces at(const PointMotion& motion, Index point) const;

  const PointLaw& law() const { return law_; }
  double penalty() const { return law_.normal.penalty; }  ///< ε_N [Pa/m]
  MechanicsTerm& term() { return term_; }
  const MechanicsTerm& term() const { return term_; }
  /// Whether the derivative of the term is symmetric.
  bool symmetric() const { return symmetric_; }
  /// The next augmentation of the Lagrangian, how far it still is from its end, and where
  /// (augmented_lagrangian.hpp). Collective.
  void augment(const ContactState& now, ContactStep& step, AugmentedBy by);
  double excess(const ContactState& now) const;
  double pressure_error(const ContactState& now) const;
  AugmentedLagrangian& multipliers() { return multipliers_; }
  const AugmentedLagrangian& multipliers() const { return multipliers_; }
  /// Whether multipliers hold the penetration now.
  bool multiplies() const { return active_ && multipliers_.acts(); }
  /// AugmentedLagrangian::take_back, after which the term starts again.
  void take_back_turn(ContactStep& step);
  std::string worst_penetration(const ContactState& now) const { return multipliers_.worst_penetration(now); }
  /// Points that changed between open, sticking and slipping at the last residual. Collective.
  GlobalIndex changes() const;
  /// Describes why an iteration failed, from the last residual: empty, or with the pair's name. Collective.
  std::string failure_text() const;

 private:
  std::string name_;
  const ContactStep& step_;
  PointLaw law_;
  bool symmetric_, active_ = true;
  AugmentedLagrangian multipliers_;
  MechanicsTerm term_;
};

}  // namespace solidus::contact
