/// Forces of a contact pair: the law of its points, the term of the mechanical phase that they make, and the
/// multipliers that hold penetrations small.
#pragma once

#include <span>
#include <string>

#include "contact/forces/augmented_lagrangian.hpp"
#include "contact/forces/mechanics_term.hpp"
#include "contact/points/point_law.hpp"
#include "system/pinned.hpp"

namespace solidus::contact {

class ContactForces : Pinned {
 public:
  /// Keeps references; the step is the one that the term works on. Collective. Throws InputError for a law
  /// that is none, and where a penalty given as a factor has no stiffness to multiply.
  /// @param body_modulus  E [Pa] of every body of the mesh; empty: not known
  ContactForces(const ContactGeometry& geometry, const ContactParameters& spec, const PairSurfaces& surfaces,
                std::span<const double> body_modulus, const ContactStep& step);

  /// Off: no force at any point.
  void activate(bool on);
  bool active() const { return active_; }
  /// Begins a step: its way to find the interface's temperature, and s of normal.hpp.
  /// @param goes_on  this is a further pass of the same step
  void begin(bool isentropic, double share, bool goes_on);
  /// Forces of a point that moves as `motion` says from the start of the step.
  PointForces at(const PointMotion& motion, Index point) const;

  const PointLaw& law() const { return law_; }
  MechanicsTerm& term() { return term_; }
  const MechanicsTerm& term() const { return term_; }
  /// Whether the derivative of the term is symmetric.
  bool symmetric() const { return symmetric_; }
  /// The multipliers that Augmentations update, so that penetrations stay small.
  AugmentedLagrangian& multipliers() { return multipliers_; }
  const AugmentedLagrangian& multipliers() const { return multipliers_; }

 private:
  const ContactStep& step_;
  PointLaw law_;
  bool symmetric_, active_ = true;
  AugmentedLagrangian multipliers_;
  MechanicsTerm term_;
};

/// Points of a term that changed between open, sticking and slipping at the last residual. Collective.
GlobalIndex changes(const MechanicsTerm& term);
/// Describes why an iteration failed, from the last residual: empty, or with the pair's name. Collective.
std::string failure_text(const MechanicsTerm& term, const std::string& name);

}  // namespace solidus::contact
