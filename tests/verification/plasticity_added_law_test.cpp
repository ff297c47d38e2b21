/// Laws that the sources do not name, in finite elements: a bar is pulled, and in every element
///
///   isotropic   σ = σ_0 + B ln(1 + ξ/ε_0) with ξ = ε − σ/E
///   kinematic   σ = σ_0 + X,  dX = (K − r(ξ) X) dξ
///   liquid      σ = f_Sᵖ σ_0 in mush that flows at any rate
///   rate        σ = σ_0 + √(3/2) S asinh(√(3/2) Δξ/(A Δt)), each step of backward Euler
#include <gtest/gtest.h>

#include "../laws/hyperbolic_sine.hpp"
#include "../laws/late_strength.hpp"
#include "../laws/logarithmic.hpp"
#include "../laws/marquis.hpp"
#include "material/tensile.hpp"
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

TEST(BarWithAnAddedLaw, RecallsItsBackStressInEveryElement) {
  material::Material m = verification::plastic_material(k_young, 0.3, k_yield);
  m.flow->kinematic = test::k_marquis.kind;
  m.flow->kinematic_modulus = 5e9;
  m.flow->recall = {50.0, 3.0};
  constexpr double k_end = 0.04;
  double coarse = 0, fine = 0;
  for (const int steps : {100, 200}) {
    test::Body body(
        {.shape = mesh::Shape::hex8, .cells = {1, 2, 1}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1},
        AnalysisKind::solid, m);
    body.hold("bottom", 1);
    body.hold("left", 0);
    body.hold("back", 2);
    body.hold("top", 1, Table({0, 1}, {0, 0.3 * k_end}));
    verification::March march(body);
    for (int step = 1; step <= steps; ++step) ASSERT_TRUE(march.to(static_cast<double>(step) / steps));
    const double stress = march.fields()[0].stress[0][1];
    for (const auto& fields : march.fields())
      for (const auto& sigma : fields.stress)
        for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(sigma[i], i == 1 ? stress : 0.0, 1e-6 * k_yield);
    (steps == 100 ? coarse : fine) =
        stress - material::tensile_stress(*m.flow, k_end - stress / k_young, body.temperature[0]);
  }
  EXPECT_LT(std::abs(fine), 1e6);  // of 200 MPa, of first order in the step
  EXPECT_NEAR(coarse / fine, 2, 0.1);
}

TEST(BarWithAnAddedLaw, HasTheStrengthOfItsMushInEveryElement) {
  material::Material m = verification::plastic_material(k_young, 0.3, k_yield);
  m.liquid_model = test::k_late_strength.model;
  m.liquid_numbers = {3.0};
  test::Body body({.shape = mesh::Shape::hex8, .cells = {1, 2, 1}, .size = {0.1, 0.3, 0.1}},
                  AnalysisKind::solid, m);
  const double half = body.temperature[0];
  body.materials[0].phase_changes.push_back(
      {.name = "freezing",
       .fraction = material::PhaseFraction::linear(half - 10, half + 10),
       .solidification = true});
  body.hold("bottom", 1);
  body.hold("left", 0);
  body.hold("back", 2);
  body.hold("top", 1, Table({0, 2}, {0, 0.3 * 0.01}));
  verification::March march(body);
  for (int step = 1; step <= 2; ++step) {
    ASSERT_TRUE(march.to(step));
    for (const auto& fields : march.fields())
      for (const auto& stress : fields.stress)
        for (std::size_t i = 0; i < 6; ++i)
          ASSERT_NEAR(stress[i], i == 1 ? 0.125 * k_yield : 0.0, 1e-6 * k_yield);
  }
}

TEST(BarWithAnAddedLaw, HasTheOverstressOfTheRateInEveryElement) {
  constexpr double k_scale = 3e7, k_rate = 1e-4;
  material::Material m = verification::plastic_material(k_young, 0.3, k_yield);
  m.flow->rate_dependence = test::k_hyperbolic_sine.kind;
  m.flow->rate = {k_scale, k_rate, 0.0};
  test::Body body(
      {.shape = mesh::Shape::hex8, .cells = {2, 3, 2}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1},
      AnalysisKind::solid, m);
  body.hold("bottom", 1);
  body.hold("left", 0);
  body.hold("back", 2);
  body.hold("top", 1, Table({0, 4}, {0, 0.3 * 0.02}));
  verification::March march(body);
  double xi = 0;
  const double root = std::sqrt(1.5);
  for (int step = 1; step <= 4; ++step) {
    ASSERT_TRUE(march.to(step));
    const double strain = 0.005 * step;
    double low = xi, high = strain;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high),
                   over = root * k_scale * std::asinh(root * (middle - xi) / k_rate);
      (k_yield + over + k_young * middle < k_young * strain ? low : high) = middle;
    }
    xi = low;
    const double exact = k_young * (strain - xi);
    EXPECT_GT(exact, 2 * k_yield);
    for (const auto& fields : march.fields())
      for (const auto& stress : fields.stress)
        for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(stress[i], i == 1 ? exact : 0.0, 1e-6 * k_yield);
  }
}

}  // namespace
}  // namespace solidus
