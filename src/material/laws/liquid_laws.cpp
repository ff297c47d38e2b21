/// The list of the models of the liquid.
#include "material/liquid.hpp"

namespace solidus::material {
namespace {

const LiquidLawOf<Maxwell> k_maxwell;
const LiquidLawOf<ModifiedShear> k_modified_shear;
const LiquidLawOf<Degenerated> k_degenerated;

}  // namespace

// The order of LiquidModel.
constinit LawList<LiquidLaw> detail::liquid_list{
    "model of the liquid", k_liquid_parameters, {&k_maxwell, &k_modified_shear, &k_degenerated}, 3};

bool detail::liquid_dashpot[LawList<LiquidLaw>::k_most] = {Maxwell::dashpot, ModifiedShear::dashpot,
                                                           Degenerated::dashpot};
bool detail::liquid_holds_modulus[LawList<LiquidLaw>::k_most] = {false, ModifiedShear::holds_modulus, false};

std::span<const LiquidLaw* const> liquid_laws() {
  return detail::liquid_list.all();
}
LiquidModel add_liquid_law(const LiquidLaw& law) {
  const std::size_t place = detail::liquid_list.add(law);
  detail::liquid_dashpot[place] = law.dashpot();
  detail::liquid_holds_modulus[place] = law.holds_modulus();
  return static_cast<LiquidModel>(place);
}

}  // namespace solidus::material
