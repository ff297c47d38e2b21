/// Laws that the sources do not name, through the point driver, in tensile tests:
///
///   isotropic   σ = σ_0 + B ln(1 + ξ/ε_0),  ξ = ε − σ/E
///   kinematic   σ = σ_0 + X,  dX = (K − r(ξ) X) dξ
///   rate        σ = σ_0 + √(3/2) S asinh(√(3/2) ε̇/A), once the stress is steady
///   liquid      σ = f_Sᵖ σ_0 in mush that flows at any rate
#include "../laws/hyperbolic_sine.hpp"
#include "../laws/late_strength.hpp"
#include "../laws/logarithmic.hpp"
#include "../laws/marquis.hpp"
#include "material/tensile.hpp"
#include "point_paths.hpp"

namespace solidus::verification {
namespace {

TEST(AddedLawAtAPoint, FollowsItsFlowCurveInATensileTest) {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = 100e6;
  m.flow->isotropic = test::k_logarithmic.kind;
  m.flow->hardening = {40e6, 0.002};
  const History h = run_all(m, {300, 300}, {segment(1, 40, {{0, strain_to(0.05)}})});
  int yielding = 0;
  for (const MaterialPointRecord& r : h.records) {
    const double xi = r.strain[0] - r.stress[0] / k_young;
    if (xi < 1e-12) continue;
    ++yielding;
    EXPECT_NEAR(r.stress[0], 100e6 + 40e6 * std::log1p(xi / 0.002), 1e-6 * 100e6) << r.strain[0];
  }
  EXPECT_GT(yielding, 35);
}

TEST(AddedLawAtAPoint, RecallsItsBackStressInATensileTest) {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = 100e6;
  m.flow->kinematic = test::k_marquis.kind;
  m.flow->kinematic_modulus = 5e9;
  m.flow->recall = {50.0, 3.0};
  double coarse = 0, fine = 0;
  for (const int steps : {100, 200}) {
    const History h = run_all(m, {300, 300}, {segment(1, steps, {{0, strain_to(0.04)}})});
    const MaterialPointRecord& last = h.records.back();
    const double xi = last.strain[0] - last.stress[0] / k_young;
    (steps == 100 ? coarse : fine) = last.stress[0] - material::tensile_stress(*m.flow, xi, 300);
  }
  // of first order in the step, to what of a stress of 200 MPa
  EXPECT_LT(std::abs(fine), 1e6);
  EXPECT_NEAR(coarse / fine, 2, 0.1);
}

TEST(AddedLawAtAPoint, HasTheOverstressOfItsRate) {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = 100e6;
  m.flow->rate_dependence = test::k_hyperbolic_sine.kind;
  m.flow->rate = {20e6, 1e-3, 0.0};
  for (const double duration : {1.0, 100.0}) {
    const History h = run_all(m, {300, 300}, {segment(duration, 100, {{0, strain_to(0.05)}})});
    const double rate = 0.05 / duration, root = std::sqrt(1.5);
    EXPECT_NEAR(h.records.back().stress[0], 100e6 + root * 20e6 * std::asinh(root * rate / 1e-3),
                1e-6 * 100e6);
  }
}

TEST(AddedLawAtAPoint, HasTheStrengthThatItsMushHas) {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = 100e6;
  m.liquid_model = test::k_late_strength.model;
  for (const double power : {1.0, 3.0}) {
    m.liquid_numbers = {power};
    for (const double temperature : {850.0, 825.0}) {
      const double fraction = (900 - temperature) / 100;
      const History h = run_all(m, {temperature, temperature}, {segment(1, 20, {{0, strain_to(0.02)}})});
      EXPECT_NEAR(h.records.back().stress[0], std::pow(fraction, power) * 100e6, 1e-6 * 100e6)
          << power << " at " << temperature;
    }
  }
}

}  // namespace
}  // namespace solidus::verification
