/// Keys of [[stage]] and [[cycle]].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [[stage]]: name, duration, and steps of its own.
Section<StageSpec> stage_keys() {
  using S = StageSpec;
  Section<S> s(
      "stage",
      "A part of the run with conditions of its own. Stages come one after the other, in the order of "
      "the file; the run ends with the last one.");
  s.key("name", &S::name)
      .doc("A name of your choice; conditions and contacts say in which stages they hold.");
  s.quantity("duration", &S::duration, "s").positive().doc("How long it lasts.");
  s.quantity("step", &S::step, "s")
      .positive()
      .doc("Its time step, where steps are adaptive the first one; without it `step` of [time].");
  s.key("steps", &S::steps)
      .range(1, 1e8)
      .doc("Instead of `step`: how many steps of one size; where steps are adaptive, for the first one.");
  s.quantity("min_step", &S::min_step, "s").positive().doc("As in [time], for this stage.");
  s.quantity("max_step", &S::max_step, "s").positive().doc("As in [time], for this stage.");
  s.place(&S::where);
  return s;
}

/// Keys of [[cycle]]: which stages repeat, how often, and whether until they are periodic.
Section<CycleSpec> cycle_keys() {
  using C = CycleSpec;
  Section<C> s("cycle", "Stages that are run through several times.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("stages", &C::stages)
      .or_one()
      .doc("Its stages, which follow one another in the file, in their order.");
  s.key("repeat", &C::repeat)
      .range(1, 1e6)
      .doc("How often they are run through, all times together; with `periodic` at most.");
  s.quantity("periodic", &C::periodic, "K")
      .positive()
      .difference()
      .doc(
          "End the run after a round in which no place of the bodies that stay changed its temperature by "
          "more "
          "than this, from the start of the round to its end; the cycle is the last one of the case.");
  s.choice(
       "search", &C::search,
       {{"anderson", C::Search::anderson,
         "by Anderson's method: before a round the temperatures of the bodies that stay are moved to where "
         "the last rounds say that they will end, so that rounds are no history of a die that warms up"},
        {"repetition", C::Search::repetition,
         "round after round, as in the foundry; takes three times as many and more"}})
      .initially("anderson")
      .doc("How the periodic state is found; needs `periodic`.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
