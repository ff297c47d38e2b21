/// Feeding with heat alone. With mechanics, mixed elements feed and open pores.
#include "criteria/feeding.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct FeedingKind {
  static constexpr auto fields = criteria::fields::k_of_feeding;
  static constexpr int place = 40;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!Feeding::follows(c)) return nullptr;
    return std::make_unique<Feeding>(c.mesh, c.kind, c.heat->storage(), c.feeding_options);
  }
};

}  // namespace

SharedCriterionKind criterion_feeding() {
  return std::make_shared<CriterionKindOf<FeedingKind>>();
}

}  // namespace solidus::criteria
