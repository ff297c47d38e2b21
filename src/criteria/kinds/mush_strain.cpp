/// Hot tears of the strain that mush takes.
#include "criteria/mush_strain.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct MushStrainKind {
  static constexpr auto fields = criteria::fields::k_of_mush_strain;
  static constexpr int place = 70;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!c.mechanics || c.heat == nullptr || !MushStrain::has_something_to_say(c.materials)) return nullptr;
    return std::make_unique<MushStrain>(c.mesh, c.whole(), c.kind, c.materials);
  }
};

}  // namespace

SharedCriterionKind criterion_mush_strain() {
  return std::make_shared<CriterionKindOf<MushStrainKind>>();
}

}  // namespace solidus::criteria
