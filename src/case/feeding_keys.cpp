#include "case/case_keys.hpp"

namespace solidus::model {

Section<FeedingSpec> feeding_keys() {
  using F = FeedingSpec;
  Section<F> s("feeding",
               "Where the metal that shrinks takes its volume from, in runs with heat alone: pipes, sinks, "
               "cavities and pores (docs/guide/feeding.md).");
  s.key("follow", &F::follow)
      .initially(true)
      .doc(
          "Follow feeding where criteria are followed and something freezes. With mechanics there is none of "
          "it: mixed elements open pores.");
  s.key("vented", &F::vented)
      .initially(Value::list())
      .doc(
          "Groups of the mesh at which melt is open to the atmosphere. Empty: skins of risers, or where "
          "there "
          "are none of all that is cast, that face up and touch no other body; gravity_direction of the "
          "analysis says where up is.");
  s.key("covered", &F::covered)
      .initially(Value::list())
      .doc("Groups of the mesh at which melt is not open, whatever they are otherwise.");
  s.place(&F::where);
  return s;
}

}  // namespace solidus::model
