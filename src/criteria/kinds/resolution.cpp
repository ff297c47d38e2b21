/// Shows no field: the errors of answers are estimated with it.
#include "criteria/resolution.hpp"
#include "criteria/criterion_kind.hpp"

namespace solidus::criteria {

namespace {

struct ResolutionKind {
  static constexpr std::array<const quantities::Quantity*, 0> fields = {};
  static constexpr int place = 20;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Resolution>(c.mesh, c.kind, c.followed);
  }
};

}  // namespace

SharedCriterionKind criterion_resolution() {
  return std::make_shared<CriterionKindOf<ResolutionKind>>();
}

}  // namespace solidus::criteria
