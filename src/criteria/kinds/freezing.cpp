/// Times and conditions of freezing, and what follows from them.
#include "criteria/freezing.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct FreezingKind {
  static constexpr auto fields = criteria::fields::k_of_freezing;
  static constexpr int place = 10;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Freezing>(c.mesh, c.kind, c.heat->storage(),
                                      FreezingOptions{.evaluation = c.evaluation, .bodies = c.followed});
  }
};

}  // namespace

SharedCriterionKind criterion_freezing() {
  return std::make_shared<CriterionKindOf<FreezingKind>>();
}

}  // namespace solidus::criteria
