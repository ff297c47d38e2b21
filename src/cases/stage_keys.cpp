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
      .doc(
          "Instead of `step`: the number of equal steps; where steps are adaptive it gives the size of the "
          "first one.");
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
      .doc("How often they are run through in total; with `periodic` at most so often.");
  s.quantity("periodic", &C::periodic, "K")
      .positive()
      .difference()
      .doc(
          "End the run after a round in which no temperature of the bodies that stay in the cycle (the die) "
          "changed by more than this between the start of the round and its end. The cycle must be the last "
          "one of the case.");
  s.choice("search", &C::search,
           {{"anderson", C::Search::anderson,
             "by Anderson's method: before a round the temperatures of the bodies that stay are extrapolated "
             "from the last rounds to the periodic state, so that the rounds do not show how a die warms up"},
            {"repetition", C::Search::repetition,
             "round after round, as in the foundry; takes three times as many and more"}})
      .initially("anderson")
      .doc("How the periodic state is found; needs `periodic`.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
