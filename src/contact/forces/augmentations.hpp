/// The augmentations of a contact pair within a step: the next one, how far it still is from its end, and the
/// last resort where it does not settle (augmented_lagrangian.hpp). Nothing where no multipliers act.
#pragma once

#include "contact/forces/augmented_lagrangian.hpp"
#include "contact/forces/forces.hpp"
#include "contact/forces/step.hpp"

namespace solidus::contact {

class Augmentations {
 public:
  /// Keeps references: the forces whose multipliers it changes, and the pair's step and its end.
  Augmentations(ContactForces& forces, ContactStep& step, const ContactEnd& end,
                const ContactGeometry& geometry)
      : forces_(forces), step_(step), end_(end), geometry_(geometry) {}

  /// Whether multipliers hold the penetration now.
  bool act() const {
    return forces_.active() && forces_.law().normal.kind == NormalKind::augmented_lagrangian;
  }
  /// Augments the multipliers once, from the last update of the pair. Collective.
  void augment(AugmentedBy by = AugmentedBy::means);
  /// The largest mean penetration around a node of the slave at the last update, over closed points, as a
  /// share of what is allowed; zero where there is no augmented Lagrangian. Collective.
  double excess() const;
  /// The same as a share of what the penalty alone would leave. Collective.
  double pressure_error() const;
  /// Lets augmentations that do not settle end early, from now on: a last resort.
  void allow_early_end(bool on) { forces_.multipliers().allow_early_end(on); }
  /// Takes the last augmentation back and ends the augmentations of the step.
  void take_back();
  /// Ends the augmentations of the step with the multipliers of now.
  void end() { forces_.multipliers().end_turns(); }
  /// The largest mean penetration around a node where the augmentations of the present step have ended early,
  /// as a share of the mean size of the slave's faces; zero elsewhere. Collective.
  double left_penetration() const;

 private:
  ContactForces& forces_;
  ContactStep& step_;
  const ContactEnd& end_;
  const ContactGeometry& geometry_;
};

}  // namespace solidus::contact
