#include "model/case_keys.hpp"

namespace solidus::model {

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

Section<CycleSpec> cycle_keys() {
  using C = CycleSpec;
  Section<C> s("cycle", "Stages that are run through several times.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("stages", &C::stages)
      .or_one()
      .doc("Its stages, which stand one behind the other in the file, in their order.");
  s.key("repeat", &C::repeat).range(1, 1e6).doc("How often they are run through, all times together.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::model
