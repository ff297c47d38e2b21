/// Keys of [criteria].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [criteria]: whether they are followed, and the temperatures, limits and groups that they need.
Section<CriteriaSpec> criteria_keys() {
  using C = CriteriaSpec;
  Section<C> s("criteria",
               "Criteria of a casting that freezes, for the foundry engineer (docs/guide/criteria.md).");
  s.key("follow", &C::follow)
      .initially(true)
      .doc(
          "Compute solidification times, gradients, Niyama values, pools of melt and strains from step to "
          "step, where something can freeze. With false those fields do not exist.");
  s.key("evaluation", &C::evaluation)
      .initially(0.1)
      .range(0, 0.99)
      .doc(
          "Gradient and cooling rate are taken at this share of the freezing range above the solidus; 0: at "
          "the solidus.");
  s.key("feeding_limit", &C::feeding_limit)
      .initially(0.7)
      .range(0.01, 1)
      .doc("Solid fraction above which no melt flows in; metal below it belongs to pools of melt.");
  s.key("feeders", &C::feeders)
      .initially(Value::list())
      .doc(
          "Groups of the mesh (bodies, surfaces) that feed: a pool that contains none of their nodes is "
          "closed off. Where none is given, a pool is closed off when it separates from a larger one.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
