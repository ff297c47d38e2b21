/// Gas where feeding does not follow it.
#include "criteria/criterion_kind.hpp"
#include "criteria/feeding.hpp"
#include "criteria/gas_pores.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {

namespace {

struct GasKind {
  static constexpr auto fields = criteria::fields::k_of_gas;
  static constexpr int place = 50;
  static constexpr bool from_data = true;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr || Feeding::follows(c)) return nullptr;
    return GasPores::make(c.mesh, c.heat->storage(), c.followed, c.feeding_options.gas);
  }
};

}  // namespace

SharedCriterionKind criterion_gas() {
  return std::make_shared<CriterionKindOf<GasKind>>();
}

}  // namespace solidus::criteria
