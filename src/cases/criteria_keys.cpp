/// Keys of [criteria].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [criteria]: whether they are followed, and the temperatures, limits and groups that they need.
Section<CriteriaSpec> criteria_keys() {
  using C = CriteriaSpec;
  Section<C> s("criteria",
               "What a foundry engineer reads off a casting that freezes (docs/guide/criteria.md).");
  s.key("follow", &C::follow)
      .initially(true)
      .doc(
          "Follow solidification times, gradients, Niyama, pools of melt and strains over the steps, where "
          "something can freeze. Without it those fields do not exist.");
  s.key("evaluation", &C::evaluation)
      .initially(0.1)
      .range(0, 0.99)
      .doc(
          "Gradient and cooling rate are taken at this share of the freezing range above the solidus; 0: at "
          "the solidus.");
  s.key("feeding_limit", &C::feeding_limit)
      .initially(0.7)
      .range(0.01, 1)
      .doc("Solid fraction beyond which no melt is fed: pools of melt lie below.");
  s.key("feeders", &C::feeders)
      .initially(Value::list())
      .doc(
          "Groups of the mesh (bodies, surfaces) that feed: a pool that holds none of their nodes is closed "
          "off. Without any, a pool is closed off when it splits off a larger one.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
