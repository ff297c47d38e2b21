/// Dies that are hot enough for metal to stick to them.
#include "criteria/soldering.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct SolderingKind {
  static constexpr auto fields = criteria::fields::k_of_soldering;
  static constexpr int place = 110;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return Soldering::make(c); }
};

}  // namespace

SharedCriterionKind criterion_soldering() {
  return std::make_shared<CriterionKindOf<SolderingKind>>();
}

}  // namespace solidus::criteria
