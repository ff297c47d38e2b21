/// Strength and grain of metals whose cards have tables of them.
#include "criteria/local_properties.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct LocalPropertiesKind {
  static constexpr auto fields = criteria::fields::k_of_local_properties;
  static constexpr int place = 80;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return LocalProperties::make(c); }
};

}  // namespace

SharedCriterionKind criterion_local_properties() {
  return std::make_shared<CriterionKindOf<LocalPropertiesKind>>();
}

}  // namespace solidus::criteria
