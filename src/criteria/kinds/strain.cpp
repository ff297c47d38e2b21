/// Strain of what freezes, and the distortion of castings.
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"
#include "criteria/strain_criteria.hpp"

namespace solidus::criteria {

namespace {

struct StrainKind {
  static constexpr auto fields = criteria::fields::k_of_strain;
  static constexpr int place = 60;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!c.mechanics) return nullptr;
    return std::make_unique<StrainCriteria>(c.mesh, c.whole(), c.kind, c.materials, c.temperature);
  }
};

}  // namespace

SharedCriterionKind criterion_strain() {
  return std::make_shared<CriterionKindOf<StrainKind>>();
}

}  // namespace solidus::criteria
