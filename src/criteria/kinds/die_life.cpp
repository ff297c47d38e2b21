/// Fatigue of dies that the case gives constants of.
#include "criteria/die_life.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct DieLifeKind {
  static constexpr auto fields = criteria::fields::k_of_die_life;
  static constexpr int place = 90;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return DieLife::make(c); }
};

}  // namespace

SharedCriterionKind criterion_die_life() {
  return std::make_shared<CriterionKindOf<DieLifeKind>>();
}

}  // namespace solidus::criteria
