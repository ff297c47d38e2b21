/// A law of isotropic hardening that the sources do not name, in finite elements: a bar is pulled,
/// σ = σ_0 + B ln(1 + ξ/ε_0) with ξ = ε − σ/E, in every element.
#include <gtest/gtest.h>

#include "../laws/logarithmic.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

constexpr double k_young = 2e11, k_yield = 1e8, k_factor = 4e7, k_strain = 0.002;

/// By bisection: σ_0 + B ln(1 + ξ/ε_0) + E ξ = E ε.
double stress_at(double strain) {
  double low = 0, high = strain;
  for (int i = 0; i < 80; ++i) {
    const double xi = 0.5 * (low + high);
    (k_yield + k_factor * std::log1p(xi / k_strain) + k_young * xi < k_young * strain ? low : high) = xi;
  }
  return k_young * (strain - low);
}

TEST(BarWithAnAddedLaw, HasTheStressOfTheLawInEveryElement) {
  material::Material m = verification::plastic_material(k_young, 0.3, k_yield);
  m.flow->isotropic = test::k_logarithmic.kind;
  m.flow->hardening = {k_factor, k_strain};
  for (const auto shape : {mesh::Shape::hex8, mesh::Shape::tet10}) {
    test::Body body({.shape = shape, .cells = {2, 3, 2}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1},
                    AnalysisKind::solid, m);
    body.hold("bottom", 1);
    body.hold("left", 0);
    body.hold("back", 2);
    body.hold("top", 1, Table({0, 4}, {0, 0.3 * 0.02}));
    verification::March march(body);
    for (int step = 1; step <= 4; ++step) {
      ASSERT_TRUE(march.to(step));
      const double exact = stress_at(0.005 * step);
      EXPECT_GT(exact, k_yield);
      for (const auto& fields : march.fields())
        for (const auto& stress : fields.stress)
          for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(stress[i], i == 1 ? exact : 0.0, 1e-6 * k_yield);
    }
  }
}

}  // namespace
}  // namespace solidus
