/// The list of rate laws, and how Perzyna's completes itself from the liquid's viscosity.
#include "material/laws/perzyna.hpp"
#include "material/material.hpp"

namespace solidus::material {
namespace {

const RateLawOf<NoRate> k_none;
const RateLawOf<Perzyna> k_perzyna;

}  // namespace

// The order of RateDependence.
constinit LawList<RateLaw> detail::rate_list{
    "law of rate dependence", k_rate_parameters, {&k_none, &k_perzyna}, 2};

std::span<const RateLaw* const> rate_laws() {
  return detail::rate_list.all();
}
RateDependence add_rate_law(const RateLaw& law) {
  return static_cast<RateDependence>(detail::rate_list.add(law));
}
RateCompletion Perzyna::complete(RateTables& tables, const GivenRates& given, const Material& material) {
  RateCompletion c;
  // A viscosity that is not given is that of the liquid; a law that is not linear needs its drag stress.
  if (!given[viscosity]) {
    if (!(material.liquid_viscosity.max_value() > 0)) {
      c.blamed = viscosity;
      c.text = "the key 'viscosity' is missing in [plasticity]";
      c.allowed = "rate_dependence = \"perzyna\" needs it, or the liquid's twice_shear_viscosity";
      return c;
    }
    tables[viscosity] = material.liquid_viscosity;
    c.left_out = viscosity;
    c.text = "not given: twice_shear_viscosity (2.98)";
  }
  if (!given[drag_stress] && !linear(tables)) {
    c.blamed = exponent;
    c.text = "'rate_exponent' is not 1 and there is no 'drag_stress'";
    c.allowed = "D of gamma' = f_S/eta Phi (Phi/D)^(n - 1)";
  }
  return c;
}

}  // namespace solidus::material
