/// A law of isotropic hardening that the sources do not name, through the point driver: a tensile test,
/// σ = σ_0 + B ln(1 + ξ/ε_0) with ξ = ε − σ/E.
#include "../laws/logarithmic.hpp"
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
  for (const Record& r : h.records) {
    const double xi = r.strain[0] - r.stress[0] / k_young;
    if (xi < 1e-12) continue;
    ++yielding;
    EXPECT_NEAR(r.stress[0], 100e6 + 40e6 * std::log1p(xi / 0.002), 1e-6 * 100e6) << r.strain[0];
  }
  EXPECT_GT(yielding, 35);
}

}  // namespace
}  // namespace solidus::verification
