/// Pools of melt and zones that feed through one neck.
#include "criteria/pools.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct PoolsKind {
  static constexpr auto fields = criteria::fields::k_of_pools;
  static constexpr int place = 30;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Pools>(
        c.mesh, c.heat->storage(),
        PoolOptions{.limit = c.feeding_limit, .feeders = c.feeders, .bodies = c.followed});
  }
};

}  // namespace

SharedCriterionKind criterion_pools() {
  return std::make_shared<CriterionKindOf<PoolsKind>>();
}

}  // namespace solidus::criteria
