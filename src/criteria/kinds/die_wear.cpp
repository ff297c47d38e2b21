/// Wear of dies from shot to shot.
#include "criteria/die_wear.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct DieWearKind {
  static constexpr auto fields = criteria::fields::k_of_die_wear;
  static constexpr int place = 100;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return DieWear::make(c); }
};

}  // namespace

SharedCriterionKind criterion_die_wear() {
  return std::make_shared<CriterionKindOf<DieWearKind>>();
}

}  // namespace solidus::criteria
