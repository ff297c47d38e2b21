#include "built_in_hardening.hpp"
#include "counted.hpp"
#include "dual.hpp"
#include "numbers/jet.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::detail {

using Ad2 = test::Dual<double, 2>;  // hardening_test.cpp
using Ad6 = test::Dual<double, 6>;  // laws_on_duals.cpp
using LongAd = test::LongDual<7>;   // thermal_derivatives_test.cpp

template HardeningStress<Ad2> built_in_stress(IsotropicHardening, const FlowCurves&,
                                              const FlowProperties<Ad2>&, const Ad2&);
template Ad2 built_in_energy(IsotropicHardening, const FlowCurves&, const FlowProperties<Ad2>&, const Ad2&);

template HardeningStress<Ad6> built_in_stress(IsotropicHardening, const FlowCurves&,
                                              const FlowProperties<Ad6>&, const Ad6&);
template Ad6 built_in_energy(IsotropicHardening, const FlowCurves&, const FlowProperties<Ad6>&, const Ad6&);
template HardeningSlopes<Ad6> built_in_slopes(const Flow&, const FlowProperties<Ad6>&,
                                              const FlowProperties<Ad6>&, const Ad6&, const Ad6&, const Ad6&);

template HardeningStress<LongAd> built_in_stress(IsotropicHardening, const FlowCurves&,
                                                 const FlowProperties<LongAd>&, const LongAd&);
template LongAd built_in_energy(IsotropicHardening, const FlowCurves&, const FlowProperties<LongAd>&,
                                const LongAd&);
template Jet<LongAd> built_in_energy(IsotropicHardening, const FlowCurves&,
                                     const FlowProperties<Jet<LongAd>>&, const Jet<LongAd>&);

// free_energy_test.cpp
template test::Second<14> built_in_energy(IsotropicHardening, const FlowCurves&,
                                          const FlowProperties<test::Second<14>>&, const test::Second<14>&);

// return_mapping_test.cpp
template HardeningStress<test::Counted> built_in_stress(IsotropicHardening, const FlowCurves&,
                                                        const FlowProperties<test::Counted>&,
                                                        const test::Counted&);

}  // namespace solidus::material::detail
