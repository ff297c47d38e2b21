/// After each change of the multipliers the term of the mechanical phase starts again.
#include "contact/forces/augmentations.hpp"

namespace solidus::contact {

void Augmentations::augment(AugmentedBy by) {
  forces_.term().stabilisation().restart();
  if (forces_.active()) forces_.multipliers().augment(end_.state, step_, by);
}

void Augmentations::take_back() {
  forces_.term().stabilisation().restart();
  forces_.multipliers().take_back(step_);
}

double Augmentations::excess() const {
  return forces_.active() ? forces_.multipliers().excess(end_.state) : 0.0;
}

double Augmentations::pressure_error() const {
  return forces_.active() ? forces_.multipliers().pressure_error(end_.state) : 0.0;
}

double Augmentations::left_penetration() const {
  if (!act() || !forces_.multipliers().ended_early()) return 0;
  return largest_penetration(geometry_, end_.state).penetration / geometry_.face_size();
}

}  // namespace solidus::contact
